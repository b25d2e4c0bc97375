// Projectors, glasses and the sweep: what stands in the lab.
#include <algorithm>
#include <array>
#include <cmath>

#include <glm/trigonometric.hpp>

#include "core/base/number_words.h"
#include "core/schedule/projector_models.h"
#include "editor/session/edits.h"
#include "editor/session/property_rows.h"

namespace focalstage {
namespace {

double number_at(const PropertyRows& rows, std::string_view key, double otherwise) {
  const double* number = rows.at(key).number();
  return number ? *number : otherwise;
}

// Projectors ----------------------------------------------------------------------------------------------------------

void add_model_row(PropertyRows& rows) {
  std::vector<PropertyChoice> choices;
  if (rows.scope().models) {
    for (const ProjectorModelData& model : *rows.scope().models) choices.push_back({Value(model.name), model.name});
  }
  const Value& model = rows.at("model");
  const bool known = std::any_of(choices.begin(), choices.end(), [&](const auto& c) { return c.value == model; });
  if (!known && model.text()) choices.push_back({model, *model.text()});
  rows.choice("model", "model", std::move(choices)).help =
      "What it can do at each bit depth, and who is the clock. More: files in models/ beside the project.";
}

void add_curve_row(PropertyRows& rows) {
  const Value::Array* measured = rows.at("transfer").array();
  const bool any = measured && !measured->empty();
  Property& row = rows.shown("curve", any ? "measured, " + std::to_string(measured->size()) + " values" : "by gamma");
  row.key = "transfer";
  row.help = "What codes give; a measured curve stands in the project's file in place of gamma.";
}

void add_picture_rows(PropertyRows& rows) {
  rows.group("Picture");
  add_model_row(rows);
  rows.number<Projector>("width", "width_px", {"px", 0, 1.0});
  rows.number<Projector>("height", "height_px", {"px", 0, 1.0});
  Property& lattice =
      rows.choice("lattice", "pixel_layout", {{Value("square"), "square"}, {Value("diamond"), "diamond"}});
  if (lattice.value.is_null()) lattice.value = Value("square");  // a project does not say it
  lattice.help = "Diamond: odd rows lie half a pixel to the right, and rows are half as far apart as columns.";
  Property& bits = rows.number<Projector>("bits", "bits", {"", 0, 0.05});
  bits.other = std::to_string(1 << std::clamp(static_cast<int>(number_at(rows, "bits", 8)), 0, 16)) + " levels";
  rows.choice("colour", "color", {{Value("gray"), "gray"}, {Value("rgb"), "red, green, blue"}});
  rows.number<Projector>("gamma", "gamma", {"", 2, 0.01}).help = "A code's light is its share to this power.";
  add_curve_row(rows);
  rows.number<Projector>("black level", "black_level", {"", 4, 0.0001}).help =
      "What code 0 lets through, as a share of full white.";
  Property& lumens = rows.number<Projector>("lumens", "lumens", {"lm", 0, 10.0});
  lumens.fresh = Value(1000.0);
  rows.number<Projector>("blend margin", "blend_margin_px", {"px", 0, 1.0}).help =
      "Beside other projectors: over how many pixels its share runs out to the edge of its picture and of a shadow.";
}

void add_timing_rows(PropertyRows& rows) {
  rows.group("Timing");
  Property& rate = rows.number<Projector>("images", "frames_per_second", {"/s", 0, 10.0});
  const double period_ms = 1000.0 / number_at(rows, "frames_per_second", 2000.0);
  rate.other = fixed_text(period_ms, 2) + " ms";
  rate.help = "The most images in a second.";
  Property& exposure = rows.number<Projector>("exposure", "exposure_ms", {"ms", 3, 0.005});
  exposure.fresh = Value(std::round(period_ms * 1000.0) / 1000.0);
  exposure.help = "How long one image is lit. Not set: as long as the image rate leaves it.";
  rows.number<Projector>("latency", "latency_ms", {"ms", 3, 0.005}).help = "From the trigger to the light.";
}

std::string field_of_view(const PropertyRows& rows) {
  const auto angle_deg = [&](const char* size, const char* focal) {
    return glm::degrees(2.0 * std::atan(0.5 * number_at(rows, size, 1.0) / number_at(rows, focal, 1.0)));
  };
  return fixed_text(angle_deg("width_px", "fx_px"), 1) + "° × " + fixed_text(angle_deg("height_px", "fy_px"), 1) + "°";
}

void add_lens_rows(PropertyRows& rows) {
  rows.group("Lens");
  rows.shown("field of view", field_of_view(rows));
  for (const char* name : {"fx", "fy", "cx", "cy"}) {
    rows.number<Projector>(name, std::string(name) + "_px", {"px", 1, 1.0}).help =
        name[0] == 'f' ? "Focal length." : "Where its axis meets the picture, from the top left.";
  }
  Property& focus = rows.number<Projector>("focus", "focus_m", {"m", 2, 0.01});
  focus.fresh = Value(1.0);
  focus.help = "The distance at which its picture is sharp.";
  if (focus.value.number()) focus.other = dioptre_text(1.0 / *focus.value.number());
  Property& depth = rows.number<Projector>("depth of field", "depth_of_field_d", {"D", 2, 0.01});
  depth.fresh = Value(0.3);
  depth.help = "How far from its focus its picture still is sharp.";
}

/// As many coefficients as OpenCV knows: what there is stays, what is new is zero.
std::vector<Edit> set_count(const PropertyScope& scope, const Thing& thing, const Property&, const Value& value) {
  for (const Projector& projector : scope.project.projectors) {
    if (projector.name != thing.name || !value.number()) continue;
    std::vector<double> distortion = projector.distortion;
    distortion.resize(static_cast<std::size_t>(std::clamp(*value.number(), 0.0, 8.0)), 0.0);
    Value::Array array(distortion.begin(), distortion.end());
    return {set_edit(thing, "distortion", Value(std::move(array)))};
  }
  return {};
}

void add_distortion_rows(PropertyRows& rows) {
  constexpr std::array<const char*, 8> names{"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"};
  rows.group("Distortion");
  const Value::Array* there = rows.at("distortion").array();
  const std::size_t count = there ? there->size() : 0;
  Property& kind = rows.choice("coefficients", "distortion",
                               {{Value(0.0), "none"}, {Value(4.0), "4"}, {Value(5.0), "5"}, {Value(8.0), "8"}});
  kind.value = Value(static_cast<double>(count));
  kind.edits = set_count;
  kind.help = "As OpenCV measures them.";
  KeyFacts facts = key_facts<Projector>("distortion");
  facts.fresh = Value(0.0);
  for (std::size_t i = 0; i < std::min(count, names.size()); ++i) {
    rows.number_with(facts, names[i], "distortion/" + std::to_string(i), {"", 5, 0.0005});
  }
}

// Glasses and sweep ---------------------------------------------------------------------------------------------------

std::string lens_text(const LensResponse& response) {
  if (response.empty()) return "40 D/A, no lag";
  const auto first = std::find_if(response.begin(), response.end(), [](const auto& h) { return h.harmonic == 1; });
  const LensHarmonic& told = first == response.end() ? response.front() : *first;
  return fixed_text(told.gain_d_per_a, 1) + " D/A, " + fixed_text(told.phase_deg, 1) + "°";
}

void add_response_rows(PropertyRows& rows) {
  const PerEye<LensResponse>& lenses = rows.scope().project.glasses.lens_response;
  rows.group("Lens response");
  const char* help = "Gain and phase at the sweep's own frequency, as the rig measured them.";
  if (lenses.left == lenses.right) {
    rows.shown("both lenses", lens_text(lenses.left)).help = help;
  } else {
    rows.shown("left lens", lens_text(lenses.left)).help = help;
    rows.shown("right lens", lens_text(lenses.right)).help = help;
  }
  rows.shown("harmonics", per_eye_text(lenses.left.size(), lenses.right.size()));
}

void add_limit_rows(PropertyRows& rows) {
  rows.group("Limits of the lens drive");
  rows.number<LensLimits>("current", "lens_limits/max_current_a", {"A", 3, 0.001}).help =
      "The largest current either way; 0.29 A is all that a Lens Driver 4 puts out.";
  rows.number<LensLimits>("current for long", "lens_limits/max_rms_current_a", {"A", 3, 0.001}).help =
      "Root mean square over a period, which heats the coil.";
  Property& highest = rows.number<LensLimits>("highest frequency", "lens_limits/max_frequency_hz", {"Hz", 0, 10.0});
  highest.fresh = Value(1000.0);
  highest.help = "Of a shaped sweep. Without, it ends where the lens response does.";
}

std::string waveform_text(const Waveform& waveform) {
  return waveform ? "measured, " + grouped_text(waveform->power_d.size()) + " samples" : "sine";
}

void add_waveform_rows(PropertyRows& rows) {
  const PerEye<Waveform>& waves = rows.scope().project.sweep.waveform;
  std::vector<PropertyChoice> choices{{Value("sine"), "sine"}};
  const bool measured = waves.left || waves.right;
  if (measured) choices.push_back({Value("measured"), "measured"});
  Property& row = rows.choice("waveform", "waveform", std::move(choices));
  row.value = Value(measured ? "measured" : "sine");
  row.help = "A sine, or a period of samples: measured on the rig, or shaped to dwell at the slices.";
  row.edits = [](const PropertyScope&, const Thing& thing, const Property&, const Value& value) -> std::vector<Edit> {
    if (value != Value("sine")) return {};
    return {set_edit(thing, "waveform", value)};
  };
  rows.action("Shape the sweep", "sweep.shape");
  if (!measured) return;
  rows.shown("left", waveform_text(waves.left));
  rows.shown("right", waveform_text(waves.right));
}

}  // namespace

void add_projector_rows(PropertyRows& rows) {
  add_pose_rows(rows);
  add_picture_rows(rows);
  add_timing_rows(rows);
  add_lens_rows(rows);
  add_distortion_rows(rows);
  rows.group("In the project");
  add_name_row(rows);
}

void add_glasses_rows(PropertyRows& rows) {
  rows.group("Lens");
  Property& lowest = rows.number<Glasses>("lowest power", "lens_range_d/0", {"D", 2, 0.02});
  lowest.help = "What the lens can reach.";
  rows.number<Glasses>("highest power", "lens_range_d/1", {"D", 2, 0.02}).help = "What the lens can reach.";
  rows.number<Glasses>("aperture", "lens_aperture_mm", {"mm", 1, 0.1}).help = "The lens's clear width.";
  rows.number<Glasses>("lens to pupil", "lens_to_pupil_mm", {"mm", 1, 0.1});
  rows.group("Shutter");
  rows.number<Glasses>("closes in", "shutter_close_ms", {"ms", 2, 0.01});
  rows.number<Glasses>("opens in", "shutter_open_ms", {"ms", 2, 0.01});
  add_response_rows(rows);
  add_limit_rows(rows);
}

void add_sweep_rows(PropertyRows& rows) {
  rows.group("Sweep");
  Property& frequency = rows.number<Sweep>("frequency", "frequency_hz", {"Hz", 2, 0.1});
  frequency.other = fixed_text(1000.0 / number_at(rows, "frequency_hz", 60.0), 2) + " ms";
  rows.number<Sweep>("lowest power", "min_power_d", {"D", 2, 0.01});
  rows.number<Sweep>("highest power", "max_power_d", {"D", 2, 0.01});
  add_waveform_rows(rows);
}

}  // namespace focalstage
