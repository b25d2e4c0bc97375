#include "editor/cli/points_file.h"

#include <tuple>
#include <utility>

#include "core/scene/fields.h"
#include "core/scene/project.h"
#include "core/scene/rules.h"
#include "io/files/files.h"
#include "io/json/json.h"

namespace focalstage {
namespace {

constexpr std::uint64_t largest_points_file_bytes = 4u << 20;

struct PointRow {
  PickedPoint point;
  Unknown unknown{};
};

struct PointRows {
  std::string projector;
  std::vector<PointRow> points;
  Unknown unknown{};
};

}  // namespace

template <>
struct Table<PointRow> {
  static constexpr auto fields =
      std::make_tuple(field("name", at(&PointRow::point, &PickedPoint::name), Presence::optional),
                      field("world_m", at(&PointRow::point, &PickedPoint::world_m), Presence::required, anywhere_m),
                      field("pixel", at(&PointRow::point, &PickedPoint::pixel), Presence::required, {}));
};

template <>
struct Table<PointRows> {
  static constexpr auto fields =
      std::make_tuple(field("projector", at(&PointRows::projector), Presence::optional),
                      field("points", at(&PointRows::points), Presence::required, {.most = 10000}));
};

Result<PointsFile> read_points(const std::filesystem::path& file) {
  const auto bytes = read_file(file, largest_points_file_bytes);
  if (!bytes) return bytes.fault();
  const auto value = parse_json({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, file.string());
  if (!value) return value.fault();
  Reading reading(nullptr);
  PointRows rows;
  if (!Codec<PointRows>::read(reading, *value, rows, {})) {
    Fault fault = *reading.fault();
    fault.code = "points.file";
    fault.where = file.string() + ": " + (fault.where.empty() ? "/" : fault.where);
    return fault;
  }
  PointsFile points{std::move(rows.projector), {}};
  for (PointRow& row : rows.points) points.points.push_back(std::move(row.point));
  return points;
}

}  // namespace focalstage
