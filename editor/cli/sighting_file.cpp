#include "editor/cli/sighting_file.h"

#include <array>
#include <string>

#include "editor/cli/csv_file.h"

namespace focalstage {
namespace {

constexpr std::size_t number_count = 13;
constexpr std::size_t first_number = 2;

}  // namespace

Result<std::vector<Sighting>> read_sightings(const std::filesystem::path& file, const Rigid& world_from_tracker) {
  const auto lines = read_csv(file, sighting_columns, "sightings.file");
  if (!lines) return lines.fault();
  std::vector<Sighting> sightings;
  for (const CsvLine& line : *lines) {
    std::array<double, number_count> n{};
    bool good = line.cells[1] == "left" || line.cells[1] == "right";
    for (std::size_t i = 0; i < number_count; ++i) {
      const auto number = number_of(line.cells[first_number + i]);
      good = good && number.has_value();
      n[i] = number.value_or(0.0);
    }
    if (!good) {
      return Fault{"sightings.file", line.where, "is not a name, left or right, and thirteen numbers",
                   std::string("write ") + sighting_columns};
    }
    const Rigid tracker_from_body{{n[0], n[1], n[2]}, {n[6], n[3], n[4], n[5]}};
    sightings.push_back({line.cells[0],
                         line.cells[1] == "left" ? Side::left : Side::right,
                         world_from_tracker * tracker_from_body,
                         {n[7], n[8], n[9]},
                         {n[10], n[11], n[12]}});
  }
  return sightings;
}

}  // namespace focalstage
