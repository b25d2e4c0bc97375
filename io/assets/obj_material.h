#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/mesh/model.h"
#include "io/assets/mesh_file.h"

namespace focalstage {

/// The materials of an OBJ's libraries, by name. Kd is taken as linear; what the picture needs beyond Kd and a plain
/// map_Kd is left out with a finding.
class ObjMaterials {
 public:
  explicit ObjMaterials(const FileToRead& obj) : obj_(obj) {}

  /// Reads one library, named relative to the OBJ. A missing one is a finding: its materials are then white.
  Status read_library(const std::string& name);

  /// -1 for a name that no library has.
  int index_of(const std::string& name) const;

  std::vector<Material> take() { return std::move(materials_); }
  std::vector<Finding> findings;

 private:
  Status read(const std::string& library, std::span<const std::byte> bytes);
  Status read_texture(const std::string& library, const std::string& name, const std::string& where);
  void warn(const std::string& code, const std::string& where, const std::string& what);

  const FileToRead& obj_;
  std::vector<Material> materials_;
  std::map<std::string, int, std::less<>> index_by_name_;
  std::map<std::string, std::shared_ptr<const Texture>> textures_;
};

}  // namespace focalstage
