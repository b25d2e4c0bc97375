#include <cmath>
#include <cstdio>

#include <glm/geometric.hpp>

#include "core/base/number_words.h"
#include "core/calibrate/eye_mount.h"
#include "editor/cli/output.h"
#include "editor/cli/sighting_file.h"
#include "editor/cli/viewer_actions.h"
#include "io/json/json.h"

namespace focalstage {
namespace {

Value value_of(const glm::dvec3& v) { return Value::Array{v.x, v.y, v.z}; }

/// As rig.json has it.
Value mount_value(const EyeMount& mount) {
  const glm::dquat& turn = mount.body_from_viewer.rotation;
  return Value::Object{{"position_m", value_of(mount.body_from_viewer.position_m)},
                       {"rotation_xyzw", Value::Array{turn.x, turn.y, turn.z, turn.w}}};
}

void print_values(const std::vector<Sighting>& sightings, const EyeMount& mount) {
  Value::Array rows;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    rows.push_back(Value::Object{{"name", sightings[i].name}, {"residual_mm", mount.residual_mm[i]}});
  }
  const auto eye = [&](Side side) {
    return Value(Value::Object{{"centre_m", value_of(mount.centre_m[side])},
                               {"uncertainty_mm", value_of(mount.uncertainty_m[side] * 1e3)}});
  };
  print_json(Value::Object{{"body_from_thing", mount_value(mount)},
                           {"left", eye(Side::left)},
                           {"right", eye(Side::right)},
                           {"interpupillary_mm", mount.interpupillary_mm},
                           {"interpupillary_uncertainty_mm", mount.interpupillary_uncertainty_mm},
                           {"rms_mm", mount.rms_mm},
                           {"worst", static_cast<double>(mount.worst + 1)},
                           {"sightings", std::move(rows)}});
}

void print_words(const std::vector<Sighting>& sightings, const EyeMount& mount) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    rows.push_back({std::to_string(i + 1), sightings[i].name, sightings[i].eye == Side::left ? "left" : "right",
                    fixed_text(mount.residual_mm[i], 2)});
  }
  std::fputs(table_text({{"sighting", true}, {"name"}, {"eye"}, {"passes by mm", true}}, rows).c_str(), stdout);
  std::printf("root mean square %s mm, worst %s mm (sighting %s)\n", fixed_text(mount.rms_mm, 2).c_str(),
              fixed_text(mount.residual_mm[mount.worst], 2).c_str(), sighting_label(sightings, mount.worst).c_str());
  for (const Side side : both_sides) {
    const glm::dvec3 at = mount.centre_m[side] * 1e3, off = mount.uncertainty_m[side] * 1e3;
    std::printf("%s eye turns about %.1f %.1f %.1f mm in the body's axes, uncertain by %.2f %.2f %.2f mm\n",
                side == Side::left ? "left" : "right", at.x, at.y, at.z, off.x, off.y, off.z);
  }
  std::printf("interpupillary distance %.2f mm, uncertain by %.2f mm\n", mount.interpupillary_mm,
              mount.interpupillary_uncertainty_mm);
  std::printf("\"body_from_thing\": %s\n", write_json(mount_value(mount), -1).c_str());
}

glm::dquat rotation_of(const std::vector<double>& xyzw, std::size_t first) {
  return {xyzw[first + 3], xyzw[first], xyzw[first + 1], xyzw[first + 2]};
}

Result<Rigid> turn_checked(const char* option, const glm::dvec3& position_m, const glm::dquat& rotation) {
  const double size = glm::length(rotation);
  if (!(std::abs(size - 1.0) < 1e-3)) {
    return Fault{"sightings.finite", option, "is no rotation", "write a quaternion of length 1, x y z w"};
  }
  return Rigid{position_m, rotation / size};
}

}  // namespace

ExitStatus run_calibrate_tracker_offset(const TrackerOffsetOptions& options) {
  const std::vector<double>& pose = options.tracker_pose;
  const auto tracker = turn_checked("--tracker-pose", {pose[0], pose[1], pose[2]}, rotation_of(pose, 3));
  if (!tracker) return report(tracker.fault());
  const auto body = turn_checked("--body-rotation", {}, rotation_of(options.body_rotation, 0));
  if (!body) return report(body.fault());
  const auto sightings = read_sightings(options.sightings, *tracker);
  if (!sightings) return report(sightings.fault());
  const auto mount = eye_mount(*sightings, body->rotation);
  if (!mount) {
    Fault fault = mount.fault();
    fault.where = options.sightings + ": " + fault.where;
    return report(fault);
  }
  if (mount->rms_mm > options.limit_mm && !options.despite_residual) {
    return report(Fault{"sightings.limit", options.sightings,
                        "the sightings pass the eyes by " + fixed_text(mount->rms_mm, 2) +
                            " mm (root mean square), more than " + fixed_text(options.limit_mm, 2) + " mm; sighting " +
                            sighting_label(*sightings, mount->worst) + " by " +
                            fixed_text(mount->residual_mm[mount->worst], 2) + " mm",
                        "take that one anew, or take it all the same with --despite-residual"});
  }
  if (options.json) {
    print_values(*sightings, *mount);
  } else {
    print_words(*sightings, *mount);
  }
  return ExitStatus::done;
}

}  // namespace focalstage
