#include "core/retina/return_painter.h"

#include <algorithm>
#include <optional>

#include "core/retina/exposure_sampler.h"

namespace focalstage {
namespace {

template <int channels>
glm::vec3 in_colour(const std::array<float, channels>& light) {
  if constexpr (channels == 1) {
    return glm::vec3(light[0]);
  } else {
    return {light[0], light[1], light[2]};
  }
}

/// One pass on its way into the layers.
template <int channels>
class ReturnPainter {
 public:
  ReturnPainter(const PaintWork& work, std::size_t pass, BlurLayers& layers)
      : work_(work), pass_(work.passes[pass]), map_(*work.maps[pass]), layers_(layers) {
    if (pass_.is_ambient()) return;
    const ExposureLight* const light = work.lights[pass_.exposure];
    if (!light || !light->any()) return;
    whole_.emplace(*light);
    part_.emplace(work.input.exposures[pass_.exposure].codes, work.input.projector.width_px, work.light_of_code);
  }

  void row(int row) {
    const std::size_t first = static_cast<std::size_t>(row) * static_cast<std::size_t>(map_.grid.width_px);
    const std::vector<EdgePixel>& edges = map_.edges[static_cast<std::size_t>(row)];
    std::size_t edge = 0;
    for (int column = 0; column < map_.grid.width_px; ++column) {
      if (edge < edges.size() && static_cast<int>(edges[edge].column) == column) {
        add_parts(column, row, edges[edge], edge);
        ++edge;
        continue;
      }
      const std::size_t at = first + static_cast<std::size_t>(column);
      const SliceSpot& spot = map_.spots[at];
      if (!counts(spot)) continue;
      const auto light = whole_ ? whole_->at(spot) : std::array<float, channels>{};
      add(column, row, spot, map_.returns.empty() ? SpotReturn{} : map_.returns[at], light, pass_.share);
    }
  }

 private:
  /// The projector lights what its rays reach, the room all that is there.
  bool counts(const SliceSpot& spot) const { return pass_.is_ambient() ? spot.seen() : spot.lit(); }

  void add_parts(int column, int row, const EdgePixel& pixel, std::size_t edge) {
    const float share = pass_.share / static_cast<float>(pixel.spots.size());
    for (std::size_t i = 0; i < pixel.spots.size(); ++i) {
      const SliceSpot& part = pixel.spots[i];
      if (!counts(part)) continue;
      std::array<float, channels> light{};
      if (whole_) light = part.spread_px <= 0.0f ? part_->at(part.x_px, part.y_px) : whole_->at(part);
      const SpotReturn back =
          map_.returns.empty() ? SpotReturn{} : map_.edge_returns[static_cast<std::size_t>(row)][edge][i];
      add(column, row, part, back, light, share);
    }
  }

  void add(int column, int row, const SliceSpot& spot, const SpotReturn& back, const std::array<float, channels>& light,
           float share) {
    const auto black = static_cast<float>(work_.input.black_level);
    const glm::vec3 given =
        pass_.is_ambient() ? glm::vec3(1.0f) : back.density * (black + (1.0f - black) * in_colour<channels>(light));
    const float open = share * work_.rim.open_share(map_.grid.look(column, row), spot.vergence_d);
    const glm::vec3 seen = open * back.albedo * given;
    if (!(seen.r + seen.g + seen.b > 0.0f)) return;
    const std::array<float, 3> rgb{seen.r, seen.g, seen.b};
    if (work_.focus.channels() == 1) {
      layers_.add<3>(column, row, BlurLayers::share(work_.focus.radius_px(spot.vergence_d, 0)), rgb.data());
      return;
    }
    for (int c = 0; c < 3; ++c) {
      const BlurShare blur = BlurLayers::share(work_.focus.radius_px(spot.vergence_d, c));
      layers_.add_channel(column, row, blur, c, rgb[static_cast<std::size_t>(c)]);
    }
  }

  const PaintWork& work_;
  const Pass& pass_;
  const SliceMap& map_;
  std::optional<ExposureSampler<channels>> whole_;  ///< none: dark
  std::optional<CodeSampler<channels>> part_;
  BlurLayers& layers_;
};

template <int channels>
void paint(const PaintWork& work, int row, BlurLayers& layers) {
  for (std::size_t pass = 0; pass < work.passes.size(); ++pass) {
    if (work.passes[pass].is_ambient() || work.maps[pass]->any) ReturnPainter<channels>(work, pass, layers).row(row);
  }
}

}  // namespace

void paint_returned_row(const PaintWork& work, int row, BlurLayers& layers) {
  (work.input.channels == 1 ? paint<1> : paint<3>)(work, row, layers);
}

bool needs_returns(const PaintWork& work) {
  const auto asks = [](const SliceMap* map) { return !map->returns.empty(); };
  return work.input.black_level > 0.0 || !work.input.ambient.empty() ||
         std::any_of(work.maps.begin(), work.maps.end(), asks);
}

}  // namespace focalstage
