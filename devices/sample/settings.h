#pragma once

#include <filesystem>

namespace focalstage {

struct SampleSettings {
  std::filesystem::path file;  ///< the "device": there while the file is
  double poll_s = 0.010;       ///< between two looks at it
};

}  // namespace focalstage
