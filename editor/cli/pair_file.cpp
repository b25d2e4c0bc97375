#include "editor/cli/pair_file.h"

#include "editor/cli/csv_file.h"

namespace focalstage {
namespace {

constexpr const char* columns = "name,tracker_x_m,tracker_y_m,tracker_z_m,world_x_m,world_y_m,world_z_m";

}  // namespace

Result<std::vector<PointPair>> read_pairs(const std::filesystem::path& file) {
  const auto lines = read_csv(file, columns, "align.file");
  if (!lines) return lines.fault();
  std::vector<PointPair> pairs;
  for (const CsvLine& line : *lines) {
    PointPair pair{line.cells[0], {}, {}};
    for (int i = 0; i < 6; ++i) {
      const auto number = number_of(line.cells[static_cast<std::size_t>(i) + 1]);
      if (!number) {
        return Fault{"align.file", line.where, "is not a name and six numbers", std::string("write ") + columns};
      }
      (i < 3 ? pair.tracker_m : pair.world_m)[i % 3] = *number;
    }
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

}  // namespace focalstage
