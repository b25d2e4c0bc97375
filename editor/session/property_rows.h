#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/scene/fields_project.h"
#include "core/scene/pointer.h"
#include "editor/session/properties.h"

// How the files of properties_*.cpp make rows: what a key may hold is read from the field tables that also read the
// project's file.
namespace focalstage {

/// How a number is shown and dragged.
struct NumberLook {
  std::string_view unit{};
  int digits = 3;
  double step = 0.005;
};

/// What the table of a struct says of a key.
struct KeyFacts {
  Value fresh;  ///< without a word in the file; null: nothing at all
  double least = -1e9;
  double most = 1e9;
  bool above_least = false;
  bool whole = false;
};

template <class Struct>
KeyFacts key_facts(std::string_view key) {
  static const Struct fresh{};
  KeyFacts facts;
  each_field<Struct>([&]<class CodecOf, class PathTo, class Needed>(const Field<CodecOf, PathTo, Needed>& field) {
    if (field.key != key) return;
    using Member = std::remove_cvref_t<decltype(field.path(fresh))>;
    facts.fresh = FieldCodec<CodecOf, Member>::write(field.path(fresh));
    facts.least = field.rule.low;
    facts.most = field.rule.high;
    facts.above_least = field.rule.above_low;
    facts.whole = std::is_same_v<Member, int> || std::is_same_v<Member, glm::ivec2>;
  });
  return facts;
}

/// Collects the rows of one thing.
class PropertyRows {
 public:
  /// `item`: the thing as the project's file has it.
  PropertyRows(const PropertyScope& scope, Thing thing, Value item);

  const PropertyScope& scope() const { return scope_; }
  const Thing& thing() const { return thing_; }
  /// The value at a key path of the item; null where there is none.
  const Value& at(std::string_view key) const;

  void group(std::string title);
  Property& add(Property::Kind kind, std::string label, Value value);
  Property& last() { return groups_.back().rows.back(); }

  /// A number at a key of the item: `Struct` is what holds the key's last name.
  template <class Struct>
  Property& number(std::string label, std::string key, const NumberLook& look) {
    const KeyFacts facts = key_facts<Struct>(last_name(key));
    return number_with(facts, std::move(label), std::move(key), look);
  }
  Property& number_with(const KeyFacts& facts, std::string label, std::string key, const NumberLook& look);
  Property& text(std::string label, std::string key);
  Property& flag(std::string label, std::string key);
  Property& choice(std::string label, std::string key, std::vector<PropertyChoice> choices);
  Property& colour(std::string label, std::string key, const Value& fresh);
  Property& shown(std::string label, std::string value);
  Property& action(std::string label, std::string command, Value args = {});

  std::vector<PropertyGroup> take() { return std::move(groups_); }

  /// The last step of a key path that is no index: "size_m" of "mesh/size_m/0".
  static std::string last_name(std::string_view key);

 private:
  const PropertyScope& scope_;
  Thing thing_;
  Value item_;
  std::vector<PropertyGroup> groups_;
};

// Rows that several kinds share.
void add_pose_rows(PropertyRows& rows);      ///< position and rotation at the frame in view
void add_size_rows(PropertyRows& rows);      ///< scale and extent
void add_image_rows(PropertyRows& rows);     ///< of an appearance that is a picture
void add_mesh_rows(PropertyRows& rows);      ///< kind, parameters, file
void add_process_rows(PropertyRows& rows);   ///< what is done to the mesh
void add_movement_rows(PropertyRows& rows);  ///< track and keys
void add_listed_rows(PropertyRows& rows);    ///< name, group, hidden, locked
void add_name_row(PropertyRows& rows);

// The kinds.
void add_surface_rows(PropertyRows& rows);
void add_object_rows(PropertyRows& rows);
void add_light_rows(PropertyRows& rows);
void add_projector_rows(PropertyRows& rows);
void add_viewer_rows(PropertyRows& rows);
void add_glasses_rows(PropertyRows& rows);
void add_sweep_rows(PropertyRows& rows);
void add_slices_rows(PropertyRows& rows);
void add_frames_rows(PropertyRows& rows);
void add_project_rows(PropertyRows& rows);

// Words.
std::string capitalised(std::string_view word);
/// "70 688"
std::string grouped_text(std::size_t number);
/// "0.50 m" for 2 D; "∞" for 0 and beyond.
std::string distance_text(double vergence_d);
std::string dioptre_text(double dioptres);
/// "6" or "6 left, 5 right"
std::string per_eye_text(std::size_t left, std::size_t right);

/// What of the stage the thing is; null where it is hidden or cannot be stood up.
const std::vector<Drawable>* drawables_of(const PropertyScope& scope, const Thing& thing);
std::size_t triangles_of(const std::vector<Drawable>& drawables);

}  // namespace focalstage
