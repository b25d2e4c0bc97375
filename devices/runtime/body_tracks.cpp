#include "devices/runtime/body_tracks.h"

#include <algorithm>

namespace focalstage {

namespace {

const std::string& name_of(const TrackedBody& body, std::string& number) {
  if (!body.name.empty()) return body.name;
  number = std::to_string(body.id);
  return number;
}

}  // namespace

void BodyTracks::take(const TrackedFrame& frame) {
  const double seen_s = frame.arrival_s - frame.latency_s.value_or(0.0);
  newest_ = Moment{newest_ ? newest_->count + 1 : 1, seen_s};
  std::set<std::string> there;
  for (const TrackedBody& body : frame.bodies) {
    std::string number;
    const std::string& name = name_of(body, number);
    there.insert(name);
    Track& track = tracks_.try_emplace(name, Track{Motion(limits_), std::nullopt}).first->second;
    track.motion.add({frame.time_s, seen_s, body.tracked, body.tracker_from_body});
    if (body.tracked) track.tracked_s = frame.arrival_s;
  }
  for (auto& [name, track] : tracks_) {
    if (!there.contains(name)) track.motion.add({frame.time_s, seen_s, false, {}});
  }
}

BodyPoses BodyTracks::at(double time_s) const {
  BodyPoses poses;
  for (const auto& [name, track] : tracks_) poses[name] = track.motion.at(time_s);
  return poses;
}

std::optional<Fault> BodyTracks::doubt(const std::set<std::string>& bodies, const TrackerState& tracker, double now_s,
                                       double allowed_s) const {
  for (const std::string& name : bodies) {
    const auto track = tracks_.find(name);
    const bool known = track != tracks_.end() && track->second.tracked_s;
    if (known && now_s - *track->second.tracked_s <= allowed_s) continue;
    if (tracker.fault) {
      return Fault{"rig.tracker", "body " + name, "the tracker is lost: " + describe(*tracker.fault),
                   "see that it streams, then say go"};
    }
    return Fault{"rig.tracker", "body " + name, known ? "it is not seen any more" : "the tracker knows no such body",
                 "see that nothing covers its markers, then say go"};
  }
  return std::nullopt;
}

}  // namespace focalstage
