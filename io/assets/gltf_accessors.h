#pragma once

#include <span>
#include <string>
#include <vector>

#include <tiny_gltf.h>
#include <glm/vec4.hpp>

#include "core/base/result.h"

namespace focalstage {

/// A parsed glTF as the readers of its parts see it: every index into buffers, views and accessors has been checked
/// before it gets here (check_gltf_buffers).
struct GltfDocument {
  const tinygltf::Model& gltf;
  std::string path;

  /// "path: /accessors/3"
  std::string at(const char* list, std::size_t index) const {
    return path + ": /" + list + "/" + std::to_string(index);
  }
};

/// Holds all buffer views to their buffers and all accessors to their views: bounds, strides, alignment, types. What is
/// valid glTF but not read here (sparse accessors, accessors without data) is refused, too.
Status check_gltf_buffers(const GltfDocument& document);

/// The bytes of a view; its index must be one of the file's.
std::span<const std::byte> view_bytes(const tinygltf::Model& gltf, int view);

/// An accessor of the file's by its index, or null where there is none such.
const tinygltf::Accessor* accessor_at(const GltfDocument& document, int index);

/// Its elements as up to four numbers each, integers as floats where they are marked normalized. Fault where one is not
/// finite.
Result<std::vector<glm::dvec4>> read_vectors(const GltfDocument& document, int accessor);

/// The elements of a scalar accessor of unsigned integers.
std::vector<std::uint32_t> read_integers(const GltfDocument& document, int accessor);

}  // namespace focalstage
