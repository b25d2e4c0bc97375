#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/compile/frame.h"
#include "core/stage/stage.h"

namespace focalstage::exact {

/// A room drawn by chance: everything that a project can hold, and shapes that no designer would make.
struct RandomScene {
  std::uint64_t seed = 0;
  CompileSettings settings;
  std::vector<Stage> frames;  ///< one, or several between which things move or bend
  std::string story;          ///< what it holds, on one line
};

RandomScene random_scene(std::uint64_t seed);

}  // namespace focalstage::exact
