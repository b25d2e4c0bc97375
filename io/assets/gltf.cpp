#include <algorithm>

#include "io/assets/gltf_animations.h"
#include "io/assets/gltf_cameras_lights.h"
#include "io/assets/gltf_check.h"
#include "io/assets/gltf_deformations.h"
#include "io/assets/gltf_draco.h"
#include "io/assets/gltf_materials.h"
#include "io/assets/gltf_meshes.h"
#include "io/assets/gltf_nodes.h"
#include "io/assets/gltf_parse.h"

namespace focalstage {

Result<MeshFile> read_gltf(const FileToRead& file) {
  Result<tinygltf::Model> gltf = parse_gltf(file);
  if (!gltf) return gltf.fault();
  const GltfDocument document{*gltf, file.path};
  if (Status status = check_gltf_file(document); !status) return status.fault();
  if (Status status = decode_gltf_draco(*gltf, file.path); !status) return status.fault();
  const Result<std::vector<Finding>> checked = check_gltf(document);
  if (!checked) return checked.fault();
  Result<GltfMaterials> materials = read_gltf_materials(document);
  if (!materials) return materials.fault();
  Result<GltfMeshes> meshes = read_gltf_meshes(document, *materials);
  if (!meshes) return meshes.fault();
  Result<GltfNodes> nodes = read_gltf_nodes(document, meshes->parts_of_mesh);
  if (!nodes) return nodes.fault();

  MeshFile result;
  result.vertices = meshes->vertices;
  result.triangles = meshes->triangles;
  const std::vector<Finding> more = cameras_and_lights(document, nodes->nodes, nodes->node_of_gltf);
  for (const auto& findings : {*checked, materials->findings, meshes->findings, nodes->findings, more}) {
    result.findings.insert(result.findings.end(), findings.begin(), findings.end());
  }
  if (std::none_of(nodes->nodes.begin(), nodes->nodes.end(), [](const Node& n) { return !n.parts.empty(); })) {
    result.findings.push_back(asset_finding(Severity::warning, "asset.empty", file.path, "the scene draws nothing"));
  }
  result.model = {std::move(materials->materials), std::move(nodes->nodes), read_gltf_animations(document, *nodes),
                  read_gltf_skins(document, nodes->node_of_gltf)};
  return result;
}

}  // namespace focalstage
