#include <algorithm>
#include <cmath>
#include <memory>

#include "io/assets/mesh_file.h"
#include "io/assets/ply_header.h"
#include "io/assets/ply_numbers.h"
#include "io/assets/polygons.h"
#include "io/assets/text_reader.h"

namespace focalstage {
namespace {

/// What a vertex's property is to us, or nothing.
double* slot_of(const std::string& name, glm::dvec3& position, glm::dvec3& normal, glm::dvec2& uv) {
  if (name == "x") return &position.x;
  if (name == "y") return &position.y;
  if (name == "z") return &position.z;
  if (name == "nx") return &normal.x;
  if (name == "ny") return &normal.y;
  if (name == "nz") return &normal.z;
  if (name == "u" || name == "s" || name == "texture_u") return &uv.x;
  if (name == "v" || name == "t" || name == "texture_v") return &uv.y;
  return nullptr;
}

class PlyReader {
 public:
  PlyReader(const FileToRead& file, PlyHeader header)
      : file_(file), header_(std::move(header)), numbers_(ply_numbers(file, header_)) {}

  Result<MeshFile> read() {
    for (const PlyElement& element : header_.elements) {
      if (Status status = read_element(element); !status) return status.fault();
    }
    if (!numbers_->at_end()) return invalid("more data than the header announces");
    if (!make_normals_unit(mesh_))
      find(Severity::warning, "asset.normals", "a normal has no length; faces are lit flat");
    if (cutter_.crossed() > 0) {
      find(Severity::warning, "asset.crossed-polygons",
           std::to_string(cutter_.crossed()) + " polygons cross themselves");
    }
    const std::size_t vertices = mesh_.positions_m.size();
    std::vector<Mesh> meshes;
    meshes.push_back(std::move(mesh_));
    Result<MeshFile> result = file_of_meshes(file_.path, std::move(meshes), {-1}, vertices);
    if (result) result->findings = std::move(findings_);
    return result;
  }

 private:
  Status read_element(const PlyElement& element) {
    // Before anything is allocated: could the file hold that many?
    std::uint64_t least_bytes = 0;
    for (const PlyProperty& property : element.properties) {
      const bool ascii = header_.format == PlyHeader::Format::ascii;
      least_bytes += ascii ? 1 : size_of(property.count_type.value_or(property.type));
    }
    if (element.count > 0 && (least_bytes == 0 || element.count > numbers_->bytes_left() / least_bytes)) {
      return invalid("the file is too short for " + std::to_string(element.count) + " of " + element.name);
    }
    if (element.name == "vertex") return read_vertices(element);
    if (element.name == "face") return read_faces(element);
    if (element.name == "tristrips" && element.count > 0) {
      return unsupported_asset(file_.path, "triangle strips in PLY are not read", "export faces");
    }
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (const PlyProperty& property : element.properties) {
        if (!skip(property)) return invalid("the file ends too early or holds something else than a number");
      }
    }
    return {};
  }

  bool skip(const PlyProperty& property) {
    std::uint64_t count = 1;
    if (property.count_type && !read_list_count(property, count)) return false;
    for (std::uint64_t k = 0; k < count; ++k) {
      if (!numbers_->next(property.type)) return false;
    }
    return true;
  }

  bool read_list_count(const PlyProperty& property, std::uint64_t& count) {
    const std::optional<double> number = numbers_->next(*property.count_type);
    if (!number || *number < 0.0 || *number > static_cast<double>(numbers_->bytes_left())) return false;
    count = static_cast<std::uint64_t>(*number);
    return true;
  }

  bool has(const PlyElement& element, std::initializer_list<const char*> names) const {
    return std::all_of(names.begin(), names.end(), [&](const char* name) {
      return std::any_of(element.properties.begin(), element.properties.end(),
                         [&](const PlyProperty& p) { return p.name == name && !p.count_type; });
    });
  }

