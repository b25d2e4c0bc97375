#include "devices/camera/pgm.h"

#include <cctype>
#include <fstream>
#include <optional>

namespace focalstage {

namespace {

constexpr int longest_side_px = 16384;

Fault refused(const std::string& name, const std::string& reason) {
  return {"camera.picture", name, reason, "record binary PGM files (P5) of 8 bits"};
}

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

Result<GrayImage> read_pgm(std::istream& bytes, const std::string& name) {
  if (bytes.get() != 'P' || bytes.get() != '5') return refused(name, "it does not begin with P5");
  const auto width = next_number(bytes);
  const auto height = next_number(bytes);
  const auto white = next_number(bytes);
  if (!width || !height || !white) return refused(name, "its header is damaged");
  if (*width < 1 || *height < 1 || *width > longest_side_px || *height > longest_side_px) {
    return refused(name, "it has " + std::to_string(*width) + " x " + std::to_string(*height) + " pixels");
  }
  if (*white != 255) return refused(name, "its white is " + std::to_string(*white) + " instead of 255");
  GrayImage image{*width, *height, {}};
  // Row by row: a header alone does not take memory for what is not there.
  const auto row = static_cast<std::size_t>(*width);
  for (int y = 0; y < *height; ++y) {
    image.gray.resize(image.gray.size() + row);
    bytes.read(reinterpret_cast<char*>(image.gray.data() + image.gray.size() - row), static_cast<std::streamsize>(row));
    if (!bytes) return refused(name, "it ends too early");
  }
  return image;
}

Result<GrayImage> read_pgm(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return refused(path, "the file can't be opened");
  return read_pgm(file, path);
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
