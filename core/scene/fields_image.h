#pragma once

#include "core/scene/fields.h"
#include "core/scene/project.h"
#include "core/scene/rules.h"

// Pictures and sequences of them.
namespace focalstage {

struct SequenceEndWords {
  static constexpr std::array<std::pair<std::string_view, SequenceEnd>, 4> words{
      {{"loop", SequenceEnd::loop},
       {"hold", SequenceEnd::hold},
       {"once", SequenceEnd::once},
       {"ping-pong", SequenceEnd::ping_pong}}};
};
template <>
struct Codec<SequenceEnd> : WordCodec<SequenceEnd, SequenceEndWords> {};

struct WrapWords {
  static constexpr std::array<std::pair<std::string_view, Wrap>, 3> words{
      {{"clamp", Wrap::clamp}, {"repeat", Wrap::repeat}, {"mirror", Wrap::mirror}}};
};
template <>
struct Codec<Wrap> : WordCodec<Wrap, WrapWords> {};

struct MagnifyWords {
  static constexpr std::array<std::pair<std::string_view, Magnify>, 2> words{
      {{"linear", Magnify::linear}, {"nearest", Magnify::nearest}}};
};
template <>
struct Codec<Magnify> : WordCodec<Magnify, MagnifyWords> {};

struct ColorSpaceWords {
  static constexpr std::array<std::pair<std::string_view, ColorSpace>, 2> words{
      {{"srgb", ColorSpace::srgb}, {"linear", ColorSpace::linear}}};
};
template <>
struct Codec<ColorSpace> : WordCodec<ColorSpace, ColorSpaceWords> {};

struct IsSequence {
  constexpr bool operator()(const ImageAppearance& image) const { return image.count > 0; }
};

template <>
struct Table<ImageAppearance> {
  static constexpr auto fields =
      std::make_tuple(field("file", at(&ImageAppearance::file), Presence::required, a_name),
                      field("count", at(&ImageAppearance::count), Presence::optional, {.low = 1, .high = 10'000}),
                      field("first", at(&ImageAppearance::first), Presence::optional, {.low = 0, .high = 999'999'999}),
                      field("rate_hz", at(&ImageAppearance::rate_hz), Presence::optional,
                            {.low = 0.0, .high = 1e3, .above_low = true}, IsSequence{}),
                      field("start_s", at(&ImageAppearance::start_s), Presence::optional, time_s),
                      field("loop", at(&ImageAppearance::end), Presence::optional),
                      field("wrap", at(&ImageAppearance::wrap), Presence::optional),
                      field("filter", at(&ImageAppearance::filter), Presence::optional),
                      field("color_space", at(&ImageAppearance::color_space), Presence::optional),
                      field("lit", at(&ImageAppearance::lit), Presence::optional),
                      field("alpha_cutoff", at(&ImageAppearance::alpha_cutoff), Presence::optional, fraction));

  /// Whether a sequence's file says where its numbers go.
  static bool check(Reading& reading, const ImageAppearance& image);
};

}  // namespace focalstage
