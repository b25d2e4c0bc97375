#include "core/calibrate/calibrated_edits.h"

#include <string>
#include <utility>

namespace focalstage {

std::vector<Edit> calibrated_edits(const Projector& projector, const ProjectorModel& measured) {
  std::vector<Edit> edits;
  const auto set = [&](const char* key, const Value& before, Value value) {
    if (before == value) return;
    edits.push_back({Edit::Kind::set, "projectors", projector.name, key, std::move(value)});
  };
  const auto list = [](const std::vector<double>& numbers) {
    return Value(Value::Array(numbers.begin(), numbers.end()));
  };
  const auto place = [](const glm::dvec3& p) { return Value(Value::Array{p.x, p.y, p.z}); };
  const auto turn = [](const glm::dquat& q) { return Value(Value::Array{q.x, q.y, q.z, q.w}); };
  set("fx_px", projector.fx_px, measured.focal_px.x);
  set("fy_px", projector.fy_px, measured.focal_px.y);
  set("cx_px", projector.cx_px, measured.centre_px.x);
  set("cy_px", projector.cy_px, measured.centre_px.y);
  set("distortion", list(projector.distortion), list(measured.distortion));
  set("position_m", place(projector.pose.position_m), place(measured.world_from_projector.position_m));
  set("rotation_xyzw", turn(projector.pose.rotation), turn(measured.world_from_projector.rotation));
  return edits;
}

}  // namespace focalstage
