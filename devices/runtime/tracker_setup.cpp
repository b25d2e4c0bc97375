#include "devices/runtime/tracker_setup.h"

#include <utility>

#include "devices/catalog/tracker_catalog.h"
#include "devices/recording/recorder.h"

namespace focalstage {

namespace {

Rigid sound(Rigid pose) {
  pose.rotation = glm::normalize(pose.rotation);
  return pose;
}

/// Where it is, for people.
std::string address_of(const TrackerConfig& config) {
  if (!config.file.empty()) return config.file.string();
  if (!config.camera) return config.device.address;
  return config.camera_folder.empty() ? config.camera->address : config.camera_folder.string();
}

}  // namespace

Result<TrackerConfig> tracker_named(const std::string& text) {
  const std::size_t colon = text.find(':');
  const std::string kind = text.substr(0, colon);
  const std::string rest = colon == std::string::npos ? "" : text.substr(colon + 1);
  TrackerConfig config;
  if (!rest.empty() && (kind == "natnet" || kind == "natnet-unicast")) {
    config.device.driver = "natnet";
    config.device.address = rest;
    if (kind == "natnet-unicast") config.device.settings = {{"cast", "unicast"}};
    return config;
  }
  if (!rest.empty() && kind == "recording") {
    config.device.driver = "recording";
    config.file = rest;
    return config;
  }
  return Fault{"tracker.unknown", text, "this names no tracker",
               "say natnet:HOST, natnet-unicast:HOST or recording:FILE"};
}

Result<TrackerSetup> tracker_setup(const TrackerConfig& config) {
  Result<std::shared_ptr<Tracker>> tracker = make_tracker(config);
  if (!tracker) return tracker.fault();
  TrackerSetup setup;
  setup.tracker = std::move(*tracker);
  setup.id = {config.device.driver, "tracker", "", address_of(config)};
  setup.world_from_tracker = sound(config.world_from_tracker);
  for (const BodyConfig& body : config.bodies) setup.body_from_thing[body.name] = sound(body.body_from_thing);
  return setup;
}

std::shared_ptr<Tracker> recorded(std::shared_ptr<Tracker> tracker, const std::string& path) {
  return std::make_shared<TrackerRecorder>(std::move(tracker), path);
}

}  // namespace focalstage
