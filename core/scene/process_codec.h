#pragma once

#include "core/scene/fields.h"
#include "core/scene/process.h"
#include "core/scene/rules.h"

// Each step has a name and a table of its own settings.
namespace focalstage {

template <>
struct Table<WeldStep> {
  static constexpr std::string_view step = "weld";
  static constexpr auto fields =
      std::make_tuple(field("tolerance_mm", at(&WeldStep::tolerance_mm), Presence::always, {.low = 0.0, .high = 1e3}));
};
template <>
struct Table<CleanStep> {
  static constexpr std::string_view step = "clean";
  static constexpr auto fields = std::make_tuple();
};
template <>
struct Table<DropFinsStep> {
  static constexpr std::string_view step = "drop-fins";
  static constexpr auto fields = std::make_tuple();
};
template <>
struct Table<DropBitsStep> {
  static constexpr std::string_view step = "drop-bits";
  static constexpr auto fields =
      std::make_tuple(field("least_share", at(&DropBitsStep::least_share), Presence::always, fraction));
};
template <>
struct Table<FixWindingStep> {
  static constexpr std::string_view step = "fix-winding";
  static constexpr auto fields = std::make_tuple();
};
template <>
struct Table<FlipStep> {
  static constexpr std::string_view step = "flip";
  static constexpr auto fields = std::make_tuple();
};
template <>
struct Table<FillHolesStep> {
  static constexpr std::string_view step = "fill-holes";
  static constexpr auto fields = std::make_tuple(
      field("longest_mm", at(&FillHolesStep::longest_mm), Presence::optional, {.low = 0.0, .high = 1e9}));
};
template <>
struct Table<KeepPartStep> {
  static constexpr std::string_view step = "keep-part";
  static constexpr auto fields =
      std::make_tuple(field("part", at(&KeepPartStep::part), Presence::always, {.low = 0, .high = 1'000'000}),
                      field("fold_deg", at(&KeepPartStep::fold_deg), Presence::always, {.low = 0, .high = 180}));
};
template <>
struct Table<DecimateStep> {
  static constexpr std::string_view step = "decimate";
  static constexpr auto fields = std::make_tuple(
      field("triangles", at(&DecimateStep::triangles), Presence::optional, {.low = 1, .high = 16'777'216}),
      field("error_mm", at(&DecimateStep::error_mm), Presence::optional, length_mm));

  static bool check(Reading& reading, const DecimateStep& step);
};
template <>
struct Table<SmoothStep> {
  static constexpr std::string_view step = "smooth";
  static constexpr auto fields =
      std::make_tuple(field("rounds", at(&SmoothStep::rounds), Presence::always, {.low = 1, .high = 1000}),
                      field("feature_deg", at(&SmoothStep::feature_deg), Presence::always, {.low = 0, .high = 180}));
};

struct SubdivisionWords {
  static constexpr std::array<std::pair<std::string_view, Subdivision>, 2> words{
      {{"loop", Subdivision::loop}, {"sqrt3", Subdivision::sqrt3}}};
};
template <>
struct Codec<Subdivision> : WordCodec<Subdivision, SubdivisionWords> {};

template <>
struct Table<SubdivideStep> {
  static constexpr std::string_view step = "subdivide";
  static constexpr auto fields =
      std::make_tuple(field("scheme", at(&SubdivideStep::scheme), Presence::always),
                      field("rounds", at(&SubdivideStep::rounds), Presence::always, {.low = 1, .high = 8}));
};

template <>
struct Table<UvPlaneStep> {
  static constexpr std::string_view step = "uv-plane";
  static constexpr auto fields =
      std::make_tuple(field("position_m", at(&UvPlaneStep::pose, &Rigid::position_m), Presence::always, anywhere_m),
                      field("rotation_xyzw", at(&UvPlaneStep::pose, &Rigid::rotation), Presence::always),
                      field("size_m", at(&UvPlaneStep::size_m), Presence::optional, length_m));
};
template <>
struct Table<UvProjectorStep> {
  static constexpr std::string_view step = "uv-projector";
  static constexpr Rule pixels{.low = 1, .high = 65536};
  static constexpr auto fields =
      std::make_tuple(field("position_m", at(&UvProjectorStep::pose, &Rigid::position_m), Presence::always, anywhere_m),
                      field("rotation_xyzw", at(&UvProjectorStep::pose, &Rigid::rotation), Presence::always),
                      field("width_px", at(&UvProjectorStep::width_px), Presence::always, pixels),
                      field("height_px", at(&UvProjectorStep::height_px), Presence::always, pixels),
                      field("fx_px", at(&UvProjectorStep::fx_px), Presence::always, length_px),
                      field("fy_px", at(&UvProjectorStep::fy_px), Presence::always, length_px),
                      field("cx_px", at(&UvProjectorStep::cx_px), Presence::always, {.low = -1e6, .high = 1e6}),
                      field("cy_px", at(&UvProjectorStep::cy_px), Presence::always, {.low = -1e6, .high = 1e6}));
};

template <>
struct Codec<ProcessStep> {
  static bool read(Reading& reading, const Value& value, ProcessStep& out, const Rule& rule);
  static Value write(const ProcessStep& step);
  static void keys(KeyList& list);
};

/// The step's name, as a project writes it.
std::string_view name_of(const ProcessKind& step);

/// The settings that the step `value` names brings along.
std::vector<std::string_view> step_keys(const Value& value);

}  // namespace focalstage
