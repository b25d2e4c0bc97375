#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/mesh/model.h"
#include "core/scene/finding.h"

namespace focalstage {

/// What a mesh or glTF file holds, as read.
struct MeshFile {
  Model model;
  std::size_t vertices = 0;   ///< as the file counts them
  std::size_t triangles = 0;  ///< after polygons are cut, each mesh once however often it stands in the scene
  std::vector<Finding> findings;
};

/// The bytes of a file that the one being read refers to, by what it writes. They live as long as the reading.
using Companions = std::function<Result<std::span<const std::byte>>(const std::string& uri)>;

/// A file to read: its path as the project writes it (for faults and by its ending for the format), and its content.
struct FileToRead {
  std::string path;
  std::span<const std::byte> bytes;
  Companions companion;
};

/// By the ending of the path: obj, ply, stl, off, gltf, glb. What is read is read exactly or refused: codes
/// "asset.invalid" (not what it says it is), "asset.unsupported" (valid, but more than this version draws),
/// "asset.too-large".
Result<MeshFile> read_mesh_file(const FileToRead& file);

Result<MeshFile> read_obj(const FileToRead& file);
Result<MeshFile> read_ply(const FileToRead& file);
Result<MeshFile> read_stl(const FileToRead& file);
Result<MeshFile> read_off(const FileToRead& file);
Result<MeshFile> read_gltf(const FileToRead& file);

// Shared by the readers --------------------------------------------------------------------------------------------

inline constexpr std::uint64_t most_file_bytes = std::uint64_t{512} << 20;
inline constexpr std::size_t most_vertices = std::size_t{1} << 24;  ///< of one file; the same for triangles

Fault invalid_asset(const std::string& where, const std::string& what);
Fault unsupported_asset(const std::string& where, const std::string& what, const std::string& remedy);

Finding asset_finding(Severity severity, const std::string& code, const std::string& where, const std::string& what);

/// The file of one node with these parts; a fault where there is no triangle in them, or too many.
Result<MeshFile> file_of_meshes(const std::string& path, std::vector<Mesh> meshes, std::vector<int> material_of_mesh,
                                std::size_t vertices);

/// Makes normals unit. Where one has no length none can be trusted: they are dropped (faces then light flat) and false
/// is returned.
bool make_normals_unit(Mesh& mesh);

}  // namespace focalstage
