#include "devices/runtime/measured_values.h"

#include <algorithm>
#include <utility>

#include <spdlog/spdlog.h>

#include "core/schedule/lens_response.h"
#include "devices/runtime/response_points.h"

namespace focalstage {

namespace {

std::string name_of(const RigDescription& rig) { return rig.name + ", " + rig.kind; }

std::vector<ResponsePoint> points_of(const MeasuredEye& eye, double frequency_hz) {
  std::vector<ResponsePoint> points;
  for (const MeasuredHarmonic& one : eye.lens) {
    points.push_back({one.harmonic * frequency_hz, one.gain_d_per_a.value, one.phase_deg.value});
  }
  return points;
}

}  // namespace

RigDescription with_measured(RigDescription rig, const RigMeasurement& measurement) {
  for (Projector& projector : rig.projectors) projector.latency_ms = measurement.latency_ms.value;
  const auto slower = [&](Estimate MeasuredEye::*what) {
    return std::max((measurement.eye.left.*what).value, (measurement.eye.right.*what).value);
  };
  rig.glasses.shutter_close_ms = slower(&MeasuredEye::shutter_close_ms);
  rig.glasses.shutter_open_ms = slower(&MeasuredEye::shutter_open_ms);
  for (const Side eye : both_sides) {
    rig.glasses.lens_response[eye] =
        response_at(points_of(measurement.eye[eye], measurement.frequency_hz), rig.frequency_hz);
  }
  rig.measurement = measurement;
  return rig;
}

Result<std::unique_ptr<MeasuredValues>> MeasuredValues::open(const std::filesystem::path& folder, DescribeRig describe,
                                                             std::function<bool()> share_drive) {
  auto values = std::unique_ptr<MeasuredValues>(
      new MeasuredValues(folder / "measured.json", std::move(describe), std::move(share_drive)));
  Result<std::optional<KeptMeasurement>> kept = load_measurement(values->file_);
  if (!kept) return kept.fault();
  if (!*kept) return values;
  const std::string mine = name_of(values->plain_(60.0));
  if ((*kept)->rig == mine) {
    values->measurement_ = std::move((*kept)->measurement);
  } else {
    spdlog::warn("{}: measured on \"{}\", and this is \"{}\": not used", values->file_.string(), (*kept)->rig, mine);
  }
  return values;
}

Status MeasuredValues::keep(const RigMeasurement& measurement) {
  if (Status saved = save_measurement(file_, {name_of(plain_(60.0)), measurement}); !saved) return saved;
  const std::lock_guard lock(mutex_);
  measurement_ = measurement;
  return {};
}

RigDescription MeasuredValues::describe(double frequency_hz) const {
  RigDescription rig = plain_(frequency_hz);
  {
    const std::lock_guard lock(mutex_);
    if (measurement_) rig = with_measured(std::move(rig), *measurement_);
  }
  if (share_drive_ && share_drive_()) {
    PerEye<LensResponse>& lens = rig.glasses.lens_response;
    lens.left = lens.right = halfway(lens.left, lens.right);
  }
  return rig;
}

}  // namespace focalstage
