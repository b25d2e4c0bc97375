#include "core/schedule/schedule.h"

#include "core/schedule/lens_response.h"
#include "core/schedule/slots.h"
#include "core/schedule/waveform.h"

namespace focalstage {
namespace {

/// What makes one lens follow its curve: the drive measured along with it, else the inverse of the lens response.
std::vector<double> drive_of(const Project& project, Side eye, const std::vector<double>& power_d) {
  const Waveform& waveform = project.sweep.waveform[eye];
  if (waveform && !waveform->drive_a.empty()) return resampled(waveform->drive_a, power_d.size());
  return drive_for_power(power_d, project.glasses.lens_response[eye]);
}

}  // namespace

ScheduleResult make_schedule(const Project& project, const std::vector<ImageSpec>& images, std::size_t projector) {
  Timing timing = time_slots(project, images, projector);
  ScheduleResult result;
  result.schedule.slots = std::move(timing.slots);
  result.troubles = std::move(timing.troubles);

  const PerEye<Result<PowerCurve>> curves = power_curves(project.sweep);
  const std::size_t count = lens_sample_count(project.sweep);
  for (const Side eye : both_sides) {
    if (!curves[eye]) {  // named in the troubles; the lens rests
      result.schedule.lens_power_d[eye].assign(count, 0.0);
      result.schedule.lens_drive_a[eye].assign(count, 0.0);
      continue;
    }
    result.schedule.period_s = curves[eye]->period_s();
    result.schedule.lens_power_d[eye] = curves[eye]->samples_d(count);
    result.schedule.lens_drive_a[eye] = drive_of(project, eye, result.schedule.lens_power_d[eye]);
  }
  const ShutterPlan shutters = shutters_of(project, curves);
  result.schedule.shutter = shutters.told;
  return result;
}

}  // namespace focalstage
