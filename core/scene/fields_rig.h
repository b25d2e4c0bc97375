#pragma once

#include "core/scene/fields_placement.h"
#include "core/scene/per_eye_codec.h"
#include "core/scene/words.h"

// Viewer, glasses, sweep and projectors: what stands in the lab.
namespace focalstage {

template <>
struct Table<Viewer> {
  static constexpr auto fields = std::make_tuple(
      field("position_m", at(&Viewer::placement, &Placement::pose, &Rigid::position_m), Presence::always, anywhere_m),
      field("rotation_xyzw", at(&Viewer::placement, &Placement::pose, &Rigid::rotation), Presence::always),
      field("interpupillary_mm", at(&Viewer::interpupillary_mm), Presence::always, length_mm),
      field<PlacementKeysCodec>("keys", at(&Viewer::placement), Presence::optional),
      field("track", at(&Viewer::placement, &Placement::track), Presence::optional));
};

template <>
struct Table<LensHarmonic> {
  static constexpr auto fields = std::make_tuple(
      field("harmonic", at(&LensHarmonic::harmonic), Presence::required, {.low = 0, .high = 1000}),
      field("gain_d_per_a", at(&LensHarmonic::gain_d_per_a), Presence::required,
            {.low = 0, .high = 1e6, .above_low = true}),
      field("phase_deg", at(&LensHarmonic::phase_deg), Presence::always, {.low = -3.6e5, .high = 3.6e5}));
};

/// One lens: its harmonics, each once.
struct LensResponseCodec : Codec<LensResponse> {
  static bool read(Reading& reading, const Value& value, LensResponse& out, const Rule& rule);
};

template <>
struct Table<LensLimits> {
  static constexpr Rule current_a{.low = 0, .high = 10, .above_low = true};
  static constexpr auto fields =
      std::make_tuple(field("max_current_a", at(&LensLimits::max_current_a), Presence::always, current_a),
                      field("max_rms_current_a", at(&LensLimits::max_rms_current_a), Presence::always, current_a),
                      field("max_frequency_hz", at(&LensLimits::max_frequency_hz), Presence::optional, frequency_hz));
};

template <>
struct Table<Glasses> {
  using EyesCodec =
      PerEyeCodec<Glasses, LensResponse, &Glasses::lens_response, &Glasses::lens_response_unknown, LensResponseCodec>;
  static constexpr auto fields =
      std::make_tuple(field("lens_to_pupil_mm", at(&Glasses::lens_to_pupil_mm), Presence::always, length_mm),
                      field("lens_range_d", at(&Glasses::lens_range_d), Presence::always, power_d),
                      field("lens_aperture_mm", at(&Glasses::lens_aperture_mm), Presence::always, length_mm),
                      field("shutter_close_ms", at(&Glasses::shutter_close_ms), Presence::always, duration_ms),
                      field("shutter_open_ms", at(&Glasses::shutter_open_ms), Presence::always, duration_ms),
                      field<EyesCodec>("lens_response", at(), Presence::optional, {.most = 1001}),
                      field("lens_limits", at(&Glasses::lens_limits), Presence::optional));

  static bool check(Reading& reading, const Glasses& glasses);
};

template <>
struct Table<MeasuredWaveform> {
  static constexpr auto fields = std::make_tuple(
      field("power_d", at(&MeasuredWaveform::power_d), Presence::required, {.low = -1e3, .high = 1e3, .least = 8}),
      field("drive_a", at(&MeasuredWaveform::drive_a), Presence::required, {.low = -1e3, .high = 1e3, .least = 8}));

