#include "devices/runtime/admission.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/base/number_words.h"
#include "core/base/periodic.h"
#include "core/check/check.h"
#include "core/check/rig_differences.h"
#include "core/schedule/lens_response.h"
#include "io/protocol/adopt.h"

namespace focalstage {

namespace {

/// Takes everything and does nothing: a plan is held against the limits before any hardware sees it.
class NoRig : public RigPort {
 public:
  void set_exposure(double, PictureForm) override {}
  void announce_triggers(std::span<const double>) override {}
  void set_drive(Side, std::span<const double>, double) override {}
  void post_images(std::vector<Picture>) override {}
  void sync_edge(double) override {}
  void trigger(double) override {}
  void shutter(Side, ShutterLevel, double) override {}
  void dark(double) override {}
};

Status without_errors(const Project& project, const ScheduleResult& schedule, const std::vector<FrameMeasure>& measures,
                      const ProjectorModels& models) {
  Measured measured;
  measured.frames = measures;
  for (const Finding& finding : check(project, schedule, measured, models)) {
    if (finding.severity != Severity::error) continue;
    return Fault{"rig.refused", "show " + finding.where, finding.message + " (" + finding.code + ")",
                 "correct the project and compile it again"};
  }
  return {};
}

/// The show's own samples and triggers, not what its project says they should be.
std::string schedule_differences(const ShowHeader& show, const RigDescription& rig) {
  constexpr double most_off_d = 0.02;
  constexpr double most_off_s = 20e-6;
  const Schedule& schedule = show.schedule;
  PerEye<std::vector<double>> power_d;
  for (const Side eye : both_sides) {
    power_d[eye] = power_from_drive(schedule.lens_drive_a[eye], rig.glasses.lens_response[eye]);
  }
  const double latency_s = rig.projectors.empty() ? 0.0 : rig.projectors[0].latency_ms / 1000.0;
  double worst_d = 0.0;
  double worst_s = 0.0;
  for (const Slot& slot : schedule.slots) {
    const double turns = (slot.start_s + 0.5 * slot.exposure_s) / schedule.period_s;
    worst_d = std::max(worst_d, std::abs(periodic_at(power_d[slot.eye], turns) - slot.power_d));
    worst_s = std::max(worst_s, std::abs(slot.trigger_s + latency_s - slot.start_s));
  }
  std::string text;
  if (!(worst_d <= most_off_d)) text += "its drive misses a slice's power by " + short_text(worst_d, 4) + " D; ";
  if (!(worst_s <= most_off_s)) text += "its light would come " + short_text(worst_s * 1e6, 4) + " us off; ";
  return text;
}

std::string channel_difference(const ShowHeader& show, const RigDescription& rig) {
  if (rig.projectors.empty()) return "";
  const Projector& projector = rig.projectors[0];
  if (show.width_px == projector.width_px && show.height_px == projector.height_px) return "";
  return "its images have " + std::to_string(show.width_px) + " x " + std::to_string(show.height_px) + " px, the rig " +
         std::to_string(projector.width_px) + " x " + std::to_string(projector.height_px) + "; ";
}

}  // namespace

Status within_limits(const SweepPlan& plan, const RigLimits& limits) {
  NoRig nothing;
  LimitedRig limited(nothing, limits);
  limited.set_exposure(plan.exposure_s, plan.form);
  for (const Side eye : both_sides) limited.set_drive(eye, plan.drive_a[eye], plan.drive_step_s);
  for (int sweep = 0; sweep < 4; ++sweep) {
    const double start_s = sweep * plan.period_s;
    limited.sync_edge(start_s);
    for (const ShutterCommand& command : plan.shutters) {
      limited.shutter(command.eye, command.level, start_s + command.time_s);
    }
    for (const double trigger_s : plan.trigger_s) limited.trigger(start_s + trigger_s);
  }
  if (!limited.fault()) return {};
  return Fault{"rig.refused", "show: " + limited.fault()->where, limited.fault()->message, limited.fault()->remedy};
}

Status fits_rig(const ShowHeader& show, const Project& project, const RigDescription& rig) {
  std::string text;
  for (const Finding& finding : rig_differences(project, rig_values_of(rig))) {
    text += finding.where + ": " + finding.message + "; ";
  }
  text += schedule_differences(show, rig);
  if (text.empty()) text += channel_difference(show, rig);
  if (text.empty()) return {};
  text.resize(text.size() - 2);
  return Fault{"rig.differs", "show", text, "take over this rig's values with adopt-rig and compile again"};
}

namespace {

/// The player knows one head, however many the rig describes: a show is played whole or not at all.
Status one_projector(const ShowHeader& show, const Project& project) {
  if (show.projectors() < 2 && project.projectors.size() < 2) return {};
  return Fault{"rig.differs", "show /projector/1",
               "it has several projectors, and a runtime plays shows of one: the others would stay dark",
               "push a show of a project with one projector"};
}

}  // namespace

Result<SweepPlan> admit(const ShowHeader& show, const Project& project, const ScheduleResult& schedule,
                        const std::vector<FrameMeasure>& measures, const RigTerms& rig) {
  if (Status sound = without_errors(project, schedule, measures, rig.models); !sound) return sound.fault();
  if (Status fits = fits_rig(show, project, rig.describe(show.frequency_hz)); !fits) return fits.fault();
  if (Status alone = one_projector(show, project); !alone) return alone.fault();
  Result<SweepPlan> plan =
      sweep_plan(show, project.projectors.empty() ? PictureForm{}.bits : project.projectors[0].bits);
  if (!plan) return plan;
  if (Status safe = within_limits(*plan, rig.limits); !safe) return safe.fault();
  return plan;
}

}  // namespace focalstage
