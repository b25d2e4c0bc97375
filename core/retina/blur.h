#pragma once

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

  static BlurShare share(float radius_px);

  /// For radii from `least_px` to `most_px`.
  BlurLayers(int width_px, int height_px, int channels, float least_px, float most_px);

  void add(int column, int row, const BlurShare& share, const float* light) {
    for (int c = 0; c < channels_; ++c) {
      if (share.next < 1.0f) at(share.layer, c, row)[column] += (1.0f - share.next) * light[c];
      if (share.next > 0.0f) at(share.layer + 1, c, row)[column] += share.next * light[c];
    }
  }

  /// The blurred sum of all layers: one plane per channel. Unfinished after a stop request.
  std::vector<float> blurred(const std::stop_token& stop) const;

 private:
  float* at(int layer, int channel, int row) { return plane(layer, channel) + static_cast<std::size_t>(row) * width_; }
  float* plane(int layer, int channel) {
    return &light_[(static_cast<std::size_t>(layer - first_) * static_cast<std::size_t>(channels_) +
                    static_cast<std::size_t>(channel)) *
                   width_ * height_];
  }

  std::size_t width_;
  std::size_t height_;
  int channels_;
  int first_;  ///< layer
  int count_;
  std::vector<float> light_;  ///< [layer][channel][row][column]
};

}  // namespace focalstage
