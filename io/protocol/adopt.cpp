#include "io/protocol/adopt.h"

#include <algorithm>
#include <string>
#include <utility>

#include "core/scene/words.h"

namespace focalstage {
namespace {

Edit set(const std::string& list, const std::string& name, const std::string& key, Value value) {
  return {Edit::Kind::set, list, name, key, std::move(value)};
}

Value value_of(const LensResponse& response) {
  Value::Array array;
  for (const LensHarmonic& harmonic : response) {
    Value item;
    item.set("harmonic", harmonic.harmonic);
    item.set("gain_d_per_a", harmonic.gain_d_per_a);
    item.set("phase_deg", harmonic.phase_deg);
    array.push_back(std::move(item));
  }
  return array;
}

Value value_of(const PerEye<LensResponse>& response) {
  if (response.left == response.right) return value_of(response.left);
  Value value;
  value.set("left", value_of(response.left));
  value.set("right", value_of(response.right));
  return value;
}

void adopt_glasses(const Glasses& now, const Glasses& rig, std::vector<Edit>& edits) {
  if (now.lens_response != rig.lens_response) {
    edits.push_back(set("glasses", "", "lens_response", value_of(rig.lens_response)));
  }
  if (now.shutter_open_ms != rig.shutter_open_ms) {
    edits.push_back(set("glasses", "", "shutter_open_ms", rig.shutter_open_ms));
  }
  if (now.shutter_close_ms != rig.shutter_close_ms) {
    edits.push_back(set("glasses", "", "shutter_close_ms", rig.shutter_close_ms));
  }
  if (now.lens_range_d != rig.lens_range_d) {
    edits.push_back(set("glasses", "", "lens_range_d", Value::Array{rig.lens_range_d[0], rig.lens_range_d[1]}));
  }
}

/// A rig that lets less current through than the project allows has the last word; one that lets more does not raise
/// what somebody wrote down for their lenses.
void adopt_current(const Glasses& now, const RigDescription& rig, std::vector<Edit>& edits) {
  const double allowed_a = now.lens_limits.value_or(LensLimits{}).max_current_a;
  if (!(rig.lens_current_max_a > 0.0) || rig.lens_current_max_a >= allowed_a) return;
  edits.push_back(set("glasses", "", "lens_limits/max_current_a", rig.lens_current_max_a));
}

void adopt_projector(const Projector& now, const Projector& rig, std::vector<Edit>& edits) {
  const auto set_number = [&](const char* key, double mine, double theirs) {
    if (mine != theirs) edits.push_back(set("projectors", now.name, key, theirs));
  };
  set_number("width_px", now.width_px, rig.width_px);
  set_number("height_px", now.height_px, rig.height_px);
  if (now.pixel_layout != rig.pixel_layout) {
    edits.push_back(set("projectors", now.name, "pixel_layout", word_of(rig.pixel_layout)));
  }
  set_number("bits", now.bits, rig.bits);
  set_number("latency_ms", now.latency_ms, rig.latency_ms);
  set_number("frames_per_second", now.frames_per_second, std::min(now.frames_per_second, rig.frames_per_second));
}

}  // namespace

std::vector<Edit> adopt(const Project& project, const RigDescription& rig) {
  std::vector<Edit> edits;
  adopt_glasses(project.glasses, rig.glasses, edits);
  adopt_current(project.glasses, rig, edits);
  for (std::size_t i = 0; i < project.projectors.size(); ++i) {
    const Projector& now = project.projectors[i];
    const auto named = std::find_if(rig.projectors.begin(), rig.projectors.end(),
                                    [&](const Projector& theirs) { return theirs.name == now.name; });
    if (named != rig.projectors.end()) {
      adopt_projector(now, *named, edits);
    } else if (i < rig.projectors.size()) {
      adopt_projector(now, rig.projectors[i], edits);
    }
  }
  return edits;
}

RigValues rig_values_of(const RigDescription& rig) {
  RigValues values;
  values.lens_response = rig.glasses.lens_response;
  values.shutter_open_ms = rig.glasses.shutter_open_ms;
  values.shutter_close_ms = rig.glasses.shutter_close_ms;
  if (!rig.projectors.empty()) {
    values.latency_ms = rig.projectors[0].latency_ms;
    values.width_px = rig.projectors[0].width_px;
    values.height_px = rig.projectors[0].height_px;
    values.pixel_layout = rig.projectors[0].pixel_layout;
    values.projectors = rig.projectors.size();
  }
  return values;
}

}  // namespace focalstage
