#include "devices/natnet/bodies.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace focalstage {

namespace {

// Single precision and a server's own rounding stay far below this; zeros, which stand for an unseen body, do not.
constexpr double unit_within = 0.01;
// Motion capture takes milliseconds: what is longer is a broken clock and would throw a prediction far off.
constexpr double longest_latency_s = 1.0;

bool finite(const NatNetBody& body) {
  const auto is_finite = [](float value) { return std::isfinite(value); };
  return std::all_of(body.position_m.begin(), body.position_m.end(), is_finite) &&
         std::all_of(body.rotation_xyzw.begin(), body.rotation_xyzw.end(), is_finite);
}

TrackedBody tracked_body(const NatNetBody& body, NatNetAxes axes) {
  TrackedBody out;
  out.id = body.id;
  out.mean_error_m = std::isfinite(body.mean_error_m) ? double{body.mean_error_m} : 0.0;
  if (!body.valid || !finite(body)) return out;
  const auto& [x, y, z, w] = body.rotation_xyzw;
  const glm::dquat rotation(double{w}, double{x}, double{y}, double{z});
  const double length = glm::length(rotation);
  if (std::abs(length - 1.0) > unit_within) return out;
  out.tracked = true;
  const auto& position = body.position_m;
  out.tracker_from_body = turned_to_y_up({{position[0], position[1], position[2]}, rotation / length}, axes);
  return out;
}

std::optional<double> latency_s(const NatNetFrame& frame, const NatNetServer& server) {
  if (frame.exposed_ticks == 0 || frame.sent_ticks < frame.exposed_ticks || server.ticks_per_s == 0)
    return std::nullopt;
  const auto ticks = static_cast<double>(frame.sent_ticks - frame.exposed_ticks);
  const double seconds = ticks / static_cast<double>(server.ticks_per_s);
  if (seconds > longest_latency_s) return std::nullopt;
  return seconds;
}

}  // namespace

Rigid turned_to_y_up(const Rigid& pose, NatNetAxes axes) {
  if (axes == NatNetAxes::y_up) return pose;
  // +Z becomes +Y: a quarter turn back about X.
  constexpr double half = std::numbers::sqrt2 / 2.0;
  const Rigid y_from_z{{}, glm::dquat(half, -half, 0.0, 0.0)};
  return y_from_z * pose * y_from_z.inverse();
}

TrackedFrame tracked_frame(const NatNetFrame& frame, const NatNetServer& server,
                           const std::map<std::int32_t, std::string>& names, NatNetAxes axes, double arrival_s) {
  TrackedFrame out;
  out.number = frame.number;
  out.time_s = frame.timestamp_s;
  out.latency_s = latency_s(frame, server);
  out.arrival_s = arrival_s;
  for (const NatNetBody& body : frame.bodies) {
    out.bodies.push_back(tracked_body(body, axes));
    if (const auto found = names.find(body.id); found != names.end()) out.bodies.back().name = found->second;
  }
  return out;
}

}  // namespace focalstage
