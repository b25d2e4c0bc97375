#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "tests/exact/caster.h"

// Light followed the way it runs: out of a projector pixel, from the surface, bent by a thin lens, into the pupil.
// Shares no code with core/optics and knows its formulas only through the lens: what it finds is a proof, not an echo.
namespace focalstage::exact::forward {

/// How an object is painted and where its picture shall come into focus.
struct Painted {
  enum class Focus { placed, fixed, offset, slice };

  glm::ivec2 squares{1, 1};
  double first = 1.0;  ///< gray of the square at u = v = 0
  double second = 1.0;
  Focus focus = Focus::placed;
  double vergence_d = 0.0;
  int slice = 0;
};

/// All that the light meets on its way, as plain numbers.
struct Room {
  int width_px = 0;
  int height_px = 0;
  bool diamond = false;  ///< the mirrors of every other row, the second being the first such, stand half a step aside
  glm::dvec2 focal_px{1.0};
  glm::dvec2 centre_px{0.0};
  std::vector<double> distortion;  ///< OpenCV's
  glm::dmat4 world_from_projector{1.0};
  glm::dmat4 world_from_viewer{1.0};
  double interpupillary_m = 0.063;
  double lens_to_pupil_m = 0.015;
  std::vector<double> powers_d;
  bool nearest_rule = false;
  int bits = 8;
  double gamma = 1.0;
  Caster surfaces{{}};
  Caster objects{{}};  ///< a triangle's owner is an index in `painted`
  std::vector<Painted> painted;
};

/// One eye's gray picture in one slice.
struct Picture {
  int eye = 0;  ///< 0 left, 1 right
  std::size_t slice = 0;
  std::span<const std::uint8_t> codes;
};

/// What the light from one place in the projector's image becomes in an eye.
struct Arrival {
  bool arrives = false;      ///< it lights a surface, and the eye sees the spot through its lens
  glm::dvec2 slope{0.0};     ///< the direction it seems to come from: aside and up per unit along the gaze
  std::size_t triangle = 0;  ///< of the surface
  double code = 0.0;         ///< what the projector ought to show there, not rounded
};

/// `place`: in steps from column to column and from row to row, whichever way the mirrors stand.
Arrival trace(const Room& room, int eye, std::size_t slice, const glm::dvec2& place);

/// How well the edges of a picture lie where the light says. A pixel contradicts the trace when nothing within
/// `tolerance_px` of its centre would look like it.
struct EdgeReport {
  std::uint64_t pixels = 0;
  std::uint64_t edges = 0;      ///< neighbours along rows that differ
  std::uint64_t displaced = 0;  ///< pixels unlike the light at their centre, but like some light within the tolerance
  std::uint64_t contradicted = 0;  ///< pixels unlike any
  double worst_px = 0.0;           ///< how far an edge is off at most; over the tolerance if any pixel contradicts

  EdgeReport& operator+=(const EdgeReport& other);
  double mean_px()
      const;  ///< by how much the edges are off on average: the share of edges with a pixel on the wrong side
};

/// Stops early once `enough` pixels contradict.
EdgeReport check_edges(const Room& room, const Picture& picture, double tolerance_px,
                       std::uint64_t enough = ~std::uint64_t{0});

}  // namespace focalstage::exact::forward
