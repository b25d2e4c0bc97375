#include "io/assets/gltf_accessors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/assets/byte_reader.h"
#include "io/assets/mesh_file.h"

namespace focalstage {
namespace {

/// 0 for a type that glTF 2.0 does not have.
std::size_t component_bytes(int type) {
  switch (type) {
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

/// Columns of small matrices begin at multiples of four bytes.
std::size_t element_bytes(const tinygltf::Accessor& accessor) {
  const std::size_t size = component_bytes(accessor.componentType);
  const auto matrix = [&](std::size_t side) { return side * ((side * size + 3) / 4 * 4); };
  switch (accessor.type) {
    case TINYGLTF_TYPE_MAT2:
      return matrix(2);
    case TINYGLTF_TYPE_MAT3:
      return matrix(3);
    case TINYGLTF_TYPE_MAT4:
      return matrix(4);
    default:
      return size * component_count(accessor.type);
  }
}

std::size_t stride_of(const tinygltf::Model& gltf, const tinygltf::Accessor& accessor) {
  const std::size_t given = gltf.bufferViews[static_cast<std::size_t>(accessor.bufferView)].byteStride;
  return given != 0 ? given : element_bytes(accessor);
}

Status check_view(const GltfDocument& document, std::size_t index) {
  const tinygltf::BufferView& view = document.gltf.bufferViews[index];
  const std::string where = document.at("bufferViews", index);
  if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= document.gltf.buffers.size()) {
    return invalid_asset(where + "/buffer", "there is no such buffer");
  }
  const std::size_t size = document.gltf.buffers[static_cast<std::size_t>(view.buffer)].data.size();
  if (view.byteLength == 0 || view.byteOffset > size || view.byteLength > size - view.byteOffset) {
    return invalid_asset(where, "the view reaches beyond its buffer or is empty");
  }
  if (view.byteStride != 0 && (view.byteStride < 4 || view.byteStride > 252 || view.byteStride % 4 != 0)) {
    return invalid_asset(where + "/byteStride", "a stride is a multiple of 4 from 4 to 252");
  }
  return {};
}

Status check_accessor(const GltfDocument& document, std::size_t index) {
  const tinygltf::Accessor& accessor = document.gltf.accessors[index];
  const std::string where = document.at("accessors", index);
  if (accessor.sparse.isSparse) {
    return unsupported_asset(where + "/sparse", "sparse accessors are not read", "export without them");
  }
  if (accessor.bufferView < 0) {
    return unsupported_asset(where, "an accessor without a bufferView is not read", "export the data itself");
  }
  if (static_cast<std::size_t>(accessor.bufferView) >= document.gltf.bufferViews.size()) {
    return invalid_asset(where + "/bufferView", "there is no such bufferView");
  }
  const std::size_t component = component_bytes(accessor.componentType);
  if (component == 0) return invalid_asset(where + "/componentType", "glTF has no such component type");
  if (accessor.count == 0) return invalid_asset(where + "/count", "an accessor holds at least one element");
  const bool whole = accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT &&
                     accessor.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  if (accessor.normalized && !whole) {
    return invalid_asset(where + "/normalized", "only 8 and 16-bit integers can be normalized");
  }
  const tinygltf::BufferView& view = document.gltf.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
  const std::size_t stride = stride_of(document.gltf, accessor);
  const std::size_t element = element_bytes(accessor);
  if (accessor.byteOffset % component != 0 || (accessor.byteOffset + view.byteOffset) % component != 0 ||
      stride % component != 0) {
    return invalid_asset(where + "/byteOffset", "its elements are not aligned to their component type");
  }
  // Offsets, lengths and counts fit 31 bits (gltf_shape.cpp) and strides 8: nothing overflows.
  if (stride < element || accessor.byteOffset + stride * (accessor.count - 1) + element > view.byteLength) {
    return invalid_asset(where, "its elements reach beyond its bufferView");
  }
  return {};
}

double component_at(const std::byte* from, int type, bool normalized) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: {
      const double value = number_at<std::int8_t>(from);
      return normalized ? std::max(value / 127.0, -1.0) : value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: {
      const double value = number_at<std::uint8_t>(from);
      return normalized ? value / 255.0 : value;
    }
    case TINYGLTF_COMPONENT_TYPE_SHORT: {
      const double value = number_at<std::int16_t>(from);
      return normalized ? std::max(value / 32767.0, -1.0) : value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: {
      const double value = number_at<std::uint16_t>(from);
      return normalized ? value / 65535.0 : value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return number_at<std::uint32_t>(from);
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return number_at<float>(from);
    default:
      return std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace

Status check_gltf_buffers(const GltfDocument& document) {
  for (std::size_t i = 0; i < document.gltf.bufferViews.size(); ++i) {
    if (Status status = check_view(document, i); !status) return status;
  }
  for (std::size_t i = 0; i < document.gltf.accessors.size(); ++i) {
    if (Status status = check_accessor(document, i); !status) return status;
  }
  return {};
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

Result<std::vector<glm::dvec4>> read_vectors(const GltfDocument& document, int accessor) {
  const tinygltf::Accessor& from = document.gltf.accessors[static_cast<std::size_t>(accessor)];
  const std::span<const std::byte> bytes = view_bytes(document.gltf, from.bufferView).subspan(from.byteOffset);
  const std::size_t stride = stride_of(document.gltf, from);
  const std::size_t component = component_bytes(from.componentType);
  const std::size_t components = std::min<std::size_t>(component_count(from.type), 4);
  std::vector<glm::dvec4> vectors(from.count, glm::dvec4(0.0));
  for (std::size_t i = 0; i < from.count; ++i) {
    for (std::size_t k = 0; k < components; ++k) {
      const double value = component_at(bytes.data() + i * stride + k * component, from.componentType, from.normalized);
      if (!std::isfinite(value)) {
        return invalid_asset(document.at("accessors", static_cast<std::size_t>(accessor)),
                             "element " + std::to_string(i) + " is not finite");
      }
      vectors[i][static_cast<int>(k)] = value;
    }
  }
  return vectors;
}

std::vector<std::uint32_t> read_integers(const GltfDocument& document, int accessor) {
  const tinygltf::Accessor& from = document.gltf.accessors[static_cast<std::size_t>(accessor)];
  const std::span<const std::byte> bytes = view_bytes(document.gltf, from.bufferView).subspan(from.byteOffset);
  const std::size_t stride = stride_of(document.gltf, from);
  std::vector<std::uint32_t> integers(from.count);
  for (std::size_t i = 0; i < from.count; ++i) {
    integers[i] = static_cast<std::uint32_t>(component_at(bytes.data() + i * stride, from.componentType, false));
  }
  return integers;
}

}  // namespace focalstage
