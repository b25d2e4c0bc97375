#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "core/base/sides.h"

namespace focalstage {

// What a scene asks of the lens, whatever slices the project has now (design section 5): a look that meets an object at
// d_v and the real surface that carries its picture at d_p needs the power 1/d_p - 1/d_v.

/// Powers are counted in cells of a hundredth of a dioptre, each about a multiple of it.
inline constexpr int need_cells_per_d = 100;

/// Beyond this nobody has a lens: such powers count to the outermost cell.
inline constexpr double farthest_need_d = 100.0;

/// How much of a picture needs which power. Weights are whole numbers, so that sums do not depend on their order.
class PowerHistogram {
 public:
  struct Cell {
    double power_d = 0.0;
    std::uint64_t weight = 0;

    bool operator==(const Cell&) const = default;
  };

  /// Not a number: nothing is added.
  void add(double power_d, std::uint64_t weight);
  void add(const PowerHistogram& other);

  bool empty() const { return cells_.empty(); }
  std::uint64_t weight() const;
  double lowest_d() const;  ///< 0 where empty
  double highest_d() const;

  /// By rising power, none of weight zero.
  std::vector<Cell> cells() const;

  bool operator==(const PowerHistogram&) const = default;

 private:
  std::map<int, std::uint64_t> cells_;  ///< by power * need_cells_per_d
};

/// What one object's picture needs, over all frames that were added up.
struct ObjectNeeds {
  std::size_t index = 0;            ///< in the project's list
  std::optional<int> pinned_slice;  ///< its picture belongs to this slice, whatever its powers
  std::uint64_t looks = 0;          ///< both eyes together
  std::uint64_t off_surface = 0;    ///< of those, no surface carries the picture
  std::uint64_t unlit = 0;          ///< of those, a surface would, but the projector does not reach it
  PerEye<PowerHistogram> powers;    ///< weight: solid angle, in units of 1e-12 of the tangent plane; none if pinned

  std::uint64_t served() const { return looks - off_surface - unlit; }

  /// Adds what the same object needs elsewhere; index and pin stay.
  void add(const ObjectNeeds& more);

  bool operator==(const ObjectNeeds&) const = default;
};

/// What a whole show needs, by the project's objects.
struct Needs {
  std::vector<ObjectNeeds> objects;  ///< by rising index

  /// Adds what one frame needs.
  void add(const std::vector<ObjectNeeds>& frame);

  /// All objects and both eyes together.
  PowerHistogram all() const;

  bool operator==(const Needs&) const = default;
};

}  // namespace focalstage
