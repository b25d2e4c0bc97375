#pragma once

#include <vector>

#include "io/assets/gltf_accessors.h"
#include "io/assets/mesh_file.h"

namespace focalstage {

/// Holds the file as such: its version, the extensions it needs, and where its bufferViews lie in the buffers.
Status check_gltf_file(const GltfDocument& document);

/// Holds a parsed glTF, its file checked and its data unpacked, to the specification before anything is made of it:
/// every index names something, accessors lie in their views, numbers are finite, indices name vertices, nodes have one
/// parent and no circle, skins have the joints their vertices name, animation times ascend, and every count fits.
/// tinygltf checks almost none of it. Faults "asset.invalid", "asset.unsupported" and "asset.too-large" name the place
/// by JSON pointer. Returns what is wrong with the file though nothing drawn depends on it.
Result<std::vector<Finding>> check_gltf(const GltfDocument& document);

// Its parts, in the order in which they rely on each other ------------------------------------------------------------

Status check_gltf_views(const GltfDocument& document);
Status check_gltf_accessors(const GltfDocument& document, std::vector<Finding>& findings);
Status check_gltf_materials(const GltfDocument& document);
Status check_gltf_cameras_and_lights(const GltfDocument& document);
Status check_gltf_meshes(const GltfDocument& document);
Status check_gltf_nodes(const GltfDocument& document);
Status check_gltf_skins(const GltfDocument& document);
Status check_gltf_animations(const GltfDocument& document);

// Shared by them -----------------------------------------------------------------------------------------------------

/// Whether `index` is one of a list of so many.
constexpr bool is_one_of(int index, std::size_t count) { return index >= 0 && static_cast<std::size_t>(index) < count; }

/// The parent of each node, -1 for roots. Circles end nowhere: for checked nodes alone.
std::vector<int> gltf_parents(const tinygltf::Model& gltf);

/// How many morph targets a mesh has; its primitives have the same number.
std::size_t morph_targets(const tinygltf::Mesh& mesh);

/// Ways in which a component may be stored, as bits: exactly one of an accessor's.
enum Storage : unsigned {
  stored_float = 1,
  stored_i8 = 2,
  stored_i8_fraction = 4,
  stored_u8 = 8,
  stored_u8_fraction = 16,
  stored_i16 = 32,
  stored_i16_fraction = 64,
  stored_u16 = 128,
  stored_u16_fraction = 256,
  stored_u32 = 512,
};
Storage storage_of(const tinygltf::Accessor& accessor);

}  // namespace focalstage
