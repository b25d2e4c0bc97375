#pragma once

#include "core/scene/fields.h"
#include "core/scene/project.h"
#include "core/scene/rules.h"

// A mesh is a file or a primitive; each primitive has a table of its own parameters.
namespace focalstage {

template <>
struct Table<FileMesh> {
  static constexpr std::string_view primitive{};
  static constexpr auto fields = std::make_tuple(field("file", at(&FileMesh::file), Presence::required, a_name));
};
template <>
struct Table<PlaneMesh> {
  static constexpr std::string_view primitive = "plane";
  static constexpr auto fields = std::make_tuple(field("size_m", at(&PlaneMesh::size_m), Presence::always, length_m));
};
template <>
struct Table<BoxMesh> {
  static constexpr std::string_view primitive = "box";
  static constexpr auto fields = std::make_tuple(field("size_m", at(&BoxMesh::size_m), Presence::always, length_m));
};
template <>
struct Table<SphereMesh> {
  static constexpr std::string_view primitive = "sphere";
  static constexpr auto fields =
      std::make_tuple(field("radius_m", at(&SphereMesh::radius_m), Presence::always, length_m));
};
template <>
struct Table<CornerMesh> {
  static constexpr std::string_view primitive = "corner";
  static constexpr auto fields = std::make_tuple(
      field("size_m", at(&CornerMesh::size_m), Presence::always, length_m),
      field("angle_deg", at(&CornerMesh::angle_deg), Presence::always, {.low = 0, .high = 360, .above_low = true}));
};
template <>
struct Table<StepMesh> {
  static constexpr std::string_view primitive = "step";
  static constexpr auto fields = std::make_tuple(field("size_m", at(&StepMesh::size_m), Presence::always, length_m),
                                                 field("depth_m", at(&StepMesh::depth_m), Presence::always, length_m));
};
template <>
struct Table<TeapotMesh> {
  static constexpr std::string_view primitive = "teapot";
  static constexpr auto fields = std::make_tuple();
};
template <>
struct Table<RabbitMesh> {
  static constexpr std::string_view primitive = "rabbit";
  static constexpr auto fields = std::make_tuple();
};

template <>
struct Codec<MeshSource> {
  static bool read(Reading& reading, const Value& value, MeshSource& out, const Rule& rule);
  static Value write(const MeshSource& mesh);
  static void keys(KeyList& list);
};

/// The keys that the shape `value` names brings along, "file" or "primitive" included.
std::vector<std::string_view> shape_keys(const Value& value);

}  // namespace focalstage
