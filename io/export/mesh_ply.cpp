#include "io/export/mesh_ply.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>

#include "io/files/files.h"

namespace focalstage {

namespace {

static_assert(std::endian::native == std::endian::little, "the bytes are written as they lie in memory");

template <class Number>
void append(std::string& bytes, Number number) {
  char raw[sizeof number];
  std::memcpy(raw, &number, sizeof number);
  bytes.append(raw, sizeof number);
}

}  // namespace

Status write_ply(const std::filesystem::path& path, const Mesh& mesh) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                      std::to_string(mesh.positions_m.size()) +
                      "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                      std::to_string(mesh.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const glm::dvec3& p : mesh.positions_m) {
    append(bytes, p.x);
    append(bytes, p.y);
    append(bytes, p.z);
  }
  for (const glm::uvec3& triangle : mesh.triangles) {
    append(bytes, std::uint8_t{3});
    for (int i = 0; i < 3; ++i) append(bytes, static_cast<std::int32_t>(triangle[i]));
  }
  return write_file_atomically(path, bytes);
}

}  // namespace focalstage