  static bool check(Reading& reading, const MeasuredWaveform& waveform);
};

/// "sine", or a measured period.
struct WaveformCodec {
  static bool read(Reading& reading, const Value& value, Waveform& out, const Rule& rule);
  static Value write(const Waveform& waveform);
  static void keys(KeyList& list) { list_fields<MeasuredWaveform>(list); }
};

template <>
struct Table<Sweep> {
  using EyesCodec = PerEyeCodec<Sweep, Waveform, &Sweep::waveform, &Sweep::waveform_unknown, WaveformCodec>;
  static constexpr auto fields =
      std::make_tuple(field("frequency_hz", at(&Sweep::frequency_hz), Presence::always, frequency_hz),
                      field("min_power_d", at(&Sweep::min_power_d), Presence::always, power_d),
                      field("max_power_d", at(&Sweep::max_power_d), Presence::always, power_d),
                      field<EyesCodec>("waveform", at(), Presence::always));

  static bool check(Reading& reading, const Sweep& sweep);
};

struct ColorModeWords {
  static constexpr std::array<std::pair<std::string_view, ColorMode>, 2> words{
      {{"gray", ColorMode::gray}, {"rgb", ColorMode::rgb}}};
};
template <>
struct Codec<ColorMode> : WordCodec<ColorMode, ColorModeWords> {};

struct PixelLayoutWords {
  static constexpr std::array<std::pair<std::string_view, PixelLayout>, 2> words{
      {{word_of(PixelLayout::square), PixelLayout::square}, {word_of(PixelLayout::diamond), PixelLayout::diamond}}};
};
template <>
struct Codec<PixelLayout> : WordCodec<PixelLayout, PixelLayoutWords> {};

template <>
struct Table<Projector> {
  static constexpr Rule offset_px{.low = -1e6, .high = 1e6};
  static constexpr auto fields = std::make_tuple(
      field("name", at(&Projector::name), Presence::required, a_name),
      field("model", at(&Projector::model), Presence::always, a_name),
      field("width_px", at(&Projector::width_px), Presence::always, {.low = 1, .high = 8192}),
      field("height_px", at(&Projector::height_px), Presence::always, {.low = 1, .high = 8192}),
      field("pixel_layout", at(&Projector::pixel_layout), Presence::optional),
      field("frames_per_second", at(&Projector::frames_per_second), Presence::always, frequency_hz),
      field("bits", at(&Projector::bits), Presence::always, {.low = 1, .high = 8}),
      field("color", at(&Projector::color), Presence::always),
      field("latency_ms", at(&Projector::latency_ms), Presence::always, duration_ms),
      field("gamma", at(&Projector::gamma), Presence::always, {.low = 0, .high = 100, .above_low = true}),
      field("transfer", at(&Projector::transfer), Presence::optional, {.low = 0, .high = 1, .most = 4096}),
      field("black_level", at(&Projector::black_level), Presence::optional, {.low = 0, .high = 0.5}),
      field("fx_px", at(&Projector::fx_px), Presence::always, length_px),
      field("fy_px", at(&Projector::fy_px), Presence::always, length_px),
      field("cx_px", at(&Projector::cx_px), Presence::always, offset_px),
      field("cy_px", at(&Projector::cy_px), Presence::always, offset_px),
      field("distortion", at(&Projector::distortion), Presence::always, {.low = -1e6, .high = 1e6, .most = 8}),
      field("position_m", at(&Projector::pose, &Rigid::position_m), Presence::always, anywhere_m),
      field("rotation_xyzw", at(&Projector::pose, &Rigid::rotation), Presence::always),
      field("exposure_ms", at(&Projector::exposure_ms), Presence::optional, {.low = 0, .high = 1e5, .above_low = true}),
      field("focus_m", at(&Projector::focus_m), Presence::optional, length_m),
      field("depth_of_field_d", at(&Projector::depth_of_field_d), Presence::optional,
            {.low = 0, .high = 1e3, .above_low = true}),
      field("lumens", at(&Projector::lumens), Presence::optional, {.low = 0, .high = 1e7, .above_low = true}),
      field("blend_margin_px", at(&Projector::blend_margin_px), Presence::optional,
            {.low = 0, .high = 4096, .above_low = true}));

  static bool check(Reading& reading, const Projector& projector);
};

}  // namespace focalstage
