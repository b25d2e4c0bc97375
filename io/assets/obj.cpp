#include <algorithm>
#include <array>
#include <map>
#include <tuple>
#include <unordered_map>

#include "io/assets/mesh_file.h"
#include "io/assets/obj_material.h"
#include "io/assets/polygons.h"
#include "io/assets/text_reader.h"

namespace focalstage {
namespace {

constexpr std::uint32_t absent = 0xFFFFFFFFu;

/// A face's corner: which position, texture coordinate and normal.
using Corner = std::array<std::uint32_t, 3>;

struct CornerHash {
  std::size_t operator()(const Corner& c) const {
    std::uint64_t hash = 0;
    for (const std::uint32_t index : c) hash = (hash ^ index) * 0x9E3779B97F4A7C15u + (hash >> 29);
    return hash;
  }
};

/// Faces that share a material and what their corners carry: one mesh.
struct Group {
  Mesh mesh;
  std::unordered_map<Corner, std::uint32_t, CornerHash> vertex_at;
};

class ObjReader {
 public:
  explicit ObjReader(const FileToRead& file, std::span<const std::byte> bytes)
      : file_(file), text_(bytes, file.path), materials_(file) {}

  Result<MeshFile> read() {
    while (text_.next_line()) {
      if (Status status = read_line(std::string(text_.word())); !status) return status.fault();
    }
    return finish();
  }

 private:
  Status read_line(const std::string& key) {
    if (key == "v") return read_vector(positions_, 3, 7);
    if (key == "vt") return read_vector(uvs_, 1, 3);
    if (key == "vn") return read_vector(normals_, 3, 3);
    if (key == "f" || key == "fo") return read_face();
    if (key == "usemtl") {
      material_ = text_.rest_of_line();
      return {};
    }
    if (key == "mtllib") return materials_.read_library(std::string(text_.rest_of_line()));
    if (key == "l" || key == "p") {
      left_out_lines_ = true;
      return {};
    }
    // Names, groups, smoothing and display attributes do not change the surface.
    static constexpr std::array harmless{"o",        "g",   "s",          "mg",        "bevel",  "c_interp",
                                         "d_interp", "lod", "shadow_obj", "trace_obj", "usemap", "maplib"};
    if (std::find(harmless.begin(), harmless.end(), key) != harmless.end()) return {};
    static constexpr std::array free_form{"vp",   "cstype", "deg",   "bmat", "step", "curv", "curv2",
                                          "surf", "parm",   "trim",  "hole", "scrv", "sp",   "end",
                                          "con",  "ctech",  "stech", "call", "csh"};
    if (std::find(free_form.begin(), free_form.end(), key) != free_form.end()) {
      return unsupported_asset(text_.where(), "free-form geometry and calls are not read (" + key + ")",
                               "export the surface as polygons");
    }
    return text_.invalid("this is no statement of an OBJ file: " + key.substr(0, 40));
  }

  /// The first three numbers count, of them missing ones are 0; a weight or colours may follow.
  Status read_vector(std::vector<glm::dvec3>& list, int at_least, int at_most) {
    glm::dvec3 value(0.0);
    int count = 0;
    for (; !text_.at_end_of_line(); ++count) {
      const std::optional<double> number = number_from(text_.word());
      if (!number) return text_.invalid("a coordinate is no finite number");
      if (count == at_most) return text_.invalid("more numbers than this statement takes");
      if (count < 3) value[count] = *number;
    }
    if (count < at_least) return text_.invalid("fewer numbers than this statement takes");
    if (list.size() == most_vertices) return text_.invalid("more than 2^24 vertices");
    list.push_back(value);
    return {};
  }

  /// From the file's counting (from 1, or back from the end) to ours.
  bool resolve(std::string_view word, std::size_t count, std::uint32_t& index) {
    const std::optional<std::int64_t> number = integer_from(word);
    const auto size = static_cast<std::int64_t>(count);
    if (!number || *number == 0 || *number > size || *number < -size) return false;
    index = static_cast<std::uint32_t>(*number > 0 ? *number - 1 : size + *number);
    return true;
  }

  bool read_corner(std::string_view word, Corner& corner) {
    corner = {absent, absent, absent};
    const std::size_t first = word.find('/');
    if (!resolve(word.substr(0, first), positions_.size(), corner[0])) return false;
    if (first == std::string_view::npos) return true;
    const std::string_view after = word.substr(first + 1);
    const std::size_t second = after.find('/');
    const std::string_view uv = after.substr(0, second);
    if (uv.empty() && second == std::string_view::npos) return true;  // "7/", which some exporters write
    if (!uv.empty() && !resolve(uv, uvs_.size(), corner[1])) return false;
    return second == std::string_view::npos || resolve(after.substr(second + 1), normals_.size(), corner[2]);
  }

