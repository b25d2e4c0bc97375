#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "editor/tools/sight_frame.h"

namespace focalstage {

/// The colour that stands for slice `slice` (in the project's list): blue for the lowest power, the nearest picture,
/// over green to red; gray where there is no such slice. sRGB, 0..1.
glm::dvec3 slice_colour(const std::vector<double>& powers_d, std::size_t slice);

using Rgb = glm::u8vec3;

enum class ObjectTint {
  none,
  slices,   ///< the colours of the slices it falls in, mixed by their weights
  conflict  ///< where vergence and accommodation part (core/percept/conflict.h)
};

/// For each vertex of the object's drawable its colour. Seen from between the eyes; `picker` finds the surface behind.
/// Gray where there is none.
std::vector<Rgb> object_tint(ObjectTint kind, const Project& project, const Stage& stage, const StagedObject& object,
                             const Drawable& drawable, Picker& picker);

}  // namespace focalstage
