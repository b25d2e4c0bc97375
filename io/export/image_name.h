#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/optics/image_plan.h"

namespace focalstage {

/// "left", "right", "both".
std::string name_of(ImageEye eye);

/// "content", "light", "content+light".
std::string name_of(ImageKind kind);

/// A short name per image, each different: "left-+0.50D"; where two would be the same, their places in the show follow:
/// "left-+0.50D-2".
std::vector<std::string> image_names(const std::vector<ImageSpec>& images);

/// "frame-0007-left-+0.50D.png"; as many digits as the last frame needs, at least four.
std::string image_file_name(int frame, int frames, const std::string& image_name);

}  // namespace focalstage
