#include "core/retina/edge_faces.h"

namespace focalstage {

template <class Visit>
void EdgeFaces::visit_cells(const PixelBox& box, const Visit& visit) const {
  if (box.empty()) return;
  for (int row = box.row_begin / side_px; row <= (box.row_end - 1) / side_px; ++row) {
    for (int column = box.column_begin / side_px; column <= (box.column_end - 1) / side_px; ++column) {
      const std::size_t own = cell(column * side_px, row * side_px);
      if (asked_[own] != 0) visit(own);
    }
  }
}

EdgeFaces::EdgeFaces(const SurfaceRaster& raster, std::span<const Pixel> edges)
    : columns_((raster.grid.width_px + side_px - 1) / side_px) {
  const int rows = (raster.grid.height_px + side_px - 1) / side_px;
  const std::size_t cells = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows);
  asked_.assign(cells, 0);
  begin_.assign(cells + 1, 0);
  if (edges.empty()) return;
  for (const Pixel& pixel : edges) asked_[cell(pixel.column, pixel.row)] = 1;
  for (const PixelBox& box : raster.boxes) {
    visit_cells(box, [&](std::size_t own) { ++begin_[own + 1]; });
  }
  for (std::size_t i = 0; i < cells; ++i) begin_[i + 1] += begin_[i];
  faces_.resize(begin_.back());
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t face = 0; face < raster.boxes.size(); ++face) {
    visit_cells(raster.boxes[face], [&](std::size_t own) { faces_[next[own]++] = static_cast<std::uint32_t>(face); });
  }
}

std::span<const std::uint32_t> EdgeFaces::around(Pixel pixel) const {
  const std::size_t own = cell(pixel.column, pixel.row);
  return std::span(faces_).subspan(begin_[own], begin_[own + 1] - begin_[own]);
}

}  // namespace focalstage
