#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "io/assets/mesh_file.h"
#include "io/assets/ply_header.h"

namespace focalstage {

/// The numbers after the header, one by one: every type of PLY fits a double exactly.
class PlyNumbers {
 public:
  virtual ~PlyNumbers() = default;
  virtual std::optional<double> next(PlyType type) = 0;
  virtual std::size_t bytes_left() const = 0;
  virtual bool at_end() = 0;
  virtual std::string where() const = 0;
};

/// Over the data of `file`, which must outlive it.
std::unique_ptr<PlyNumbers> ply_numbers(const FileToRead& file, const PlyHeader& header);

}  // namespace focalstage
