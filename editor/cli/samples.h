#pragma once

#include <span>
#include <string_view>

namespace focalstage {

/// One file of a sample, as it lies in projects/.
struct SampleFile {
  std::string_view path;  ///< relative to the sample's folder
  std::string_view bytes;
};

/// A ready project, built into the program so that `new` needs no path to it.
struct Sample {
  std::string_view name;
  std::span<const SampleFile> files;
};

/// All of projects/, by name. Made by room.cmake.
std::span<const Sample> samples();

}  // namespace focalstage