  Status read_face() {
    corners_.clear();
    places_.clear();
    while (!text_.at_end_of_line()) {
      Corner corner;
      if (!read_corner(text_.word(), corner)) return text_.invalid("a corner names no vertex the file has so far");
      if (corners_.size() == most_corners) return text_.invalid(too_many_corners);
      corners_.push_back(corner);
      places_.push_back(positions_[corner[0]]);
    }
    if (corners_.size() < 3) return text_.invalid("a face has fewer than three corners");
    for (const Corner& corner : corners_) {
      if ((corner[1] == absent) != (corners_[0][1] == absent) || (corner[2] == absent) != (corners_[0][2] == absent)) {
        return text_.invalid("the corners of a face do not carry the same");
      }
    }
    Group& group = groups_[{material_, corners_[0][1] != absent, corners_[0][2] != absent}];
    cut_.clear();
    if (!cutter_.cut(places_, cut_)) return text_.invalid("its polygons are too large to be cut into triangles");
    for (const glm::uvec3& t : cut_) {
      const std::uint32_t a = vertex(group, corners_[t.x]);
      const std::uint32_t b = vertex(group, corners_[t.y]);
      const std::uint32_t c = vertex(group, corners_[t.z]);
      group.mesh.triangles.emplace_back(a, b, c);
    }
    return {};
  }

  std::uint32_t vertex(Group& group, const Corner& corner) {
    Mesh& mesh = group.mesh;
    const auto [entry, is_new] =
        group.vertex_at.try_emplace(corner, static_cast<std::uint32_t>(mesh.positions_m.size()));
    if (is_new) {
      mesh.positions_m.push_back(positions_[corner[0]]);
      if (corner[1] != absent) mesh.uvs.emplace_back(uvs_[corner[1]]);
      if (corner[2] != absent) mesh.normals.push_back(normals_[corner[2]]);
    }
    return entry->second;
  }

  Result<MeshFile> finish() {
    std::vector<Mesh> meshes;
    std::vector<int> material_of_mesh;
    std::vector<Finding> findings = std::move(materials_.findings);
    const auto warn = [&](const char* code, const std::string& what) {
      findings.push_back(asset_finding(Severity::warning, code, file_.path, what));
    };
    for (auto& [key, group] : groups_) {
      const std::string& name = std::get<0>(key);
      if (!make_normals_unit(group.mesh)) warn("asset.normals", "a normal has no length; faces are lit flat");
      material_of_mesh.push_back(materials_.index_of(name));
      if (!name.empty() && material_of_mesh.back() < 0) {
        warn("asset.material-missing", "no library has the material " + name + "; it is white");
      }
      meshes.push_back(std::move(group.mesh));
    }
    if (left_out_lines_) warn("asset.lines", "lines and points are left out");
    if (cutter_.crossed() > 0) {
      warn("asset.crossed-polygons", std::to_string(cutter_.crossed()) + " polygons cross themselves");
    }
    Result<MeshFile> file =
        file_of_meshes(file_.path, std::move(meshes), std::move(material_of_mesh), positions_.size());
    if (!file) return file;
    file->model.materials = materials_.take();
    file->findings = std::move(findings);
    return file;
  }

  const FileToRead& file_;
  TextReader text_;
  ObjMaterials materials_;
  PolygonCutter cutter_;
  std::vector<glm::dvec3> positions_;
  std::vector<glm::dvec3> uvs_;
  std::vector<glm::dvec3> normals_;
  std::string material_;
  bool left_out_lines_ = false;
  std::map<std::tuple<std::string, bool, bool>, Group> groups_;  ///< material, has UVs, has normals
  std::vector<Corner> corners_;                                  // of the face being read
  std::vector<glm::dvec3> places_;
  std::vector<glm::uvec3> cut_;
};

/// The '\n' of a line that a backslash at `at` continues; 0 where it does not.
std::size_t continued_at(std::span<const std::byte> bytes, std::size_t at) {
  if (bytes[at] != std::byte{'\\'} || at + 1 == bytes.size()) return 0;
  const std::size_t end = bytes[at + 1] == std::byte{'\r'} && at + 2 < bytes.size() ? at + 2 : at + 1;
  return bytes[end] == std::byte{'\n'} ? end : 0;
}

/// `check_line_lengths` of what becomes of continued lines.
Status check_joined_lengths(std::span<const std::byte> bytes, const std::string& path) {
  std::size_t line_start = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (const std::size_t end = continued_at(bytes, i)) {
      i = end;
    } else if (bytes[i] == std::byte{'\n'}) {
      line_start = i + 1;
    }
    if (i + 1 - line_start > longest_line_bytes) {
      return invalid_asset(path + ": byte " + std::to_string(line_start), "a line is over 64 MiB long");
    }
  }
  return {};
}

/// A backslash at a line's end continues it on the next: both become spaces.
std::vector<std::byte> joined_lines(std::span<const std::byte> bytes) {
  std::vector<std::byte> joined(bytes.begin(), bytes.end());
  for (std::size_t i = 0; i < joined.size(); ++i) {
    const std::size_t end = continued_at(bytes, i);
    for (; end != 0 && i <= end; ++i) joined[i] = std::byte{' '};
    if (end != 0) --i;
  }
  return joined;
}

}  // namespace

Result<MeshFile> read_obj(const FileToRead& file) {
  if (Status lines = check_line_lengths(file.bytes, file.path); !lines) return lines.fault();
  if (std::find(file.bytes.begin(), file.bytes.end(), std::byte{'\\'}) == file.bytes.end()) {
    return ObjReader(file, file.bytes).read();
  }
  if (Status lines = check_joined_lengths(file.bytes, file.path); !lines) return lines.fault();
  const std::vector<std::byte> joined = joined_lines(file.bytes);
  return ObjReader(file, joined).read();
}

}  // namespace focalstage
