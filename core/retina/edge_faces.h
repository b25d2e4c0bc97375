#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/retina/surface_raster.h"

namespace focalstage {

/// Where an edge runs through a pixel, faces matter that no pixel's centre sees: slivers, sides seen at a graze. Lists,
/// by cells of a raster, of all faces that can touch them; only for cells that were asked for.
class EdgeFaces {
 public:
  struct Pixel {
    int column = 0;
    int row = 0;
  };

  EdgeFaces(const SurfaceRaster& raster, std::span<const Pixel> edges);

  /// Faces that may touch the pixel, by rising index.
  std::span<const std::uint32_t> around(Pixel pixel) const;

 private:
  static constexpr int side_px = 8;

  std::size_t cell(int column, int row) const {
    return static_cast<std::size_t>(row / side_px) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column / side_px);
  }
  template <class Visit>
  void visit_cells(const PixelBox& box, const Visit& visit) const;

  int columns_;
  std::vector<std::uint8_t> asked_;
  std::vector<std::size_t> begin_;  ///< of each cell's faces; one more for the end
  std::vector<std::uint32_t> faces_;
};

}  // namespace focalstage
