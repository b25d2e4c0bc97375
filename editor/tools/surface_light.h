#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <glm/vec2.hpp>

#include "core/compile/frame.h"
#include "editor/tools/pick.h"

namespace focalstage {

/// What a bystander sees of a show on its surfaces: all images together, as sRGB, with an edge of one pixel that holds
/// the surface's own tone alone.
struct LightPicture {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> rgb;  ///< rows from the bottom, as OpenGL has them
};

/// The mean over both eyes of the sums over all slices, in linear light, on top of `tone` (linear) everywhere.
LightPicture light_picture(const FrameImages& images, const std::vector<ImageSpec>& specs, int bits, double gamma,
                           double tone);

/// A mesh cut so finely that a projector's picture can be pinned to its vertices: no edge is longer than a fortieth of
/// the whole. The same mesh where it is fine enough, or too large to be made larger.
std::shared_ptr<const Mesh> finely_cut(const std::shared_ptr<const Mesh>& mesh);

/// Where a projector's picture falls on the vertices of a drawable.
struct PinnedPicture {
  std::vector<glm::vec2> uv;          ///< from the lower left corner of the picture; beyond 0..1 outside it
  std::vector<std::uint8_t> reached;  ///< 1: nothing stands between the projector and the vertex
};

PinnedPicture pinned_picture(const Stage& stage, const ProjectorModel& projector, const Mesh& mesh,
                             const glm::dmat4& world_from_mesh, Picker& picker);

}  // namespace focalstage
