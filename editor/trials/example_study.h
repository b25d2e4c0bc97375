#pragma once

#include "core/study/study.h"

namespace focalstage {

/// The paper's study on the sample depth-matching: ten participants, five distances, four repetitions. Its nearest
/// target stands at 333 mm, where the powers that the paper lists put it, and not at the printed 300 mm.
Study example_study();

/// The folder beside the study file that holds its project.
inline constexpr const char* example_project = "depth-matching";

}  // namespace focalstage
