// The session as a value, for scripts and tests to assert on.
#include <array>

#include "core/scene/project_value.h"
#include "editor/session/session_state.h"

namespace focalstage {
namespace {

const char* word_for(RigStatus::Phase phase) {
  static constexpr std::array<const char*, 4> words{"none", "connecting", "connected", "lost"};
  return words[static_cast<std::size_t>(phase)];
}

Value value_of(const RigStatus& rig) {
  Value value;
  value.set("phase", word_for(rig.phase));
  value.set("address", rig.address);
  value.set("simulated", rig.simulated);
  value.set("state", rig.state.state);
  value.set("sweeps", static_cast<double>(rig.state.sweeps));
  value.set("fault", rig.fault ? Value(describe(*rig.fault)) : Value(""));
  value.set("pushing", rig.pushing);
  value.set("pushed", !rig.pushed_sha256.empty());
  value.set("live", rig.live);
  value.set("live_revision", static_cast<double>(rig.live_revision));
  value.set("edit_to_light_ms", rig.edit_to_light_ms);
  std::size_t delivered = 0;
  std::size_t measured = 0;
  for (const SlotReport& slot : rig.state.slots) {
    delivered += slot.delivered && !slot.unmeasured ? 1 : 0;
    measured += slot.unmeasured ? 0 : 1;
  }
  value.set("slots", static_cast<double>(rig.state.slots.size()));
  value.set("slots_measured", static_cast<double>(measured));
  value.set("slots_delivered", static_cast<double>(delivered));
  return value;
}

Value value_of(const ViewState& view) {
  Value value;
  value.set("frame", view.frame);
  value.set("playing", view.playing);
  value.set("focus_d", view.focus_d);
  value.set("pupil_mm", view.pupil_mm);
  value.set("conventional", view.projection == EyeProjection::conventional);
  value.set("beside", view.projection == EyeProjection::both);
  value.set("conflict", view.conflict);
  Value off = Value::Object{};
  for (const auto& [what, amount] : view.rig_errors) off.set(what, amount);
  value.set("rig_errors", off);
  value.set("image", view.image);
  value.set("azimuth_deg", view.camera.azimuth_deg);
  value.set("elevation_deg", view.camera.elevation_deg);
  value.set("distance_m", view.camera.distance_m);
  value.set("filled", view.filled ? Value(static_cast<int>(*view.filled)) : Value());
  value.set("tool", static_cast<int>(view.tool));
  value.set("space_mouse", view.steering.present);
  value.set("space_mouse_moves_selected", view.steering.moves_selected);
  value.set("space", static_cast<int>(view.space));
  value.set("eye", static_cast<int>(view.eye));
  value.set("compensation", static_cast<int>(view.compensation));
  value.set("picture", static_cast<int>(view.picture));
  value.set("tint_by_slice", view.tint_by_slice);
  value.set("sweep_time_s", view.sweep_time_s ? Value(*view.sweep_time_s) : Value());
  return value;
}

/// How many of the slices' pixels are lit, per image: a picture that says something cannot be all dark.
Value::Array lit_pixels(const CompiledSlices& slices) {
  Value::Array lit;
  for (std::size_t i = 0; i < slices.images.count; ++i) {
    double count = 0;
    for (const std::uint8_t code : slices.images.image(i)) count += code > 0 ? 1 : 0;
    lit.emplace_back(count);
  }
  return lit;
}

Value value_of(const CompiledSlices& slices) {
  Value value;
  value.set("revision", static_cast<double>(slices.revision));
  value.set("frame", slices.frame);
  value.set("divisor", slices.divisor);
  value.set("compile_ms", slices.compile_ms);
  value.set("lit", lit_pixels(slices));
  return value;
}

Value value_of(const SolveOffer& offer) {
  Value value;
  value.set("solved", offer.solved());
  Value::Array words;
  for (const std::string& line : offer.words) words.emplace_back(line);
  value.set("words", std::move(words));
  const auto& rig = offer.report.result.rig;
  value.set("powers_d", rig ? Value(Value::Array(rig->powers_d.begin(), rig->powers_d.end())) : Value());
  value.set("edits", static_cast<double>(offer.report.edits.size()));
  value.set("nearest", static_cast<double>(offer.report.nearest.size()));
  return value;
}

}  // namespace

Value Session::described() const {
  const State& state = *state_;
  Value value;
  value.set("open", has_document());
  value.set("revision", static_cast<double>(revision()));
  if (has_document()) {
    value.set("project", value_from(project()));
    value.set("file", document().file().string());
    value.set("untitled", document().untitled());
    value.set("unsaved", document().unsaved());
    Value history;
    history.set("place", static_cast<double>(document().history().place()));
    Value::Array steps;
    for (const Step& step : document().history().steps()) steps.emplace_back(step.words);
    history.set("steps", std::move(steps));
    value.set("history", std::move(history));
  }
  Value::Array selected;
  for (const Thing& thing : selection().things) selected.emplace_back(thing.list + "/" + thing.name);
  value.set("selection", std::move(selected));
  value.set("view", value_of(view()));
  const auto shown = slices();
  value.set("slices", shown ? value_of(*shown) : Value());
  Value::Array found;
  for (const Finding& finding : findings()) found.push_back(value_from(finding));
  value.set("findings", std::move(found));
  const auto known = checked();
  value.set("checked", known && known->measured && known->revision == revision());
  const auto eye = eye_picture();
  value.set("eye_revision", eye ? Value(static_cast<double>(eye->revision)) : Value());
  const auto offer = solve_offer();
  value.set("solve", offer ? value_of(*offer) : Value());
  value.set("compiling", compiling());
  value.set("dragging", dragging());
  value.set("rig", value_of(rig().status()));
  value.set("notice", notice() ? Value(notice()->text) : Value(""));
  value.set("question", question() ? Value(question()->title) : Value(""));
  value.set("tasks", static_cast<double>(tasks().size()));
  value.set("recoveries", static_cast<double>(left_behind().size()));
  value.set("recent", static_cast<double>(recent().size()));
  value.set("file_wish", static_cast<int>(state.file_wish));
  value.set("bottom_tab", view().bottom_tab);
  value.set("palette", state.palette_open);
  value.set("quitting", state.quitting);
  return value;
}

}  // namespace focalstage
