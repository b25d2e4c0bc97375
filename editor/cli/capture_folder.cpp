#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "core/base/luminance.h"
#include "editor/cli/scan_file.h"
#include "io/files/files.h"
#include "io/image/png.h"

namespace focalstage {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t largest_picture_bytes = 64u << 20;
constexpr std::size_t most_pixels = 1u << 24;  // of one picture: a capture has fifty of them

bool is_picture(const fs::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending == ".png" || ending == ".jpg" || ending == ".jpeg";
}

bool digit(char c) { return c >= '0' && c <= '9'; }

/// As a person counts: "9.png" before "10.png".
bool before(const std::string& a, const std::string& b) {
  std::size_t i = 0;
  std::size_t k = 0;
  while (i < a.size() && k < b.size()) {
    if (digit(a[i]) && digit(b[k])) {
      const auto number = [](const std::string& text, std::size_t& at) {
        std::size_t end = at;
        while (end < text.size() && digit(text[end])) ++end;
        while (at + 1 < end && text[at] == '0') ++at;
        const std::string digits = text.substr(at, end - at);
        at = end;
        return digits;
      };
      const std::string first = number(a, i);
      const std::string second = number(b, k);
      if (first != second) return first.size() != second.size() ? first.size() < second.size() : first < second;
    } else {
      if (a[i] != b[k]) return a[i] < b[k];
      ++i;
      ++k;
    }
  }
  return a.size() - i < b.size() - k;
}

Result<std::vector<fs::path>> pictures_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code problem;
  for (fs::directory_iterator it(folder, problem), end; !problem && it != end; it.increment(problem)) {
    if (is_picture(it->path())) files.push_back(it->path());
  }
  if (problem) return Fault{"capture.missing", folder.string(), problem.message(), "name a folder of pictures"};
  std::ranges::sort(
      files, [](const fs::path& a, const fs::path& b) { return before(a.filename().string(), b.filename().string()); });
  return files;
}

/// Which picture is lacking, where names begin with their number.
std::string lacking(const std::vector<fs::path>& files, const PatternSet& set) {
  std::set<std::size_t> numbers;
  for (const fs::path& file : files) {
    const std::string name = file.filename().string();
    std::size_t number = 0;
    if (std::from_chars(name.data(), name.data() + name.size(), number).ec != std::errc{}) return "";
    numbers.insert(number);
  }
  for (std::size_t i = 0; i < patterns_of(set).size(); ++i) {
    if (!numbers.contains(i)) return "; " + picture_name(set, i) + " is not there";
  }
  return "";
}

Result<CameraPicture> read_picture(const fs::path& file) {
  const auto bytes = read_file(file, largest_picture_bytes);
  if (!bytes) return bytes.fault();
  const auto texture = decode_image(*bytes, file.string());
  if (!texture) return texture.fault();
  const std::size_t pixels = texture->rgba.size() / 4;
  if (pixels > most_pixels) {
    return Fault{"image.too-large", file.string(), "it has more than 16 million pixels", "make the pictures smaller"};
  }
  CameraPicture picture{file.filename().string(), texture->width_px, texture->height_px, {}};
  picture.gray.reserve(pixels);
  for (std::size_t i = 0; i < 4 * pixels; i += 4) {
    const auto& c = texture->rgba;
    const double gray = luminance<double>(c[i], c[i + 1], c[i + 2]);
    picture.gray.push_back(static_cast<std::uint8_t>(gray + 0.5));
  }
  return picture;
}

}  // namespace

Result<Capture> read_capture(const fs::path& folder, const PatternSet& set) {
  const auto files = pictures_in(folder);
  if (!files) return files.fault();
  const std::size_t wanted = patterns_of(set).size();
  if (files->size() != wanted) {
    return Fault{"capture.missing", folder.string(),
                 "there are " + std::to_string(files->size()) + " pictures, " + std::to_string(wanted) + " are wanted" +
                     lacking(*files, set),
                 "capture all patterns again, one picture for each"};
  }
  Capture capture;
  for (const fs::path& file : *files) {
    auto picture = read_picture(file);
    if (!picture) return picture.fault();
    capture.push_back(std::move(*picture));
  }
  return capture;
}

}  // namespace focalstage
