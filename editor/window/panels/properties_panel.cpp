#include "editor/window/panels/properties_panel.h"

#include <algorithm>
#include <vector>

#include "core/scene/edit.h"
#include "editor/session/properties.h"
#include "editor/session/session.h"
#include "editor/window/base/im.h"
#include "editor/window/base/widgets.h"
#include "editor/window/panels/property_fields.h"

namespace focalstage {
namespace {

class PropertiesPanel final : public Panel {
 public:
  std::string_view name() const override { return "properties"; }
  PanelPlace place() const override { return PanelPlace::properties; }

  void draw(Session& session, const PaneRect&) override {
    refresh(session);
    title_line(title_.title);
    if (!title_.subtitle.empty()) elided_line(title_.subtitle, 0.0f, theme::dim);
    // An edit makes other rows: those of this frame are drawn to their end.
    const std::vector<PropertyGroup> groups = groups_;
    for (const PropertyGroup& group : groups) {
      if (!section(group.title, opens(group.title))) continue;
      for (const Property& row : group.rows) follow(session, row, draw_row(session, row));
    }
    ImGui::Dummy({0.0f, px(8)});
  }

 private:
  /// What is seldom changed begins folded.
  static bool opens(const std::string& title) { return title != "Distortion"; }

  PropertyScope scope_of(const Session& session) {
    return {session.project(),     session.view().frame / session.project().frames.rate_hz,
            session.stage().get(), &picker_,
            angles_deg_,           session.models()};
  }

  void refresh(const Session& session) {
    const Shown now{session.revision(), session.view().frame, session.stage().get(), session.selection().things};
    if (now == shown_) return;
    if (now.things != shown_.things) angles_deg_ = glm::dvec3(0.0);
    if (now.stage != shown_.stage && now.stage) picker_.keep_only(*now.stage);
    shown_ = now;
    stage_ = session.stage();
    const PropertyScope scope = scope_of(session);
    groups_ = properties_of(scope, now.things);
    title_ = title_for(scope, now.things);
    for (int axis = 0; axis < 3; ++axis) {
      static constexpr const char* names[3] = {"rotation pitch", "rotation yaw", "rotation roll"};
      const Property* row = row_named(groups_, names[axis]);
      if (row && row->value.number()) angles_deg_[axis] = *row->value.number();
    }
  }

  PropertyChange draw_row(const Session& session, const Property& row) {
    if (row.kind != Property::Kind::action) return fields_.draw(row);
    const Command* command = command_named(row.command);
    return fields_.draw(row, command ? command->unavailable(session) : "");
  }

  void follow(Session& session, const Property& row, const PropertyChange& change) {
    if (change.pressed) (void)session.run(row.command, row.args);
    if (change.let_go) session.end_drag();
    if (!change.changed) return;
    const std::vector<Thing>& things = shown_.things;
    if (row.key == "name" && things.size() == 1 && !things[0].name.empty()) {
      rename(session, things[0], change.value);
      return;
    }
    std::vector<Edit> edits = edits_for(scope_of(session), things, row, change.value);
    if (edits.empty()) return;
    if (!change.moving) {
      (void)session.edit(words_for(row, things, change.value), std::move(edits));
    } else if (apply_all(session.project(), edits)) {
      // A hand passes over values that cannot be (a slice of the same power); it need not be told of each.
      (void)session.drag(words_for(row, things, change.value), std::move(edits));
    }
  }

  static void rename(Session& session, const Thing& thing, const Value& name) {
    Value args;
    args.set("list", thing.list);
    args.set("of", thing.name);
    args.set("name", name);
    (void)session.run("edit.rename", args);
  }

  /// What the rows were made of.
  struct Shown {
    std::uint64_t revision = ~0ull;
    int frame = -1;
    const Stage* stage = nullptr;
    std::vector<Thing> things;

    bool operator==(const Shown&) const = default;
  };

  Shown shown_;
  std::shared_ptr<const Stage> stage_;  ///< kept while rows of it are shown: its address tells them apart
  Picker picker_;
  glm::dvec3 angles_deg_{0.0};
  std::vector<PropertyGroup> groups_;
  PropertyTitle title_;
  PropertyFields fields_;
};

}  // namespace

std::unique_ptr<Panel> make_properties_panel() { return std::make_unique<PropertiesPanel>(); }

}  // namespace focalstage
