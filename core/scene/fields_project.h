#pragma once

#include "core/scene/fields_rig.h"
#include "core/scene/fields_things.h"

// Slices, frames, cues, and the project that holds them all.
namespace focalstage {

struct AssignmentWords {
  static constexpr std::array<std::pair<std::string_view, Assignment>, 3> words{
      {{"nearest", Assignment::nearest}, {"linear", Assignment::linear}, {"optimal", Assignment::optimal}}};
};
template <>
struct Codec<Assignment> : WordCodec<Assignment, AssignmentWords> {};

struct BreathingWords {
  static constexpr std::array<std::pair<std::string_view, Breathing>, 3> words{
      {{"exact", Breathing::exact}, {"planar", Breathing::planar}, {"off", Breathing::off}}};
};
template <>
struct Codec<Breathing> : WordCodec<Breathing, BreathingWords> {};

struct CompensationModeWords {
  static constexpr std::array<std::pair<std::string_view, CompensationMode>, 3> words{
      {{"off", CompensationMode::off}, {"albedo", CompensationMode::albedo}, {"even", CompensationMode::even}}};
};
template <>
struct Codec<CompensationMode> : WordCodec<CompensationMode, CompensationModeWords> {};

template <>
struct Table<Compensation> {
  static constexpr auto fields = std::make_tuple(
      field("mode", at(&Compensation::mode), Presence::always),
      field("white", at(&Compensation::white), Presence::always, {.low = 0, .high = 1e3, .above_low = true}),
      field("reference_m", at(&Compensation::reference_m), Presence::optional, length_m));
};

template <>
struct Table<Slices> {
  static constexpr auto fields = std::make_tuple(
      field("powers_d", at(&Slices::powers_d), Presence::required, {.low = -1e6, .high = 1e6, .least = 1, .most = 64}),
      field("assignment", at(&Slices::assignment), Presence::always),
      field("breathing", at(&Slices::breathing), Presence::always),
      field("samples_per_pixel", at(&Slices::samples_per_pixel), Presence::always, {.low = 1, .high = 16}),
      field("compensation", at(&Slices::compensation), Presence::optional));

  static bool check(Reading& reading, const Slices& slices);
};

template <>
struct Table<Frames> {
  static constexpr auto fields =
      std::make_tuple(field("count", at(&Frames::count), Presence::always, {.low = 1, .high = 1e6}),
                      field("rate_hz", at(&Frames::rate_hz), Presence::always, frequency_hz));
};

template <>
struct Table<Cue> {
  static constexpr auto fields =
      std::make_tuple(field("name", at(&Cue::name), Presence::required, a_name),
                      field("time_s", at(&Cue::time_s), Presence::required, {.low = 0, .high = 1e6}));
};

template <>
struct Table<Project> {
  static constexpr Rule things{.most = 10'000};
  static constexpr auto fields = std::make_tuple(
      field("name", at(&Project::name), Presence::always), field("viewer", at(&Project::viewer), Presence::always),
      field("glasses", at(&Project::glasses), Presence::always), field("sweep", at(&Project::sweep), Presence::always),
      field("projectors", at(&Project::projectors), Presence::required, {.most = 16}),
      field("slices", at(&Project::slices), Presence::required),
      field("frames", at(&Project::frames), Presence::always),
      field("surfaces", at(&Project::surfaces), Presence::always, things),
      field("objects", at(&Project::objects), Presence::always, things),
      field("lights", at(&Project::lights), Presence::optional, things),
      field("cues", at(&Project::cues), Presence::optional, things),
      field("ambient_lux", at(&Project::ambient_lux), Presence::optional, brightness));
};

/// What must hold between the parts: names once in their list, slices that exist, powers a lens can mean.
bool check_project(Reading& reading, const Project& project);

}  // namespace focalstage
