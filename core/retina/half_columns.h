#pragma once

#include <cstdint>
#include <vector>

#include "core/retina/retina.h"

namespace focalstage {

/// The same light from a projector of a square lattice. Cut in two, the pixels of a diamond lattice's rows all begin at
/// whole or half columns: so many half columns, and what lies beside a shifted row is dark. A row being as high as half
/// a column is wide, these pixels are square, and a disc of light is round in them.
class HalfColumns {
 public:
  /// Keeps its own codes; all else is `input`'s.
  explicit HalfColumns(const RetinaInput& input);

  const RetinaInput& input() const { return input_; }

 private:
  RetinaInput input_;
  std::vector<std::vector<std::uint8_t>> codes_;
};

}  // namespace focalstage
