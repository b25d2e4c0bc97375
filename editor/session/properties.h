#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "core/schedule/projector_models.h"
#include "core/stage/stage.h"
#include "editor/session/property.h"
#include "editor/tools/pick.h"

namespace focalstage {

/// What rows are made from.
struct PropertyScope {
  const Project& project;
  double time_s = 0.0;           ///< the frame in view: what has keys shows, and sets, its pose there
  const Stage* stage = nullptr;  ///< the room at that time; null: what is measured in it is left out
  Picker* picker = nullptr;      ///< to measure depths with; null: they are left out
  /// Pitch, yaw and roll as they were shown last: of all angles that mean the same turn, those nearest are shown.
  glm::dvec3 angles_near_deg{0.0};
  std::shared_ptr<const ProjectorModels> models{};  ///< to choose among; null: none
};

/// All rows of what is selected, in groups. Of several things those rows that all of them have; of none the project's
/// own.
std::vector<PropertyGroup> properties_of(const PropertyScope& scope, const std::vector<Thing>& things);

/// The edits that put `value` into the row of all those things; null takes away what is removable. No edits where
/// nothing would change.
std::vector<Edit> edits_for(const PropertyScope& scope, const std::vector<Thing>& things, const Property& row,
                            const Value& value);

/// What setting the row to `value` is called in the history: "Move rabbit", "Set latency of main".
std::string words_for(const Property& row, const std::vector<Thing>& things, const Value& value);

/// What stands above the rows: "rabbit", "rabbit.glb, 70 688 triangles".
struct PropertyTitle {
  std::string title;
  std::string subtitle;
};
PropertyTitle title_for(const PropertyScope& scope, const std::vector<Thing>& things);

/// The row of that id; null where there is none.
const Property* row_named(const std::vector<PropertyGroup>& groups, std::string_view id);

}  // namespace focalstage
