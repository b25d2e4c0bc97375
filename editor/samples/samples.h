#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "core/base/result.h"

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

/// Fault "sample.unknown" lists those there are.
Result<Sample> sample_named(const std::string& name);

/// "first-light, three-rabbits, ..."
std::string sample_names();

/// Writes the sample into `folder`, which is made and must be empty; the project file takes the folder's name. Returns
/// its path. Faults "project.exists", "file.unwritable".
Result<std::filesystem::path> write_sample(const Sample& sample, const std::filesystem::path& folder);

}  // namespace focalstage
