#pragma once

#include <array>
#include <cstddef>
#include <stop_token>
#include <vector>

namespace focalstage {

/// A spot's place between two layers of like blur.
struct BlurShare {
  int layer = 0;      ///< and the next
  float next = 0.0f;  ///< the share of the next; by the square of the radius, which keeps the disc's spread exact
};

/// Light sorted by how far it spreads, then spread. Light of one blur radius goes to the two layers whose radii embrace
/// it; each layer is convolved once with its disc, however many slices put light there. Layers of wide discs are
/// blurred at half, quarter.. size with what the resizing itself spreads taken off. Light that leaves the grid is lost;
/// within, the sum is kept.
class BlurLayers {
 public:
  static constexpr float most_radius_px = 128.0f;  ///< wider discs are shown as wide as this

  static BlurShare share(float radius_px) {
    const float radius = radius_px < most_radius_px ? radius_px : most_radius_px;
    const Step& step = steps[static_cast<std::size_t>(radius * 4.0f)];
    return {step.layer, (radius * radius - step.low_squared) * step.per_squared};
  }

  /// For radii from `least_px` to `most_px`.
  BlurLayers(int width_px, int height_px, int channels, float least_px, float most_px);

  template <int channels>
  void add(int column, int row, const BlurShare& share, const float* light) {
    float* const low = &light_[(static_cast<std::size_t>((share.layer - first_) * channels) * height_ +
                                static_cast<std::size_t>(row)) *
                                   width_ +
                               static_cast<std::size_t>(column)];
    const std::size_t plane = width_ * height_;
    for (std::size_t c = 0; c < channels; ++c) {
      const float next = share.next * light[c];
      low[c * plane] += light[c] - next;
      low[(channels + c) * plane] += next;
    }
  }

  void add_channel(int column, int row, const BlurShare& share, int channel, float light) {
    const std::size_t plane = width_ * height_;
    float* const low = &light_[static_cast<std::size_t>((share.layer - first_) * channels_ + channel) * plane +
                               static_cast<std::size_t>(row) * width_ + static_cast<std::size_t>(column)];
    const float next = share.next * light;
    low[0] += light - next;
    low[static_cast<std::size_t>(channels_) * plane] += next;
  }

  /// The blurred sum of all layers: one plane per channel. Unfinished after a stop request.
  std::vector<float> blurred(const std::stop_token& stop) const;

 private:
  /// From the layer below a quarter of a pixel to the next.
  struct Step {
    int layer = 0;
    float low_squared = 0.0f;
    float per_squared = 0.0f;
  };
  static std::array<Step, 513> make_steps();
  static const std::array<Step, 513> steps;

  std::size_t width_;
  std::size_t height_;
  int channels_;
  int first_;  ///< layer
  int count_;
  std::vector<float> light_;  ///< [layer][channel][row][column]
};

}  // namespace focalstage
