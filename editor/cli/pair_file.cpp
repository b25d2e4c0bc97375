#include "editor/cli/pair_file.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>

#include "io/files/files.h"

namespace focalstage {
namespace {

constexpr std::uint64_t largest_pair_file_bytes = 1u << 20;
constexpr std::string_view columns = "name,tracker_x_m,tracker_y_m,tracker_z_m,world_x_m,world_y_m,world_z_m";

std::string_view without_blanks(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

/// Cuts the text before the next comma off.
std::string_view next_cell(std::string_view& rest) {
  const std::size_t end = std::min(rest.find(','), rest.size());
  const std::string_view cell = without_blanks(rest.substr(0, end));
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return cell;
}

std::optional<PointPair> pair_of(std::string_view line) {
  if (std::count(line.begin(), line.end(), ',') != 6) return std::nullopt;
  PointPair pair;
  pair.name = next_cell(line);
  for (glm::dvec3* point : {&pair.tracker_m, &pair.world_m}) {
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view cell = next_cell(line);
      const auto [end, problem] = std::from_chars(cell.data(), cell.data() + cell.size(), (*point)[axis]);
      if (problem != std::errc{} || end != cell.data() + cell.size()) return std::nullopt;
    }
  }
  return pair;
}

}  // namespace

Result<std::vector<PointPair>> read_pairs(const std::filesystem::path& file) {
  const auto bytes = read_file(file, largest_pair_file_bytes);
  if (!bytes) return bytes.fault();
  std::string_view rest(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  std::vector<PointPair> pairs;
  bool headed = false;
  for (int number = 1; !rest.empty(); ++number) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = without_blanks(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (line.empty() || line.starts_with('#')) continue;
    const std::string where = file.string() + ": line " + std::to_string(number);
    if (!headed && line != columns) {
      return Fault{"align.file", where, "the columns are not told", "begin with the line " + std::string(columns)};
    }
    if (headed) {
      auto pair = pair_of(line);
      if (!pair) return Fault{"align.file", where, "is not a name and six numbers", "write " + std::string(columns)};
      pairs.push_back(std::move(*pair));
    }
    headed = true;
  }
  return pairs;
}

}  // namespace focalstage
