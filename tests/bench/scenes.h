#pragma once

#include <string>
#include <vector>

#include "core/compile/frame.h"
#include "core/stage/stage.h"

namespace focalstage::bench {

/// A room to be timed: two eyes, six slices, 1024 x 768, gray.
struct BenchScene {
  std::string name;
  CompileSettings settings;
  Stage stage;
  Stage moved;                 ///< the same with every object elsewhere: nothing of an object may be kept
  Stage one_moved;             ///< only the first object elsewhere
  bool surfaces_hide = false;  ///< the surfaces can stand before one another: the two passes need their depth map
};

/// bunnies, teapot, plane and bumpy of the lab, generated.
std::vector<BenchScene> bench_scenes();

}  // namespace focalstage::bench
