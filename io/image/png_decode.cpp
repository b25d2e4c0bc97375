#include <png.h>

#include <bit>
#include <cstdio>
#include <cstring>
#include <optional>
#include <vector>

#include "io/image/decoders.h"

namespace focalstage {
namespace {

/// libpng leaves a failed call by longjmp. Every such call stands in a member function that holds nothing to be
/// destroyed; all state lives here.
class PngReader {
 public:
  explicit PngReader(std::span<const std::byte> bytes) : bytes_(bytes) {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, fail, ignore);
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  bool read_header() {
    if (png_ == nullptr || info_ == nullptr) return false;
    if (setjmp(png_jmpbuf(png_))) return false;
    png_set_user_limits(png_, 0x7FFFFFFF, 0x7FFFFFFF);  // ours are checked by blank_texture, with a better message
    png_set_chunk_cache_max(png_, 64);
    png_set_chunk_malloc_max(png_, 1 << 20);
    png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, nullptr, 0);
    png_set_read_fn(png_, this, take);
    png_read_info(png_, info_);
    width_px = png_get_image_width(png_, info_);
    height_px = png_get_image_height(png_, info_);
    raw_bytes = (std::uint64_t{png_get_rowbytes(png_, info_)} + 1) * height_px;
    is_deep = png_get_bit_depth(png_, info_) == 16;
    return true;
  }

  /// Rows of width x 4 numbers, of 16 bits in this machine's order if `deep`, else of 8.
  bool read_pixels(png_bytepp rows, bool deep) {
    if (setjmp(png_jmpbuf(png_))) return false;
    png_set_expand(png_);
    if (!deep) png_set_scale_16(png_);
    if (deep && std::endian::native == std::endian::little) png_set_swap(png_);
    png_set_gray_to_rgb(png_);
    png_set_add_alpha(png_, deep ? 0xFFFF : 0xFF, PNG_FILLER_AFTER);
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    const std::size_t row_bytes = std::size_t{width_px} * (deep ? 8 : 4);
    if (png_get_rowbytes(png_, info_) != row_bytes) png_error(png_, "its rows have no RGBA form");
    png_read_image(png_, rows);
    png_read_end(png_, nullptr);
    return true;
  }

  std::string why() const { return message_; }

  std::uint32_t width_px = 0;
  std::uint32_t height_px = 0;
  std::uint64_t raw_bytes = 0;  ///< of all rows, unpacked
  bool is_deep = false;         ///< 16 bits a number

 private:
  [[noreturn]] static void fail(png_structp png, png_const_charp message) {
    auto* self = static_cast<PngReader*>(png_get_error_ptr(png));
    std::snprintf(self->message_, sizeof self->message_, "%s", message);
    png_longjmp(png, 1);
  }

  static void ignore(png_structp, png_const_charp) {}

  static void take(png_structp png, png_bytep to, std::size_t count) {
    auto* self = static_cast<PngReader*>(png_get_io_ptr(png));
    if (count > self->bytes_.size()) png_error(png, "the file ends too early");
    std::memcpy(to, self->bytes_.data(), count);
    self->bytes_ = self->bytes_.subspan(count);
  }

  std::span<const std::byte> bytes_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  char message_[160] = "out of memory";
};

/// Of all pieces with the packed picture.
std::uint64_t packed_bytes(std::span<const std::byte> bytes) {
  constexpr std::size_t signature = 8, around = 12;  // length, name and checksum
  std::uint64_t sum = 0;
  for (std::size_t at = signature; at + around <= bytes.size();) {
    std::uint32_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8 | std::to_integer<std::uint32_t>(bytes[at + i]);
    if (std::memcmp(bytes.data() + at + 4, "IDAT", 4) == 0) sum += length;
    at += around + std::size_t{length};
  }
  return sum;
}

/// Why the file cannot hold what its header says, or none.
std::optional<Fault> wrong_head(PngReader& reader, std::span<const std::byte> bytes, const std::string& source) {
  // Deflate packs at most 1032 to 1: a short file that promises more is cut off, whatever its header says.
  constexpr std::uint64_t most_packing = 1032;
  if (!reader.read_header()) return image_fault(source, "bad PNG: " + reader.why());
  if (reader.raw_bytes / most_packing > bytes.size()) {
    return image_fault(source, "bad PNG: the file is too short for the size it gives");
  }
  // libpng unpacks all there is, also behind the last row. What cannot be packed takes little more than itself.
  constexpr std::uint64_t spare_bytes = 65536;
  if (packed_bytes(bytes) > 2 * reader.raw_bytes + spare_bytes) {
    return image_fault(source, "bad PNG: the file holds far more data than the size it gives");
  }
  return std::nullopt;
}

/// Whether its pieces follow each other to the one that ends it.
bool is_whole(std::span<const std::byte> bytes) {
  constexpr std::size_t signature = 8, around = 12;  // length, name and checksum
  for (std::size_t at = signature; at + around <= bytes.size();) {
    std::uint64_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8 | std::to_integer<std::uint64_t>(bytes[at + i]);
    if (length + around > bytes.size() - at) return false;
    if (std::memcmp(bytes.data() + at + 4, "IEND", 4) == 0) return true;
    at += length + around;
  }
  return false;
}

}  // namespace

Result<PictureHead> png_head(std::span<const std::byte> bytes, const std::string& source) {
  PngReader reader(bytes);
  if (const auto fault = wrong_head(reader, bytes, source)) return *fault;
  if (!is_whole(bytes)) return image_fault(source, "bad PNG: the file ends too early");
  return sized(reader.width_px, reader.height_px, source);
}

Result<Texture> decode_png(std::span<const std::byte> bytes, const std::string& source, PixelBits bits) {
  PngReader reader(bytes);
  if (const auto fault = wrong_head(reader, bytes, source)) return *fault;
  const bool deep = reader.is_deep && bits == PixelBits::as_stored;
  Result<Texture> texture = blank_texture(reader.width_px, reader.height_px, source, deep);
  if (!texture) return texture;
  std::vector<png_bytep> rows(reader.height_px);
  for (std::size_t y = 0; y < rows.size(); ++y) {
    const std::size_t first = y * reader.width_px * 4;
    rows[y] = deep ? reinterpret_cast<png_bytep>(texture->rgba16.data() + first) : texture->rgba.data() + first;
  }
  if (!reader.read_pixels(rows.data(), deep)) return image_fault(source, "bad PNG: " + reader.why());
  return texture;
}

}  // namespace focalstage
