#include "devices/camera/pgm.h"

#include <cctype>
#include <fstream>
#include <optional>

namespace focalstage {

namespace {

constexpr int longest_side_px = 16384;

/// The next number of a header, past blanks and comments; takes the one blank behind it.
std::optional<int> next_number(std::istream& file) {
  int c = file.get();
  while (file && (std::isspace(c) != 0 || c == '#')) {
    if (c == '#') {
      while (file && c != '\n') c = file.get();
    }
    c = file.get();
  }
  int number = 0;
  int digits = 0;
  for (; file && std::isdigit(c) != 0 && digits < 6; ++digits) {
    number = 10 * number + (c - '0');
    c = file.get();
  }
  if (digits == 0 || std::isspace(c) == 0) return std::nullopt;
  return number;
}

}  // namespace

Result<GrayImage> read_pgm(const std::string& path) {
  const auto refused = [&](const std::string& reason) {
    return Fault{"camera.picture", path, reason, "record binary PGM files (P5) of 8 bits"};
  };
  std::ifstream file(path, std::ios::binary);
  if (!file) return refused("the file can't be opened");
  if (file.get() != 'P' || file.get() != '5') return refused("it does not begin with P5");
  const auto width = next_number(file);
  const auto height = next_number(file);
  const auto white = next_number(file);
  if (!width || !height || !white) return refused("its header is damaged");
  if (*width < 1 || *height < 1 || *width > longest_side_px || *height > longest_side_px) {
    return refused("it has " + std::to_string(*width) + " x " + std::to_string(*height) + " pixels");
  }
  if (*white != 255) return refused("its white is " + std::to_string(*white) + " instead of 255");
  GrayImage image{*width, *height, {}};
  image.gray.resize(static_cast<std::size_t>(*width) * static_cast<std::size_t>(*height));
  file.read(reinterpret_cast<char*>(image.gray.data()), static_cast<std::streamsize>(image.gray.size()));
  if (!file) return refused("it ends too early");
  return image;
}

Status write_pgm(const std::string& path, const GrayImage& image) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file << "P5\n" << image.width_px << " " << image.height_px << "\n255\n";
  file.write(reinterpret_cast<const char*>(image.gray.data()), static_cast<std::streamsize>(image.gray.size()));
  file.close();
  if (file) return {};
  return Fault{"camera.unwritable", path, "the picture can't be written", "choose another place"};
}

}  // namespace focalstage
