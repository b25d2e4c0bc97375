#include "core/check/rig_differences.h"

#include <algorithm>
#include <cmath>

#include "core/check/candidates.h"
#include "core/check/rules.h"
#include "core/check/words.h"
#include "core/scene/words.h"
#include "core/schedule/lens_response.h"
#include "core/schedule/schedule.h"
#include "core/schedule/slots.h"

namespace focalstage {
namespace {

constexpr double most_off_d = 0.02;
constexpr double most_off_ms = 0.02;

/// How far the rig's lens strays from the wanted power on the drive that the project would send.
double lens_off_d(const Schedule& schedule, const RigValues& rig, Side eye) {
  const std::vector<double> delivered_d = power_from_drive(schedule.lens_drive_a[eye], rig.lens_response[eye]);
  double worst_d = 0.0;
  for (std::size_t i = 0; i < delivered_d.size(); ++i) {
    worst_d = std::max(worst_d, std::abs(delivered_d[i] - schedule.lens_power_d[eye][i]));
  }
  return worst_d;
}

Value value_of(const LensResponse& response) {
  Value::Array entries;
  for (const LensHarmonic& entry : response) {
    entries.emplace_back(Value::Object{{"harmonic", Value(entry.harmonic)},
                                       {"gain_d_per_a", Value(entry.gain_d_per_a)},
                                       {"phase_deg", Value(entry.phase_deg)}});
  }
  // A response that lists nothing is that of the static gain alone.
  if (entries.empty()) return value_of(LensResponse{LensHarmonic{}});
  return entries;
}

Value value_of(const PerEye<LensResponse>& response) {
  if (response.left == response.right) return value_of(response.left);
  return Value::Object{{"left", value_of(response.left)}, {"right", value_of(response.right)}};
}

/// Adopts the rig's lens. A drive measured along with the power is sent whatever the response says: it has to be
/// measured anew.
Edits lens_edits(const Project& project, const RigValues& rig) {
  for (const Side eye : both_sides) {
    const Waveform& waveform = project.sweep.waveform[eye];
    if (waveform && !waveform->drive_a.empty()) return {};
  }
  return {set_edit("glasses", "", "lens_response", value_of(rig.lens_response))};
}

Finding difference(const std::string& where, const std::string& what, double value, double limit,
                   const std::string& unit, Edits remedy) {
  return {Severity::error, "rig.differs", where, what, Amount{value, limit, unit}, std::move(remedy)};
}

void check_time(const std::string& where, const std::string& what, double project_ms, double rig_ms, Edit remedy,
                std::vector<Finding>& findings) {
  const double off_ms = std::abs(project_ms - rig_ms);
  if (!(off_ms > most_off_ms + rounding)) return;
  findings.push_back(difference(
      where, what + " is " + words(project_ms) + " ms in the project and " + words(rig_ms) + " ms on the rig", off_ms,
      most_off_ms, "ms", {std::move(remedy)}));
}

void check_lens(const Project& project, const RigValues& rig, std::vector<Finding>& findings) {
  const Schedule schedule = make_schedule(project, {}).schedule;
  const double off_d = std::max(lens_off_d(schedule, rig, Side::left), lens_off_d(schedule, rig, Side::right));
  if (!(off_d > most_off_d + rounding)) return;
  findings.push_back(difference("/glasses/lens_response",
                                "the rig's lens would be off by " + words(off_d) + " D on the project's drive", off_d,
                                most_off_d, "D", lens_edits(project, rig)));
}

void check_projector(const Projector& projector, const RigValues& rig, std::vector<Finding>& findings) {
  const auto set = [&](const std::string& key, double value) {
    return set_edit("projectors", projector.name, key, value);
  };
  check_time("/projectors/0/latency_ms", "the projector's latency", projector.latency_ms, rig.latency_ms,
             set("latency_ms", rig.latency_ms), findings);
  if (rig.exposure_ms) {
    check_time(projector.exposure_ms ? "/projectors/0/exposure_ms" : "/projectors/0/frames_per_second", "an exposure",
               exposure_s(projector) * 1000.0, *rig.exposure_ms, set("exposure_ms", *rig.exposure_ms), findings);
  }
  const auto check_size = [&](const std::string& key, int own_px, int rig_px) {
    if (own_px == rig_px) return;
    findings.push_back(difference("/projectors/0/" + key,
                                  "an image has " + key + " " + std::to_string(own_px) + " in the project and " +
                                      std::to_string(rig_px) + " on the rig",
                                  own_px, rig_px, "px", {set(key, rig_px)}));
  };
  check_size("width_px", projector.width_px, rig.width_px);
  check_size("height_px", projector.height_px, rig.height_px);
  if (projector.pixel_layout != rig.pixel_layout) {
    const bool diamond = rig.pixel_layout == PixelLayout::diamond;
    findings.push_back({Severity::error,
                        "rig.differs",
                        "/projectors/0/pixel_layout",
                        std::string("the pixels lie in ") + (diamond ? "squares" : "diamonds") +
                            " in the project and in " + (diamond ? "diamonds" : "squares") + " on the rig",
                        std::nullopt,
                        {set_edit("projectors", projector.name, "pixel_layout", word_of(rig.pixel_layout))}});
  }
}

/// Half a picture is none: what lies where projectors overlap would lack the share of those that are not there.
void check_count(const Project& project, const RigValues& rig, std::vector<Finding>& findings) {
  const std::size_t heads = std::max<std::size_t>(rig.projectors, 1);
  if (project.projectors.size() <= heads) return;
  findings.push_back(difference(
      item_pointer("projectors", heads),
      "the project has " + std::to_string(project.projectors.size()) + " projectors and the rig " +
          std::to_string(rig.projectors) + ": \"" + project.projectors[heads].name + "\" would stay dark",
      static_cast<double>(project.projectors.size()), static_cast<double>(rig.projectors), "projectors", {}));
}

}  // namespace

std::vector<Finding> rig_differences(const Project& project, const RigValues& rig) {
  std::vector<Finding> findings;
  check_lens(project, rig, findings);
  check_time("/glasses/shutter_open_ms", "the shutters' opening", project.glasses.shutter_open_ms, rig.shutter_open_ms,
             set_edit("glasses", "", "shutter_open_ms", rig.shutter_open_ms), findings);
  check_time("/glasses/shutter_close_ms", "the shutters' closing", project.glasses.shutter_close_ms,
             rig.shutter_close_ms, set_edit("glasses", "", "shutter_close_ms", rig.shutter_close_ms), findings);
  if (!project.projectors.empty()) check_projector(project.projectors.front(), rig, findings);
  check_count(project, rig, findings);
  std::stable_sort(findings.begin(), findings.end(),
                   [](const Finding& a, const Finding& b) { return a.where < b.where; });
  return findings;
}

}  // namespace focalstage
