#include "editor/cli/power_file.h"

#include <charconv>
#include <string>
#include <string_view>

#include "io/files/files.h"

namespace focalstage {
namespace {

constexpr std::uint64_t largest_power_file_bytes = 16u << 20;
constexpr std::string_view blanks = " \t\r,;";

/// The numbers of one line; nothing where something else stands in it.
std::optional<std::vector<double>> numbers_of(std::string_view line) {
  std::vector<double> numbers;
  for (std::size_t at = line.find_first_not_of(blanks); at != std::string_view::npos;
       at = line.find_first_not_of(blanks)) {
    line.remove_prefix(at);
    double number = 0.0;
    const auto [end, problem] = std::from_chars(line.data(), line.data() + line.size(), number);
    if (problem != std::errc{}) return std::nullopt;
    line.remove_prefix(static_cast<std::size_t>(end - line.data()));
    if (!line.empty() && blanks.find(line.front()) == std::string_view::npos) return std::nullopt;
    numbers.push_back(number);
  }
  return numbers;
}

}  // namespace

Result<PerEye<std::vector<double>>> read_power(const std::filesystem::path& file) {
  const auto bytes = read_file(file, largest_power_file_bytes);
  if (!bytes) return bytes.fault();
  std::string_view rest(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  PerEye<std::vector<double>> power_d;
  std::size_t columns = 0;
  for (int line = 1; !rest.empty(); ++line) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view text = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (text.starts_with('#')) continue;
    const auto numbers = numbers_of(text);
    if (numbers && numbers->empty()) continue;
    if (!numbers || numbers->size() > 2 || (columns != 0 && numbers->size() != columns)) {
      return Fault{"wanted.file", file.string() + ": line " + std::to_string(line),
                   "is not one sample, or one for each eye, as the lines before it",
                   "write one power in dioptres a line"};
    }
    columns = numbers->size();
    power_d.left.push_back(numbers->front());
    power_d.right.push_back(numbers->back());
  }
  return power_d;
}

}  // namespace focalstage
