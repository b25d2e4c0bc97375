#include "io/assets/gltf_accessors.h"

#include <algorithm>
#include <limits>

#include "io/assets/byte_reader.h"

namespace focalstage {
namespace {

double stored_at(const std::byte* from, int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return number_at<std::int8_t>(from);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return number_at<std::uint8_t>(from);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return number_at<std::int16_t>(from);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return number_at<std::uint16_t>(from);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return number_at<std::uint32_t>(from);
    default:
      return number_at<float>(from);
  }
}

/// What a stored integer stands for in a normalized accessor (glTF 2.0, 3.6.2.2).
double fraction_from(double stored, int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return std::max(stored / 127.0, -1.0);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return stored / 255.0;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return std::max(stored / 32767.0, -1.0);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return stored / 65535.0;
    default:
      return stored;
  }
}

/// Columns of a small matrix; 0 for all else, whose components stand side by side.
std::size_t columns_of(int type) { return type == TINYGLTF_TYPE_MAT2 ? 2 : type == TINYGLTF_TYPE_MAT3 ? 3 : 0; }

/// Each begins at a multiple of four bytes.
std::size_t column_bytes(std::size_t rows, std::size_t component) { return (rows * component + 3) / 4 * 4; }

/// Where component `k` of an element stands in it.
std::size_t offset_of(const tinygltf::Accessor& accessor, std::size_t component, std::size_t k) {
  const std::size_t side = columns_of(accessor.type);
  return side == 0 ? k * component : k / side * column_bytes(side, component) + k % side * component;
}

constexpr std::size_t no_place = std::numeric_limits<std::size_t>::max();

}  // namespace

bool GltfDocument::uses(std::string_view extension) const {
  return std::find(gltf.extensionsUsed.begin(), gltf.extensionsUsed.end(), extension) != gltf.extensionsUsed.end();
}

std::size_t component_bytes(int component_type) {
  switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

std::size_t component_count(int type) {
  return static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)));
}

std::size_t element_bytes(const tinygltf::Accessor& accessor) {
  const std::size_t component = component_bytes(accessor.componentType);
  const std::size_t side = columns_of(accessor.type);
  return side == 0 ? component_count(accessor.type) * component : side * column_bytes(side, component);
}

std::size_t stride_of(const tinygltf::Model& gltf, const tinygltf::Accessor& accessor) {
  const std::size_t given = gltf.bufferViews[static_cast<std::size_t>(accessor.bufferView)].byteStride;
  return given != 0 ? given : element_bytes(accessor);
}

std::span<const std::byte> view_bytes(const tinygltf::Model& gltf, int view) {
  const tinygltf::BufferView& at = gltf.bufferViews[static_cast<std::size_t>(view)];
  const std::vector<unsigned char>& data = gltf.buffers[static_cast<std::size_t>(at.buffer)].data;
  return std::as_bytes(std::span(data)).subspan(at.byteOffset, at.byteLength);
}

const tinygltf::Accessor* accessor_at(const GltfDocument& document, int index) {
  if (index < 0 || static_cast<std::size_t>(index) >= document.gltf.accessors.size()) return nullptr;
  return &document.gltf.accessors[static_cast<std::size_t>(index)];
}

std::uint32_t sparse_index(const GltfDocument& document, const tinygltf::Accessor& accessor, std::size_t k) {
  const auto& from = accessor.sparse.indices;
  const std::byte* bytes = view_bytes(document.gltf, from.bufferView).data() + from.byteOffset;
  return static_cast<std::uint32_t>(stored_at(bytes + k * component_bytes(from.componentType), from.componentType));
}

GltfElements::GltfElements(const GltfDocument& document, const tinygltf::Accessor& accessor)
    : document_(document),
      accessor_(accessor),
      component_bytes_(component_bytes(accessor.componentType)),
      sparse_place_(no_place) {
  if (accessor.bufferView >= 0) {
    dense_ = view_bytes(document.gltf, accessor.bufferView).subspan(accessor.byteOffset);
    stride_ = stride_of(document.gltf, accessor);
  }
  find_sparse();
}

void GltfElements::find_sparse() {
  const bool more = accessor_.sparse.isSparse && sparse_at_ < static_cast<std::size_t>(accessor_.sparse.count);
  sparse_place_ = more ? sparse_index(document_, accessor_, sparse_at_) : no_place;
}

void GltfElements::next() {
  if (at_ == sparse_place_) {
    const auto& values = accessor_.sparse.values;
    element_ = view_bytes(document_.gltf, values.bufferView).data() + values.byteOffset +
               sparse_at_ * element_bytes(accessor_);
    ++sparse_at_;
    find_sparse();
  } else {
    element_ = dense_.empty() ? nullptr : dense_.data() + at_ * stride_;
  }
  ++at_;
}

double GltfElements::stored(std::size_t k) const {
  if (element_ == nullptr) return 0.0;
  return stored_at(element_ + offset_of(accessor_, component_bytes_, k), accessor_.componentType);
}

double GltfElements::number(std::size_t k) const {
  return accessor_.normalized ? fraction_from(stored(k), accessor_.componentType) : stored(k);
}

std::vector<glm::dvec4> read_vectors(const GltfDocument& document, int accessor) {
  const tinygltf::Accessor& from = document.gltf.accessors[static_cast<std::size_t>(accessor)];
  const std::size_t components = std::min<std::size_t>(component_count(from.type), 4);
  std::vector<glm::dvec4> vectors(from.count, glm::dvec4(0.0));
  GltfElements elements(document, from);
  for (glm::dvec4& vector : vectors) {
    elements.next();
    for (std::size_t k = 0; k < components; ++k) vector[static_cast<int>(k)] = elements.number(k);
  }
  return vectors;
}

std::vector<double> read_numbers(const GltfDocument& document, int accessor) {
  const tinygltf::Accessor& from = document.gltf.accessors[static_cast<std::size_t>(accessor)];
  std::vector<double> numbers(from.count);
  GltfElements elements(document, from);
  for (double& number : numbers) {
    elements.next();
    number = elements.number(0);
  }
  return numbers;
}

std::vector<std::uint32_t> read_integers(const GltfDocument& document, int accessor) {
  const tinygltf::Accessor& from = document.gltf.accessors[static_cast<std::size_t>(accessor)];
  std::vector<std::uint32_t> integers(from.count);
  GltfElements elements(document, from);
  for (std::uint32_t& integer : integers) {
    elements.next();
    integer = static_cast<std::uint32_t>(elements.stored(0));
  }
  return integers;
}

std::vector<glm::dmat4> read_matrices(const GltfDocument& document, int accessor) {
  const tinygltf::Accessor& from = document.gltf.accessors[static_cast<std::size_t>(accessor)];
  std::vector<glm::dmat4> matrices(from.count);
  GltfElements elements(document, from);
  for (glm::dmat4& matrix : matrices) {
    elements.next();
    for (std::size_t k = 0; k < 16; ++k) matrix[static_cast<int>(k / 4)][static_cast<int>(k % 4)] = elements.number(k);
  }
  return matrices;
}

}  // namespace focalstage
