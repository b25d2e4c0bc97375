#pragma once

#include <span>
#include <string_view>

namespace focalstage {

/// A file of models/ as it was built into the program.
struct ShippedModel {
  std::string_view file;
  std::string_view text;
};

/// All of models/, by name. Made by room.cmake.
std::span<const ShippedModel> shipped_files();

}  // namespace focalstage
