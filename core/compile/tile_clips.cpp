#include "core/compile/tile_clips.h"

#include <algorithm>

namespace focalstage {
namespace {

/// The most and the least that a pixel wants in any channel.
struct Extremes {
  float most = 0.0f;
  float least = 0.0f;
};

Extremes extremes_of(const TileLight& light, int channels, int i) {
  Extremes all;
  for (int c = 0; c < channels; ++c) {
    all.most = std::max(all.most, light.channel[c][i]);
    all.least = std::min(all.least, light.channel[c][i]);
  }
  return all;
}

bool is_bright(float light) { return light > 1.0f + clip_tolerance; }
bool is_dark(float light) { return light < -clip_tolerance; }

}  // namespace

void compensate_content(const TileGain& gain, float leak, int channels, TileLight& light) {
  for (int c = 0; c < channels; ++c) {
    float* const channel = light.channel[c];
    for (int i = 0; i < tile_samples; ++i) channel[i] *= gain.content[c][i];
    if (!(leak > 0.0f)) continue;
    for (int i = 0; i < tile_samples; ++i) channel[i] -= leak * gain.leak[i] * light.weight[i];
  }
}

void scale_surface_light(const TileGain& gain, int channels, TileLight& light) {
  for (int c = 0; c < channels; ++c) {
    for (int i = 0; i < tile_samples; ++i) light.channel[c][i] *= gain.light[i];
  }
}

void add_light(const TileLight& from, int channels, TileLight& onto) {
  for (int c = 0; c < channels; ++c) {
    for (int i = 0; i < tile_samples; ++i) onto.channel[c][i] += from.channel[c][i];
  }
  onto.any = onto.any || from.any;
}

void count_asked(const TileLight& light, const TileMet& met, const std::vector<ViewDrawable>& surfaces, int channels,
                 std::vector<SurfaceAsked>& asked) {
  if (!met.any) return;
  for (int i = 0; i < tile_samples; ++i) {
    if (met.drawable[i] < 0) continue;
    const Extremes wanted = extremes_of(light, channels, i);
    if (wanted.most == 0.0f && wanted.least == 0.0f) continue;
    SurfaceAsked& surface = asked[surfaces[static_cast<std::size_t>(met.drawable[i])].owner];
    ++surface.lit_pixels;
    surface.most = std::max<double>(surface.most, wanted.most);
    surface.least = std::min<double>(surface.least, wanted.least);
    surface.too_bright += is_bright(wanted.most) ? 1 : 0;
    surface.too_dark += is_dark(wanted.least) ? 1 : 0;
    for (int c = 0; c < channels; ++c) {
      surface.bright_in[static_cast<std::size_t>(c)] += is_bright(light.channel[c][i]) ? 1 : 0;
      surface.dark_in[static_cast<std::size_t>(c)] += is_dark(light.channel[c][i]) ? 1 : 0;
    }
  }
}

void add_asked(const SurfaceAsked& more, SurfaceAsked& sum) {
  sum.lit_pixels += more.lit_pixels;
  sum.too_bright += more.too_bright;
  sum.too_dark += more.too_dark;
  for (std::size_t c = 0; c < 3; ++c) {
    sum.bright_in[c] += more.bright_in[c];
    sum.dark_in[c] += more.dark_in[c];
  }
  sum.most = std::max(sum.most, more.most);
  sum.least = std::min(sum.least, more.least);
}

ClipMap no_clips(int width_px, int height_px) {
  const std::size_t pixels = static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  return {width_px, height_px, std::vector<float>(pixels, 0.0f), std::vector<float>(pixels, 0.0f)};
}

void mark_clips(const TileLight& light, int channels, int column, int row, ClipMap& clips) {
  for (int i = 0; i < tile_samples; ++i) {
    const int x = column * tile_side + i % tile_side, y = row * tile_side + i / tile_side;
    if (x >= clips.width_px || y >= clips.height_px) continue;
    const Extremes wanted = extremes_of(light, channels, i);
    const std::size_t at =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(clips.width_px) + static_cast<std::size_t>(x);
    if (is_bright(wanted.most)) clips.bright[at] = std::max(clips.bright[at], wanted.most - 1.0f);
    if (is_dark(wanted.least)) clips.dark[at] = std::max(clips.dark[at], -wanted.least);
  }
}

}  // namespace focalstage
