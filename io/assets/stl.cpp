#include <cmath>
#include <unordered_map>

#include <glm/geometric.hpp>

#include "core/mesh/position_hash.h"
#include "io/assets/byte_reader.h"
#include "io/assets/mesh_file.h"
#include "io/assets/text_reader.h"

namespace focalstage {
namespace {

constexpr std::size_t header_bytes = 84;
constexpr std::size_t facet_bytes = 50;

/// Facets in the file's order; equal corners become one vertex, which loses nothing, since an STL's corners carry
/// nothing else. Its normals say what the winding says already; where they disagree the winding counts.
class Facets {
 public:
  void add(const glm::dvec3 (&corner)[3], const glm::dvec3& normal) {
    glm::uvec3 triangle;
    for (int i = 0; i < 3; ++i) {
      const auto [entry, is_new] =
          vertex_at_.try_emplace(corner[i], static_cast<std::uint32_t>(mesh_.positions_m.size()));
      if (is_new) mesh_.positions_m.push_back(corner[i]);
      triangle[i] = entry->second;
    }
    mesh_.triangles.push_back(triangle);
    against_winding_ += glm::dot(glm::cross(corner[1] - corner[0], corner[2] - corner[0]), normal) < 0.0;
  }

  std::size_t count() const { return mesh_.triangles.size(); }

  Result<MeshFile> file(const std::string& path) {
    const std::size_t vertices = mesh_.positions_m.size();
    std::vector<Mesh> meshes;
    meshes.push_back(std::move(mesh_));
    Result<MeshFile> result = file_of_meshes(path, std::move(meshes), {-1}, vertices);
    if (result && against_winding_ > 0) {
      result->findings.push_back(
          asset_finding(Severity::warning, "asset.normals", path,
                        std::to_string(against_winding_) + " facets wind against their normal; the winding counts"));
    }
    return result;
  }

 private:
  Mesh mesh_;
  std::unordered_map<glm::dvec3, std::uint32_t, PositionHash> vertex_at_;
  std::size_t against_winding_ = 0;
};

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

glm::dvec3 triple_at(const std::byte* bytes) {
  return {number_at<float>(bytes), number_at<float>(bytes + 4), number_at<float>(bytes + 8)};
}

Result<MeshFile> read_binary(const FileToRead& file) {
  Facets facets;
  for (std::size_t at = header_bytes; at < file.bytes.size(); at += facet_bytes) {
    const std::byte* facet = file.bytes.data() + at;
    const glm::dvec3 corner[3] = {triple_at(facet + 12), triple_at(facet + 24), triple_at(facet + 36)};
    if (!finite(corner[0]) || !finite(corner[1]) || !finite(corner[2])) {
      return invalid_asset(file.path + ": byte " + std::to_string(at), "a facet has a corner that is not finite");
    }
    facets.add(corner, triple_at(facet));  // a normal may be NaN, as of a facet without area
  }
  return facets.file(file.path);
}

/// Keywords come in capitals, too.
bool is(std::string_view word, std::string_view keyword) {
  if (word.size() != keyword.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i) {
    const char c = word[i] >= 'A' && word[i] <= 'Z' ? static_cast<char>(word[i] - 'A' + 'a') : word[i];
    if (c != keyword[i]) return false;
  }
  return true;
}

class AsciiReader {
 public:
  explicit AsciiReader(const FileToRead& file) : file_(file), text_(file.bytes, file.path, 0) {}

  Result<MeshFile> read() {
    std::size_t solids = 0;
    while (text_.next_line()) {
      if (!is(text_.word(), "solid")) return text_.invalid("`solid` is expected");
      text_.rest_of_line();  // its name
      if (Status status = read_solid(); !status) return status.fault();
      text_.rest_of_line();
      ++solids;
    }
    if (solids == 0) return invalid_asset(file_.path, "the file is empty");
    return facets_.file(file_.path);
  }

 private:
  Status expect(std::string_view keyword) {
    if (is(text_.word_across_lines(), keyword)) return {};
    return text_.invalid("`" + std::string(keyword) + "` is expected");
  }

  Status read_solid() {
    for (;;) {
      const std::string_view word = text_.word_across_lines();
      if (is(word, "endsolid")) return {};
      if (!is(word, "facet")) return text_.invalid("`facet` or `endsolid` is expected");
      if (Status status = read_facet(); !status) return status;
    }
  }

  Status read_facet() {
    if (Status status = expect("normal"); !status) return status;
    glm::dvec3 normal(0.0);
    for (int i = 0; i < 3; ++i) {
      const std::string_view word = text_.word_across_lines();
      if (word.empty()) return text_.invalid("a normal is expected");
      normal[i] = number_from(word).value_or(0.0);  // `nan` where a facet has no area
    }
    for (const std::string_view keyword : {"outer", "loop"}) {
      if (Status status = expect(keyword); !status) return status;
    }
    glm::dvec3 corner[3];
    for (glm::dvec3& place : corner) {
      if (Status status = expect("vertex"); !status) return status;
      for (int i = 0; i < 3; ++i) {
        const std::optional<double> number = number_from(text_.word_across_lines());
        if (!number) return text_.invalid("a coordinate is no finite number");
        place[i] = *number;
      }
    }
    for (const std::string_view keyword : {"endloop", "endfacet"}) {
      if (Status status = expect(keyword); !status) return status;
    }
    facets_.add(corner, normal);
    return {};
  }

  const FileToRead& file_;
  TextReader text_;
  Facets facets_;
};

}  // namespace

Result<MeshFile> read_stl(const FileToRead& file) {
  // The size decides: a binary file may begin with "solid", too, but no text has a facet count that fits its length.
  std::uint64_t count = 0;
  if (file.bytes.size() >= header_bytes) {
    count = number_at<std::uint32_t>(file.bytes.data() + 80);
    if (file.bytes.size() == header_bytes + count * facet_bytes) return read_binary(file);
  }
  TextReader text(file.bytes, file.path, 0);
  const bool has_lines = check_line_lengths(file.bytes, file.path).ok();
  if (has_lines && text.next_line() && is(text.word(), "solid")) return AsciiReader(file).read();
  if (file.bytes.size() < header_bytes) return invalid_asset(file.path, "the file is shorter than any STL");
  return invalid_asset(file.path, "the file announces " + std::to_string(count) + " facets, which take " +
                                      std::to_string(header_bytes + count * facet_bytes) + " bytes, and has " +
                                      std::to_string(file.bytes.size()));
}

}  // namespace focalstage
