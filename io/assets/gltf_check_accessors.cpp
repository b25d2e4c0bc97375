#include <algorithm>
#include <array>
#include <cmath>

#include "io/assets/gltf_check.h"

namespace focalstage {
namespace {

bool is_fraction_type(int component_type) {
  return component_type != TINYGLTF_COMPONENT_TYPE_FLOAT && component_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

Status check_view(const GltfDocument& document, std::size_t index) {
  const tinygltf::BufferView& view = document.gltf.bufferViews[index];
  const std::string where = document.at("bufferViews", index);
  if (!is_one_of(view.buffer, document.gltf.buffers.size())) {
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

/// The checks of one file's accessors, which together bound the work that it can ask for.
class AccessorChecker {
 public:
  AccessorChecker(const GltfDocument& document, std::vector<Finding>& findings)
      : document_(document), findings_(findings) {
    for (const tinygltf::Buffer& buffer : document.gltf.buffers) bytes_left_ += most_overlap * buffer.data.size();
  }

  Status check(std::size_t index) {
    const tinygltf::Accessor& accessor = document_.gltf.accessors[index];
    where_ = document_.at("accessors", index);
    if (Status status = check_form(accessor); !status) return status;
    if (accessor.bufferView >= 0) {
      if (Status status = check_place(accessor); !status) return status;
    }
    if (accessor.sparse.isSparse) {
      if (Status status = check_sparse(accessor); !status) return status;
    }
    if (Status status = take(accessor); !status) return status;
    return check_values(accessor);
  }

 private:
  static constexpr std::size_t most_overlap = 8;

  Status check_form(const tinygltf::Accessor& accessor) {
    if (component_bytes(accessor.componentType) == 0) {
      return invalid_asset(where_ + "/componentType", "glTF has no such component type");
    }
    if (accessor.count == 0) return invalid_asset(where_ + "/count", "an accessor holds at least one element");
    if (accessor.normalized && !is_fraction_type(accessor.componentType)) {
      return invalid_asset(where_ + "/normalized", "only 8 and 16-bit integers can be normalized");
    }
    for (const auto& [name, bounds] : {std::pair("/min", &accessor.minValues), {"/max", &accessor.maxValues}}) {
      if (!bounds->empty() && bounds->size() != component_count(accessor.type)) {
        return invalid_asset(where_ + name, "it has not as many numbers as an element");
      }
    }
    return {};
  }

  Status check_place(const tinygltf::Accessor& accessor) const {
    if (!is_one_of(accessor.bufferView, document_.gltf.bufferViews.size())) {
      return invalid_asset(where_ + "/bufferView", "there is no such bufferView");
    }
    const std::size_t component = component_bytes(accessor.componentType);
    const tinygltf::BufferView& view = document_.gltf.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
    const std::size_t stride = stride_of(document_.gltf, accessor);
    const std::size_t element = element_bytes(accessor);
    if (accessor.byteOffset % component != 0 || (accessor.byteOffset + view.byteOffset) % component != 0 ||
        stride % component != 0) {
      return invalid_asset(where_ + "/byteOffset", "its elements are not aligned to their component type");
    }
    if (stride < element || accessor.byteOffset + stride * (accessor.count - 1) + element > view.byteLength) {
      return invalid_asset(where_, "its elements reach beyond its bufferView");
    }
    return {};
  }

  /// Part of a packed view that sparse indices or values lie in.
  Status check_part(int index, int byte_offset, std::size_t component, std::size_t bytes,
                    const std::string& where) const {
    if (!is_one_of(index, document_.gltf.bufferViews.size())) {
      return invalid_asset(where + "/bufferView", "there is no such bufferView");
    }
    const tinygltf::BufferView& view = document_.gltf.bufferViews[static_cast<std::size_t>(index)];
    const auto offset = static_cast<std::size_t>(byte_offset);
    if (view.byteStride != 0) return invalid_asset(where + "/bufferView", "sparse data have no stride");
    if ((view.byteOffset + offset) % component != 0) {
      return invalid_asset(where + "/byteOffset", "its elements are not aligned to their component type");
    }
    if (offset + bytes > view.byteLength) return invalid_asset(where, "its elements reach beyond its bufferView");
    return {};
  }

  Status check_sparse(const tinygltf::Accessor& accessor) const {
    const auto& sparse = accessor.sparse;
    const std::string where = where_ + "/sparse";
    if (sparse.count < 1 || static_cast<std::size_t>(sparse.count) > accessor.count) {
      return invalid_asset(where + "/count", "it replaces no element or more than there are");
    }
    const auto count = static_cast<std::size_t>(sparse.count);
    const int type = sparse.indices.componentType;
    if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
      return invalid_asset(where + "/indices/componentType", "indices are unsigned integers");
    }
    const std::size_t index = component_bytes(type);
    const Status indices =
        check_part(sparse.indices.bufferView, sparse.indices.byteOffset, index, count * index, where + "/indices");
    if (!indices) return indices;
    const Status values =
        check_part(sparse.values.bufferView, sparse.values.byteOffset, component_bytes(accessor.componentType),
                   count * element_bytes(accessor), where + "/values");
    if (!values) return values;
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint32_t place = sparse_index(document_, accessor, k);
      if (place >= accessor.count || (k > 0 && place <= sparse_index(document_, accessor, k - 1))) {
        return invalid_asset(where + "/indices", "its indices do not ascend or name no element");
      }
    }
    return {};
  }

  /// Counts fit 31 bits (gltf_shape.cpp): nothing overflows.
  Status take(const tinygltf::Accessor& accessor) {
    const std::size_t bytes = accessor.count * element_bytes(accessor);
    if (bytes > bytes_left_) {
      return Fault{"asset.too-large", where_, "the accessors promise far more than the buffers hold",
                   "export the file again"};
    }
    bytes_left_ -= bytes;
    return {};
  }

  /// All finite, and the smallest and largest those given: as far as floats written in decimals agree.
  Status check_values(const tinygltf::Accessor& accessor) {
    if (accessor.bufferView < 0 && !accessor.sparse.isSparse) return {};
    const std::size_t components = component_count(accessor.type);
    std::array<double, 16> least{};
    std::array<double, 16> most{};
    GltfElements elements(document_, accessor);
    for (std::size_t i = 0; i < accessor.count; ++i) {
      elements.next();
      for (std::size_t k = 0; k < components; ++k) {
        const double value = elements.stored(k);
        if (!std::isfinite(value)) return invalid_asset(where_, "element " + std::to_string(i) + " is not finite");
        least[k] = i == 0 ? value : std::min(least[k], value);
        most[k] = i == 0 ? value : std::max(most[k], value);
      }
    }
    if (!agree(accessor.minValues, least) || !agree(accessor.maxValues, most)) {
      findings_.push_back(asset_finding(Severity::warning, "asset.bounds", where_,
                                        "the min and max that the file gives are not those of its values"));
    }
    return {};
  }

  /// Where the file gives any.
  static bool agree(const std::vector<double>& given, const std::array<double, 16>& found) {
    for (std::size_t k = 0; k < given.size(); ++k) {
      if (std::abs(given[k] - found[k]) > 1e-6 * std::max(std::abs(given[k]), std::abs(found[k]))) return false;
    }
    return true;
  }

  const GltfDocument& document_;
  std::vector<Finding>& findings_;
  std::string where_;  ///< the accessor at hand
  std::size_t bytes_left_ = most_file_bytes;
};

}  // namespace

Status check_gltf_views(const GltfDocument& document) {
  for (std::size_t i = 0; i < document.gltf.bufferViews.size(); ++i) {
    if (Status status = check_view(document, i); !status) return status;
  }
  return {};
}

Status check_gltf_accessors(const GltfDocument& document, std::vector<Finding>& findings) {
  AccessorChecker checker(document, findings);
  for (std::size_t i = 0; i < document.gltf.accessors.size(); ++i) {
    if (Status status = checker.check(i); !status) return status;
  }
  return {};
}

}  // namespace focalstage
