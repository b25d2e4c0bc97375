#include "editor/cli/scan_file.h"

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

#include "core/scene/fields.h"
#include "core/scene/project.h"
#include "core/scene/rules.h"
#include "io/files/files.h"
#include "io/json/json.h"

namespace focalstage {
namespace {

constexpr std::uint64_t largest_file_bytes = 4u << 20;

struct PatternsRow : PatternsFile {
  int version = 1;
  Unknown unknown{};
};

struct BoardRow : CharucoBoard {
  glm::ivec2 squares{9, 7};
  Unknown unknown{};
};

struct CaptureRow : CaptureEntry {
  Unknown unknown{};
};

struct MarkRow : WorldMark {
  Unknown unknown{};
};

struct WorldRow {
  std::string capture;
  std::optional<glm::dvec3> position_m;
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
  std::vector<MarkRow> marks;
  Unknown unknown{};
};

struct ScanRow {
  BoardRow board;
  std::vector<CaptureRow> captures;
  WorldRow world;
  std::string mesh_of;
  Unknown unknown{};
};

}  // namespace

template <>
struct Table<PatternsRow> {
  static constexpr Rule size{.low = 16, .high = 16384};
  static constexpr auto fields = std::make_tuple(
      field("focalstage_patterns", at(&PatternsRow::version), Presence::required, {.low = 1, .high = 1}),
      field("projector", at(&PatternsFile::projector), Presence::required),
      field("width_px", at(&PatternsFile::set, &PatternSet::width_px), Presence::required, size),
      field("height_px", at(&PatternsFile::set, &PatternSet::height_px), Presence::required, size),
      field("gamma", at(&PatternsFile::set, &PatternSet::gamma), Presence::required, {.low = 0.1, .high = 10}),
      field("stripe_px", at(&PatternsFile::set, &PatternSet::stripe_px), Presence::required, {.low = 1, .high = 64}),
      field("period_px", at(&PatternsFile::set, &PatternSet::period_px), Presence::required, {.low = 4, .high = 1024}),
      field("steps", at(&PatternsFile::set, &PatternSet::steps), Presence::required, {.low = 4, .high = 32}));
};

template <>
struct Table<BoardRow> {
  static constexpr auto fields =
      std::make_tuple(field("squares", at(&BoardRow::squares), Presence::required, {.low = 3, .high = 50}),
                      field("square_m", at(&CharucoBoard::square_m), Presence::required, length_m),
                      field("marker_m", at(&CharucoBoard::marker_m), Presence::required, length_m),
                      field("dictionary", at(&CharucoBoard::dictionary), Presence::optional));
};

template <>
struct Table<CaptureRow> {
  static constexpr auto fields = std::make_tuple(field("folder", at(&CaptureEntry::folder), Presence::required, a_name),
                                                 field("board", at(&CaptureEntry::board), Presence::optional));
};

template <>
struct Table<MarkRow> {
  static constexpr auto fields =
      std::make_tuple(field("name", at(&WorldMark::name), Presence::optional),
                      field("pixel", at(&WorldMark::camera_px), Presence::required, {.low = 0, .high = 16384}),
                      field("world_m", at(&WorldMark::world_m), Presence::required, anywhere_m));
};

template <>
struct Table<WorldRow> {
  static constexpr auto fields =
      std::make_tuple(field("capture", at(&WorldRow::capture), Presence::required),
                      field("position_m", at(&WorldRow::position_m), Presence::optional, anywhere_m),
                      field("rotation_xyzw", at(&WorldRow::rotation), Presence::optional),
                      field("marks", at(&WorldRow::marks), Presence::optional, {.most = 1000}));

  static bool check(Reading& reading, const WorldRow& world) {
    if (world.position_m.has_value() != !world.marks.empty()) return true;
    return reading.fail("scan.world", "tells neither where the board stood nor marks, or both",
                        "give position_m and rotation_xyzw of the board in that capture, or marks");
  }
};

template <>
struct Table<ScanRow> {
  static constexpr auto fields =
      std::make_tuple(field("board", at(&ScanRow::board), Presence::required),
                      field("captures", at(&ScanRow::captures), Presence::required, {.least = 1, .most = 100}),
                      field("world", at(&ScanRow::world), Presence::required),
                      field("mesh_of", at(&ScanRow::mesh_of), Presence::optional));
};

namespace {

template <class Row>
Result<Row> read_row(const std::filesystem::path& file) {
  const auto bytes = read_file(file, largest_file_bytes);
  if (!bytes) return bytes.fault();
  const auto value = parse_json({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, file.string());
  if (!value) return value.fault();
  Reading reading(nullptr);
  Row row;
  if (Codec<Row>::read(reading, *value, row, {})) return row;
  Fault fault = *reading.fault();
  fault.code = "scan.file";
  fault.where = file.string() + ": " + (fault.where.empty() ? "/" : fault.where);
  return fault;
}

Result<std::size_t> index_of(const ScanRow& row, const std::string& folder, const std::string& where) {
  const auto found = std::ranges::find(row.captures, folder, &CaptureRow::folder);
  if (found != row.captures.end()) return static_cast<std::size_t>(found - row.captures.begin());
  return Fault{"scan.file", where, "there is no capture \"" + folder + "\"", "name the folder of one of /captures"};
}

}  // namespace

std::string patterns_text(const PatternsFile& patterns) {
  PatternsRow row;
  row.projector = patterns.projector;
  row.set = patterns.set;
  Value value = Codec<PatternsRow>::write(row);
  Value::Array pictures;
  for (std::size_t i = 0; i < patterns_of(patterns.set).size(); ++i) {
    pictures.push_back(picture_name(patterns.set, i) + ".png");
  }
  value.set("pictures", std::move(pictures));
  return write_json(value) + "\n";
}

Result<PatternsFile> read_patterns(const std::filesystem::path& file) {
  auto row = read_row<PatternsRow>(file);
  if (!row) return row.fault();
  if (Status good = check_set(row->set); !good) {
    Fault fault = good.fault();
    fault.where = file.string() + ": /" + fault.where;
    return fault;
  }
  return PatternsFile{std::move(row->projector), row->set};
}

std::string picture_name(const PatternSet& set, std::size_t index) {
  const std::string number = std::to_string(index);
  return (number.size() < 2 ? "0" : "") + number + "-" + name_of(patterns_of(set)[index]);
}

Result<ScanFile> read_scan(const std::filesystem::path& file) {
  const auto row = read_row<ScanRow>(file);
  if (!row) return row.fault();
  ScanFile scan;
  scan.board = row->board;
  scan.board.squares_x = row->board.squares.x;
  scan.board.squares_y = row->board.squares.y;
  for (const CaptureRow& capture : row->captures) scan.captures.push_back(capture);
  const auto world = index_of(*row, row->world.capture, file.string() + ": /world/capture");
  if (!world) return world.fault();
  scan.world.capture = *world;
  if (row->world.position_m) scan.world.world_from_board = Rigid{*row->world.position_m, row->world.rotation};
  for (const MarkRow& mark : row->world.marks) scan.world.marks.push_back(mark);
  scan.mesh_of = scan.captures.size() - 1;
  if (row->mesh_of.empty()) return scan;
  const auto mesh = index_of(*row, row->mesh_of, file.string() + ": /mesh_of");
  if (!mesh) return mesh.fault();
  scan.mesh_of = *mesh;
  return scan;
}

}  // namespace focalstage