  Status read_vertices(const PlyElement& element) {
    if (!mesh_.positions_m.empty()) return invalid("two elements are named vertex");
    if (!has(element, {"x", "y", "z"})) return invalid("a vertex has no x, y and z");
    if (element.count > most_vertices) return invalid("more than 2^24 vertices");
    const bool normals = has(element, {"nx", "ny", "nz"});
    const bool uvs = has(element, {"u", "v"}) || has(element, {"s", "t"}) || has(element, {"texture_u", "texture_v"});
    if (has(element, {"red"})) find(Severity::info, "asset.colors", "vertex colours are left out");
    for (std::uint64_t i = 0; i < element.count; ++i) {
      glm::dvec3 position(0.0);
      glm::dvec3 normal(0.0);
      glm::dvec2 uv(0.0);
      for (const PlyProperty& property : element.properties) {
        double* slot = property.count_type ? nullptr : slot_of(property.name, position, normal, uv);
        if (slot == nullptr) {
          if (!skip(property)) return invalid("the file ends before its last vertex or holds no number there");
          continue;
        }
        const std::optional<double> number = numbers_->next(property.type);
        if (!number || !std::isfinite(*number)) return invalid("a vertex has a number missing or not finite");
        *slot = *number;
      }
      mesh_.positions_m.push_back(position);
      if (normals) mesh_.normals.push_back(normal);
      if (uvs) mesh_.uvs.push_back(uv);
    }
    return {};
  }

  Status read_faces(const PlyElement& element) {
    for (const PlyProperty& property : element.properties) {
      if (property.name == "texcoord")
        find(Severity::warning, "asset.uvs", "texture coordinates of faces are left out");
    }
    for (std::uint64_t i = 0; i < element.count; ++i) {
      bool has_corners = false;
      for (const PlyProperty& property : element.properties) {
        const bool corners =
            property.count_type && (property.name == "vertex_indices" || property.name == "vertex_index");
        has_corners = has_corners || corners;
        if (corners) {
          if (Status status = read_corners(property); !status) return status;
        } else if (!skip(property)) {
          return invalid("the file ends before its last face or holds no number there");
        }
      }
      if (!has_corners) return invalid("faces have no list vertex_indices");
    }
    return {};
  }

  Status read_corners(const PlyProperty& property) {
    std::uint64_t count = 0;
    if (!is_integer(property.type)) return invalid("vertex indices are not integers");
    if (!read_list_count(property, count)) return invalid("a face's count of corners is missing or wrong");
    if (count < 3) return invalid("a face has fewer than three corners");
    if (count > most_corners) return invalid(too_many_corners);
    corners_.clear();
    places_.clear();
    for (std::uint64_t k = 0; k < count; ++k) {
      const std::optional<double> index = numbers_->next(property.type);
      if (!index || *index < 0.0 || *index >= static_cast<double>(mesh_.positions_m.size())) {
        return invalid("a corner is missing or names no vertex of the file");
      }
      corners_.push_back(static_cast<std::uint32_t>(*index));
      places_.push_back(mesh_.positions_m[corners_.back()]);
    }
    cut_.clear();
    if (!cutter_.cut(places_, cut_)) return invalid("its polygons are too large to be cut into triangles");
    for (const glm::uvec3& t : cut_) mesh_.triangles.emplace_back(corners_[t.x], corners_[t.y], corners_[t.z]);
    return {};
  }

  Fault invalid(const std::string& what) const { return invalid_asset(numbers_->where(), what); }

  void find(Severity severity, const char* code, const std::string& what) {
    findings_.push_back(asset_finding(severity, code, file_.path, what));
  }

  const FileToRead& file_;
  PlyHeader header_;
  std::unique_ptr<PlyNumbers> numbers_;
  PolygonCutter cutter_;
  Mesh mesh_;
  std::vector<Finding> findings_;
  std::vector<std::uint32_t> corners_;
  std::vector<glm::dvec3> places_;
  std::vector<glm::uvec3> cut_;
};

}  // namespace

Result<MeshFile> read_ply(const FileToRead& file) {
  Result<PlyHeader> header = read_ply_header(file.bytes, file.path);
  if (!header) return header.fault();
  if (header->format == PlyHeader::Format::ascii) {
    if (Status lines = check_line_lengths(file.bytes, file.path); !lines) return lines.fault();
  }
  return PlyReader(file, *std::move(header)).read();
}

}  // namespace focalstage
