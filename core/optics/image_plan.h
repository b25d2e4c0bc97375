#pragma once

#include <vector>

#include "core/scene/project.h"

namespace focalstage {

/// Whose image it is; the numbers are those of the show file.
enum class ImageEye { left = 0, right = 1, both = 2 };

/// What an image carries; the numbers are those of the show file.
enum class ImageKind { content = 0, surface_light = 1, content_and_light = 2 };

struct ImageSpec {
  ImageEye eye = ImageEye::left;
  ImageKind kind = ImageKind::content;
  double power_d = 0.0;
  int slice = -1;  ///< index in the project's powers; -1 for a light image

  bool operator==(const ImageSpec&) const = default;
};

/// The images of every frame, in the order of the show file: the left eye's slices in the project's order, the right
/// eye's, and a light image for both eyes where a surface is lit and no slice has power zero to carry it.
/// (design: "Lit surfaces get a white exposure per eye at zero power; where a slice has power zero they share it".)
std::vector<ImageSpec> image_plan(const Project& project);

}  // namespace focalstage
