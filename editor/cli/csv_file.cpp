#include "editor/cli/csv_file.h"

#include <algorithm>
#include <charconv>
#include <cstdint>

#include "io/files/files.h"

namespace focalstage {
namespace {

constexpr std::uint64_t largest_file_bytes = 1u << 20;

std::string_view without_blanks(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

std::vector<std::string> cells_of(std::string_view line) {
  std::vector<std::string> cells;
  for (;;) {
    const std::size_t end = std::min(line.find(','), line.size());
    cells.emplace_back(without_blanks(line.substr(0, end)));
    if (end == line.size()) return cells;
    line.remove_prefix(end + 1);
  }
}

}  // namespace

Result<std::vector<CsvLine>> read_csv(const std::filesystem::path& file, std::string_view columns, const char* code) {
  const auto bytes = read_file(file, largest_file_bytes);
  if (!bytes) return bytes.fault();
  std::string_view rest(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  const std::size_t wanted = cells_of(columns).size();
  std::vector<CsvLine> lines;
  bool headed = false;
  for (int number = 1; !rest.empty(); ++number) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = without_blanks(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (line.empty() || line.starts_with('#')) continue;
    const std::string where = file.string() + ": line " + std::to_string(number);
    if (!headed && line != columns) {
      return Fault{code, where, "the columns are not told", "begin with the line " + std::string(columns)};
    }
    if (headed) {
      lines.push_back({where, cells_of(line)});
      if (lines.back().cells.size() != wanted) {
        return Fault{code, where, "has not " + std::to_string(wanted) + " columns", "write " + std::string(columns)};
      }
    }
    headed = true;
  }
  return lines;
}

std::optional<double> number_of(const std::string& cell) {
  double number = 0.0;
  const char* stop = cell.data() + cell.size();
  const auto [end, problem] = std::from_chars(cell.data(), stop, number);
  if (problem != std::errc{} || end != stop) return std::nullopt;
  return number;
}

}  // namespace focalstage
