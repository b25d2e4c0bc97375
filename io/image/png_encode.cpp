#include <png.h>

#include <cstdio>
#include <new>
#include <vector>

#include "io/files/files.h"
#include "io/image/png.h"

namespace focalstage {
namespace {

/// As in png_decode.cpp: libpng's longjmp passes over nothing that needs destroying.
class PngWriter {
 public:
  PngWriter() {
    png_ = png_create_write_struct(PNG_LIBPNG_VER_STRING, this, fail, ignore);
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
  }
  ~PngWriter() { png_destroy_write_struct(&png_, &info_); }
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;

  /// `rows`: big-endian where `bits` is 16; then the numbers are linear light.
  bool write(std::uint32_t width_px, std::uint32_t height_px, int channels, int bits, png_const_bytep rows) {
    if (png_ == nullptr || info_ == nullptr) return false;
    if (setjmp(png_jmpbuf(png_))) return false;
    png_set_write_fn(png_, this, give, nullptr);
    png_set_IHDR(png_, info_, width_px, height_px, bits, channels == 1 ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (bits == 16) png_set_gAMA(png_, info_, 1.0);
    png_set_compression_level(png_, 1);
    png_set_filter(png_, 0, PNG_FILTER_SUB);  // one filter at level 1: a third of the time of trying all
    png_write_info(png_, info_);
    const std::size_t stride = std::size_t{width_px} * static_cast<unsigned>(channels * bits / 8);
    for (std::uint32_t y = 0; y < height_px; ++y) png_write_row(png_, rows + y * stride);
    png_write_end(png_, info_);
    return true;
  }

  std::string why() const { return message_; }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  [[noreturn]] static void fail(png_structp png, png_const_charp message) {
    auto* self = static_cast<PngWriter*>(png_get_error_ptr(png));
    std::snprintf(self->message_, sizeof self->message_, "%s", message);
    png_longjmp(png, 1);
  }
  static void ignore(png_structp, png_const_charp) {}
  static void give(png_structp png, png_bytep from, std::size_t count) {
    auto* self = static_cast<PngWriter*>(png_get_io_ptr(png));
    const auto* bytes = reinterpret_cast<const std::byte*>(from);
    if (!self->append(bytes, count)) png_error(png, "out of memory");
  }

  bool append(const std::byte* bytes, std::size_t count) noexcept {
    try {
      bytes_.insert(bytes_.end(), bytes, bytes + count);
      return true;
    } catch (const std::bad_alloc&) {
      return false;
    }
  }

  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  std::vector<std::byte> bytes_;
  char message_[160] = "out of memory";
};

/// Whether `count` numbers are `channels` times width times height.
bool fit(int width_px, int height_px, int channels, std::size_t count) {
  if (width_px <= 0 || height_px <= 0 || (channels != 1 && channels != 3)) return false;
  const std::size_t per_row = static_cast<std::size_t>(width_px) * static_cast<unsigned>(channels);
  return count % per_row == 0 && count / per_row == static_cast<unsigned>(height_px);
}

Result<std::vector<std::byte>> encode(int width_px, int height_px, int channels, int bits, png_const_bytep rows) {
  PngWriter writer;
  if (!writer.write(static_cast<std::uint32_t>(width_px), static_cast<std::uint32_t>(height_px), channels, bits,
                    rows)) {
    return Fault{"image.invalid", "", "the picture cannot be written: " + writer.why(), ""};
  }
  return writer.take();
}

Status save(const std::filesystem::path& path, const Result<std::vector<std::byte>>& bytes) {
  if (bytes) return write_file_atomically(path, *bytes);
  Fault fault = bytes.fault();
  fault.where = path.string();
  return fault;
}

const Fault unfit{"image.invalid", "", "width, height, channels and codes do not fit together", ""};

}  // namespace

Result<std::vector<std::byte>> encode_png(int width_px, int height_px, int channels,
                                          std::span<const std::uint8_t> codes) {
  if (!fit(width_px, height_px, channels, codes.size())) return unfit;
  return encode(width_px, height_px, channels, 8, codes.data());
}

Status write_png(const std::filesystem::path& path, int width_px, int height_px, int channels,
                 std::span<const std::uint8_t> codes) {
  return save(path, encode_png(width_px, height_px, channels, codes));
}

Status write_png16(const std::filesystem::path& path, int width_px, int height_px, int channels,
                   std::span<const std::uint16_t> light) {
  if (!fit(width_px, height_px, channels, light.size())) return save(path, unfit);
  std::vector<png_byte> rows;
  rows.reserve(2 * light.size());
  for (const std::uint16_t level : light) {
    rows.push_back(static_cast<png_byte>(level >> 8));
    rows.push_back(static_cast<png_byte>(level & 255));
  }
  return save(path, encode(width_px, height_px, channels, 16, rows.data()));
}

}  // namespace focalstage
