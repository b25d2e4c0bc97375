#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tiny_gltf.h>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include "core/base/result.h"

namespace focalstage {

/// A parsed glTF as the readers of its parts see it: check_gltf has held every index, count, range and value to the
/// specification before it gets here.
struct GltfDocument {
  const tinygltf::Model& gltf;
  std::string path;

  /// "path: /accessors/3"
  std::string at(const char* list, std::size_t index) const {
    return path + ": /" + list + "/" + std::to_string(index);
  }

  /// Whether the file says that it uses the extension.
  bool uses(std::string_view extension) const;
};

/// Of one component; 0 for a type that glTF 2.0 does not have.
std::size_t component_bytes(int component_type);

/// Numbers in an element: 3 for VEC3, 16 for MAT4.
std::size_t component_count(int type);

/// Of one element; columns of small matrices begin at multiples of four bytes.
std::size_t element_bytes(const tinygltf::Accessor& accessor);

/// From one element to the next in the accessor's bufferView, which it must have.
std::size_t stride_of(const tinygltf::Model& gltf, const tinygltf::Accessor& accessor);

/// The bytes of a view; its index must be one of the file's.
std::span<const std::byte> view_bytes(const tinygltf::Model& gltf, int view);

/// An accessor of the file's by its index, or null where there is none such.
const tinygltf::Accessor* accessor_at(const GltfDocument& document, int index);

/// The elements of an accessor one after the other, sparse ones in their places, zeros where there are no data.
class GltfElements {
 public:
  GltfElements(const GltfDocument& document, const tinygltf::Accessor& accessor);

  /// Goes to the next element; asked `count` times at most.
  void next();

  /// Number `k` of the element: as it is stored, and as what it stands for (integers as fractions where the accessor is
  /// normalized).
  double stored(std::size_t k) const;
  double number(std::size_t k) const;

 private:
  void find_sparse();

  const GltfDocument& document_;
  const tinygltf::Accessor& accessor_;
  std::span<const std::byte> dense_;  ///< empty: zeros
  std::size_t stride_ = 0;
  std::size_t component_bytes_ = 0;
  std::size_t at_ = 0;
  std::size_t sparse_at_ = 0;
  std::size_t sparse_place_;  ///< the element that the next sparse value replaces
  const std::byte* element_ = nullptr;
};

/// Index `k` of those of an accessor's sparse values.
std::uint32_t sparse_index(const GltfDocument& document, const tinygltf::Accessor& accessor, std::size_t k);

/// The elements as up to four numbers each.
std::vector<glm::dvec4> read_vectors(const GltfDocument& document, int accessor);

/// The elements of a scalar accessor.
std::vector<double> read_numbers(const GltfDocument& document, int accessor);

/// The elements of a scalar accessor of unsigned integers.
std::vector<std::uint32_t> read_integers(const GltfDocument& document, int accessor);

/// The elements of an accessor of MAT4.
std::vector<glm::dmat4> read_matrices(const GltfDocument& document, int accessor);

}  // namespace focalstage
