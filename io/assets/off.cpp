#include "io/assets/mesh_file.h"
#include "io/assets/polygons.h"
#include "io/assets/text_reader.h"

namespace focalstage {
namespace {

class OffReader {
 public:
  explicit OffReader(const FileToRead& file) : file_(file), text_(file.bytes, file.path) {}

  Result<MeshFile> read() {
    for (const auto part : {&OffReader::read_header, &OffReader::read_vertices, &OffReader::read_faces}) {
      if (Status status = (this->*part)(); !status) return status.fault();
    }
    if (text_.next_line()) return text_.invalid("more lines than the file announces");
    std::vector<Finding> findings;
    if (!make_normals_unit(mesh_)) {
      findings.push_back(
          asset_finding(Severity::warning, "asset.normals", file_.path, "a normal has no length; faces are lit flat"));
    }
    if (cutter_.crossed() > 0) {
      findings.push_back(asset_finding(Severity::warning, "asset.crossed-polygons", file_.path,
                                       std::to_string(cutter_.crossed()) + " polygons cross themselves"));
    }
    if (colors_) {
      findings.push_back(
          asset_finding(Severity::info, "asset.colors", file_.path, "vertex and face colours are left out"));
    }
    const std::size_t vertices = mesh_.positions_m.size();
    std::vector<Mesh> meshes;
    meshes.push_back(std::move(mesh_));
    Result<MeshFile> result = file_of_meshes(file_.path, std::move(meshes), {-1}, vertices);
    if (result) result->findings = std::move(findings);
    return result;
  }

 private:
  bool read_count(std::size_t& count) {
    const std::optional<std::int64_t> number = integer_from(text_.word_across_lines());
    // The shortest vertex and the shortest face take five bytes and more: "0 0 0".
    if (!number || *number < 0 || static_cast<std::uint64_t>(*number) > file_.bytes.size() / 5) return false;
    count = static_cast<std::size_t>(*number);
    return true;
  }

  Status read_header() {
    if (!text_.next_line()) return invalid_asset(file_.path, "the file is empty");
    const std::string keyword(text_.word());
    has_normals_ = keyword == "NOFF";
    colors_ = keyword == "COFF";
    if (keyword == "STOFF" || keyword == "4OFF" || keyword == "nOFF" || keyword == "CNOFF") {
      return unsupported_asset(text_.where(), "this kind of OFF is not read (" + keyword + ")", "export OFF or PLY");
    }
    if (!has_normals_ && !colors_ && keyword != "OFF") return text_.invalid("an OFF file begins with OFF");
    if (!text_.at_end_of_line()) {
      TextReader ahead = text_;
      if (ahead.word() == "BINARY") return unsupported_asset(text_.where(), "binary OFF is not read", "export PLY");
    }
    const bool counted = read_count(vertices_) && read_count(faces_);
    const std::optional<std::int64_t> edge_count = integer_from(text_.word_across_lines());
    if (!counted || !edge_count) return text_.invalid("the counts of vertices, faces and edges are wrong");
    if (!text_.at_end_of_line()) return text_.invalid("more than the counts of vertices, faces and edges");
    return {};
  }

  bool read_triple(glm::dvec3& value) {
    for (int i = 0; i < 3; ++i) {
      const std::optional<double> number = number_from(text_.word());
      if (!number) return false;
      value[i] = *number;
    }
    return true;
  }

  Status read_vertices() {
    for (std::size_t i = 0; i < vertices_; ++i) {
      if (!text_.next_line()) return text_.invalid("the file ends before its last vertex");
      glm::dvec3 value;
      if (!read_triple(value)) return text_.invalid("a vertex is not three finite numbers");
      mesh_.positions_m.push_back(value);
      if (has_normals_) {
        if (!read_triple(value)) return text_.invalid("a normal is not three finite numbers");
        mesh_.normals.push_back(value);
      }
      if (!colors_ && !text_.at_end_of_line()) return text_.invalid("more numbers than a vertex has");
    }
    return {};
  }

  Status read_faces() {
    for (std::size_t i = 0; i < faces_; ++i) {
      if (!text_.next_line()) return text_.invalid("the file ends before its last face");
      const std::optional<std::int64_t> count = integer_from(text_.word());
      if (!count || *count < 3) return text_.invalid("a face has fewer than three corners");
      if (static_cast<std::uint64_t>(*count) > most_corners) return text_.invalid(too_many_corners);
      corners_.clear();
      places_.clear();
      for (std::int64_t k = 0; k < *count; ++k) {
        const std::optional<std::int64_t> index = integer_from(text_.word());
        if (!index || *index < 0 || static_cast<std::uint64_t>(*index) >= vertices_) {
          return text_.invalid("a corner names no vertex of the file");
        }
        corners_.push_back(static_cast<std::uint32_t>(*index));
        places_.push_back(mesh_.positions_m[corners_.back()]);
      }
      colors_ = colors_ || !text_.at_end_of_line();
      cut_.clear();
      if (!cutter_.cut(places_, cut_)) return text_.invalid("its polygons are too large to be cut into triangles");
      for (const glm::uvec3& t : cut_) mesh_.triangles.emplace_back(corners_[t.x], corners_[t.y], corners_[t.z]);
    }
    return {};
  }

  const FileToRead& file_;
  TextReader text_;
  PolygonCutter cutter_;
  Mesh mesh_;
  bool has_normals_ = false;
  bool colors_ = false;
  std::size_t vertices_ = 0;
  std::size_t faces_ = 0;
  std::vector<std::uint32_t> corners_;
  std::vector<glm::dvec3> places_;
  std::vector<glm::uvec3> cut_;
};

}  // namespace

Result<MeshFile> read_off(const FileToRead& file) {
  if (Status lines = check_line_lengths(file.bytes, file.path); !lines) return lines.fault();
  return OffReader(file).read();
}

}  // namespace focalstage
