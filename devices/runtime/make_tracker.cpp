#include "devices/runtime/make_tracker.h"

#include <utility>

#include "devices/natnet/receiver.h"
#include "devices/recording/recorded_tracker.h"
#include "devices/recording/recorder.h"

namespace focalstage {

Result<std::shared_ptr<Tracker>> make_tracker(const std::string& text) {
  const std::size_t colon = text.find(':');
  const std::string kind = text.substr(0, colon);
  const std::string rest = colon == std::string::npos ? "" : text.substr(colon + 1);
  if (!rest.empty() && (kind == "natnet" || kind == "natnet-unicast")) {
    NatNetSettings settings;
    settings.server = rest;
    settings.cast = kind == "natnet" ? NatNetCast::multicast : NatNetCast::unicast;
    return std::shared_ptr<Tracker>(std::make_shared<NatNetReceiver>(settings));
  }
  if (!rest.empty() && kind == "recording") {
    Result<TrackerRecording> recording = read_recording_file(rest);
    if (!recording) return recording.fault();
    ReplaySettings settings;
    settings.loop = true;
    return std::shared_ptr<Tracker>(std::make_shared<RecordedTracker>(std::move(*recording), settings));
  }
  return Fault{"tracker.unknown", text, "this names no tracker",
               "say natnet:HOST, natnet-unicast:HOST or recording:FILE"};
}

std::shared_ptr<Tracker> recorded(std::shared_ptr<Tracker> tracker, const std::string& path) {
  return std::make_shared<TrackerRecorder>(std::move(tracker), path);
}

}  // namespace focalstage
