#include "core/retina/pass_painter.h"

#include "core/retina/exposure_sampler.h"
#include "core/retina/slice_light.h"

namespace focalstage {
namespace {

/// One pass on its way into the layers: all channels alike, or each by its own colour's focus.
template <int channels>
class PassPainter {
 public:
  PassPainter(const PaintWork& work, std::size_t pass, BlurLayers& layers)
      : work_(work),
        map_(*work.maps[pass]),
        whole_(*work.lights[work.passes[pass].exposure]),
        part_(work.input.exposures[work.passes[pass].exposure].codes, work.input.projector.width_px,
              work.light_of_code),
        share_(work.passes[pass].share),
        layers_(layers) {}

  void row(int row) {
    const SliceSpot* spots = &map_.spots[static_cast<std::size_t>(row) * static_cast<std::size_t>(map_.grid.width_px)];
    auto edge = map_.edges[static_cast<std::size_t>(row)].begin();
    const auto edges_end = map_.edges[static_cast<std::size_t>(row)].end();
    for (int column = 0; column < map_.grid.width_px; ++column) {
      if (edge == edges_end || static_cast<int>(edge->column) != column) {
        if (spots[column].lit()) add(column, row, spots[column], whole_.at(spots[column]), share_);
        continue;
      }
      for (const SliceSpot& part : edge->spots) {
        if (!part.lit()) continue;
        const bool sharp = part.spread_px <= 0.0f;
        add(column, row, part, sharp ? part_.at(part.x_px, part.y_px) : whole_.at(part),
            share_ / static_cast<float>(edge->spots.size()));
      }
      ++edge;
    }
  }

 private:
  void add(int column, int row, const SliceSpot& spot, std::array<float, channels> seen, float share) {
    float sum = 0.0f;
    for (const float one : seen) sum += one;
    if (!(sum > 0.0f)) return;
    const float open = share * work_.rim.open_share(map_.grid.look(column, row), spot.vergence_d);
    for (float& one : seen) one *= open;
    if (work_.focus.channels() == 1) {
      layers_.add<channels>(column, row, BlurLayers::share(work_.focus.radius_px(spot.vergence_d, 0)), seen.data());
      return;
    }
    for (int c = 0; c < 3; ++c) {
      const BlurShare blur = BlurLayers::share(work_.focus.radius_px(spot.vergence_d, c));
      layers_.add_channel(column, row, blur, c, seen[channels == 3 ? static_cast<std::size_t>(c) : 0]);
    }
  }

  const PaintWork& work_;
  const SliceMap& map_;
  ExposureSampler<channels> whole_;
  CodeSampler<channels> part_;
  float share_;
  BlurLayers& layers_;
};

template <int channels>
void paint(const PaintWork& work, int row, BlurLayers& layers) {
  for (std::size_t pass = 0; pass < work.passes.size(); ++pass) {
    const ExposureLight* light = work.lights[work.passes[pass].exposure];
    if (light && light->any()) PassPainter<channels>(work, pass, layers).row(row);
  }
}

}  // namespace

void paint_row(const PaintWork& work, int row, BlurLayers& layers) {
  (work.input.channels == 1 ? paint<1> : paint<3>)(work, row, layers);
}

}  // namespace focalstage
