#pragma once

#include "core/scene/fields_image.h"
#include "core/scene/fields_placement.h"
#include "core/scene/mesh_codec.h"

// Surfaces, objects and lights: what stands in the room.
namespace focalstage {

template <>
struct Table<CheckerAppearance> {
  static constexpr auto fields =
      std::make_tuple(field("squares", at(&CheckerAppearance::squares), Presence::always, {.low = 1, .high = 100'000}),
                      field("a", at(&CheckerAppearance::a), Presence::always, fraction),
                      field("b", at(&CheckerAppearance::b), Presence::always, fraction));
};

/// {"unlit": ..}, {"checker": ..} or {"image": ..}; without any, the material of the file.
struct AppearanceCodec {
  static bool read(Reading& reading, const Value& value, Object& out, const Rule& rule);
  static Value write(const Object& object);
  static void keys(KeyList& list);
};

template <>
struct Table<FileAlbedo> {
  static constexpr auto fields = std::make_tuple(field("file", at(&FileAlbedo::file), Presence::required, a_name));
};

/// A colour; {"file": ..}; or "material".
template <>
struct Codec<Albedo> {
  static bool read(Reading& reading, const Value& value, Albedo& out, const Rule& rule);
  static Value write(const Albedo& albedo);
  static void keys(KeyList& list) { list_fields<FileAlbedo>(list); }
};

struct DepthModeWords {
  static constexpr std::array<std::pair<std::string_view, DepthMode>, 4> words{{{"placed", DepthMode::placed},
                                                                                {"fixed", DepthMode::fixed},
                                                                                {"offset", DepthMode::offset},
                                                                                {"slice", DepthMode::slice}}};
};
template <>
struct Codec<DepthMode> : WordCodec<DepthMode, DepthModeWords> {};

struct NeedsVergence {
  constexpr bool operator()(const Depth& depth) const {
    return depth.mode == DepthMode::fixed || depth.mode == DepthMode::offset;
  }
};
struct NeedsIndex {
  constexpr bool operator()(const Depth& depth) const { return depth.mode == DepthMode::slice; }
};

template <>
struct Table<Depth> {
  static constexpr auto fields =
      std::make_tuple(field("mode", at(&Depth::mode), Presence::required),
                      field("vergence_d", at(&Depth::vergence_d), Presence::optional, power_d, NeedsVergence{}),
                      field("index", at(&Depth::index), Presence::optional, {.low = 0, .high = 63}, NeedsIndex{}));
};

template <>
struct Table<Surface> {
  static constexpr auto fields = std::make_tuple(
      field("name", at(&Surface::name), Presence::required, a_name),
      field("mesh", at(&Surface::mesh), Presence::required),
      field("position_m", at(&Surface::placement, &Placement::pose, &Rigid::position_m), Presence::always, anywhere_m),
      field("rotation_xyzw", at(&Surface::placement, &Placement::pose, &Rigid::rotation), Presence::always),
      field("scale", at(&Surface::scale), Presence::optional, length_m),
      field("illumination", at(&Surface::illumination), Presence::always, fraction),
      field("albedo", at(&Surface::albedo), Presence::optional, fraction),
      field<PlacementKeysCodec>("keys", at(&Surface::placement), Presence::optional),
      field("track", at(&Surface::placement, &Placement::track), Presence::optional),
      field("group", at(&Surface::group), Presence::optional),
      field("hidden", at(&Surface::hidden), Presence::optional),
      field("locked", at(&Surface::locked), Presence::optional));
};

template <>
struct Table<Object> {
  static constexpr auto fields = std::make_tuple(
      field("name", at(&Object::name), Presence::required, a_name),
      field("mesh", at(&Object::mesh), Presence::required),
      field("position_m", at(&Object::placement, &Placement::pose, &Rigid::position_m), Presence::always, anywhere_m),
      field("rotation_xyzw", at(&Object::placement, &Placement::pose, &Rigid::rotation), Presence::always),
      field("scale", at(&Object::scale), Presence::always, length_m),
      field<AppearanceCodec>("appearance", at(), Presence::optional),
      field("depth", at(&Object::depth), Presence::always),
      field<PlacementKeysCodec>("keys", at(&Object::placement), Presence::optional),
      field("track", at(&Object::placement, &Placement::track), Presence::optional),
      field("group", at(&Object::group), Presence::optional), field("hidden", at(&Object::hidden), Presence::optional),
      field("locked", at(&Object::locked), Presence::optional));
};

struct LightKindWords {
  static constexpr std::array<std::pair<std::string_view, LightKind>, 3> words{
      {{"sun", LightKind::sun}, {"point", LightKind::point}, {"sky", LightKind::sky}}};
};
template <>
struct Codec<LightKind> : WordCodec<LightKind, LightKindWords> {};

/// A light may come without a name; `name_lights` then gives it one.
template <>
struct Table<Light> {
  static constexpr auto fields = std::make_tuple(
      field("name", at(&Light::name), Presence::always, a_name), field("kind", at(&Light::kind), Presence::required),
      field("position_m", at(&Light::position_m), Presence::optional, anywhere_m),
      field("direction", at(&Light::direction), Presence::optional, anywhere_m),
      field("color", at(&Light::color), Presence::always, brightness),
      field("intensity", at(&Light::intensity), Presence::always, brightness));

  static bool check(Reading& reading, const Light& light);
};

/// Calls the lights without a name "light 1", "light 2"... by their places.
void name_lights(std::vector<Light>& lights);

}  // namespace focalstage
