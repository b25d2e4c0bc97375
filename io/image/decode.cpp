#include <algorithm>
#include <array>
#include <new>

#include "io/image/decoders.h"
#include "io/image/png.h"

namespace focalstage {
namespace {

constexpr std::uint64_t longest_side_px = 16384;
constexpr std::uint64_t most_pixels = std::uint64_t{1} << 26;

template <std::size_t N>
bool starts_with(std::span<const std::byte> bytes, const std::array<unsigned, N>& signature) {
  return bytes.size() >= N && std::equal(signature.begin(), signature.end(), bytes.begin(),
                                         [](unsigned a, std::byte b) { return a == std::to_integer<unsigned>(b); });
}

constexpr std::array<unsigned, 8> png_signature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
constexpr std::array<unsigned, 3> jpeg_signature{0xFF, 0xD8, 0xFF};

std::string size_words(std::uint64_t width_px, std::uint64_t height_px) {
  return std::to_string(width_px) + " x " + std::to_string(height_px) + " pixels";
}

Fault unknown_format(const std::string& source) {
  return {"image.unsupported", source, "this is neither a PNG nor a JPEG", "export the picture as one of them"};
}

}  // namespace

Fault image_fault(const std::string& source, const std::string& what) {
  return {"image.invalid", source, what, "export the picture again as PNG or JPEG"};
}

Result<PictureHead> sized(std::uint64_t width_px, std::uint64_t height_px, const std::string& source) {
  if (width_px == 0 || height_px == 0) return image_fault(source, "the picture has no pixels");
  if (std::max(width_px, height_px) > longest_side_px || width_px * height_px > most_pixels) {
    return Fault{"image.too-large", source, "the picture has " + size_words(width_px, height_px),
                 "scale it to at most 16384 pixels a side and 67 million in all"};
  }
  return PictureHead{static_cast<int>(width_px), static_cast<int>(height_px)};
}

Result<Texture> blank_texture(std::uint64_t width_px, std::uint64_t height_px, const std::string& source, bool deep) {
  const Result<PictureHead> head = sized(width_px, height_px, source);
  if (!head) return head.fault();
  try {
    Texture texture;
    texture.width_px = head->width_px;
    texture.height_px = head->height_px;
    if (deep) texture.rgba16.resize(width_px * height_px * 4);
    if (!deep) texture.rgba.resize(width_px * height_px * 4);
    return texture;
  } catch (const std::bad_alloc&) {
    return Fault{"image.too-large", source, "no memory for " + size_words(width_px, height_px),
                 "scale the picture down"};
  }
}

Result<Texture> decode_image(std::span<const std::byte> bytes, const std::string& source, PixelBits bits) {
  if (starts_with(bytes, png_signature)) return decode_png(bytes, source, bits);
  if (starts_with(bytes, jpeg_signature)) return decode_jpeg(bytes, source);
  return unknown_format(source);
}

Result<PictureHead> picture_head(std::span<const std::byte> bytes, const std::string& source) {
  if (starts_with(bytes, png_signature)) return png_head(bytes, source);
  if (starts_with(bytes, jpeg_signature)) return jpeg_head(bytes, source);
  return unknown_format(source);
}

}  // namespace focalstage
