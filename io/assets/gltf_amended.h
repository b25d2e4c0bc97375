#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <tiny_gltf.h>
#include <nlohmann/json.hpp>

namespace focalstage {

/// The uri under which tinygltf asks for the binary chunk of a GLB. No file can write it: its scheme is refused.
inline constexpr const char* glb_buffer_uri = "focalstage:glb-buffer";

/// tinygltf 2.7 refuses some files that glTF allows: skins without inverse bind matrices, indices without a bufferView.
/// It gets those files without them, and what was taken is put back into the model it makes. A GLB's buffer becomes one
/// with a uri, so that both kinds of file go the same way.
class AmendedGltf {
 public:
  /// Of a JSON of the right shape (check_gltf_shape). `has_binary`: a GLB with a binary chunk.
  AmendedGltf(nlohmann::json& root, bool has_binary);

  /// Whether anything was amended: where not, the file's own text will do.
  bool changed() const { return changed_; }

  void restore(tinygltf::Model& gltf) const;

 private:
  void take_binds(nlohmann::json& root);
  void take_indices(nlohmann::json& root);

  struct Indices {
    std::size_t mesh;
    std::size_t primitive;
    int accessor;
  };
  std::vector<Indices> indices_;
  std::vector<std::size_t> skins_without_binds_;
  bool changed_ = false;
};

/// The uris of its buffers and images, as written.
std::vector<std::string> gltf_uris(const nlohmann::json& root);

}  // namespace focalstage
