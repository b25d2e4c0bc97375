#include <doctest/doctest.h>
#include <png.h>

#include <chrono>
#include <csetjmp>
#include <cstdio>
// jpeglib.h needs FILE before it.
#include <jpeglib.h>

#include <array>
#include <filesystem>
#include <initializer_list>
#include <random>

#include "io/files/files.h"
#include "io/image/png.h"

using namespace focalstage;

namespace {

using Bytes = std::vector<std::byte>;

void append(png_structp png, png_bytep from, std::size_t count) {
  auto* out = static_cast<Bytes*>(png_get_io_ptr(png));
  const auto* bytes = reinterpret_cast<const std::byte*>(from);
  out->insert(out->end(), bytes, bytes + count);
}

struct PngKind {
  int depth = 8;
  int color = PNG_COLOR_TYPE_RGB;
  int interlace = PNG_INTERLACE_NONE;
};

/// A PNG of any kind from its packed rows; a palette has red, green and half-transparent blue.
Bytes png_of(std::uint32_t width, const std::vector<std::vector<std::uint8_t>>& rows, const PngKind& kind) {
  Bytes out;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(png, &out, append, nullptr);
  png_set_IHDR(png, info, width, static_cast<std::uint32_t>(rows.size()), kind.depth, kind.color, kind.interlace,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (kind.color == PNG_COLOR_TYPE_PALETTE) {
    const png_color palette[] = {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}};
    const png_byte alpha[] = {255, 255, 128};
    png_set_PLTE(png, info, palette, 3);
    png_set_tRNS(png, info, alpha, 3, nullptr);
  }
  png_set_gAMA(png, info, 1.0);  // which must change nothing
  png_write_info(png, info);
  std::vector<png_bytep> pointers;
  for (const auto& row : rows) pointers.push_back(const_cast<png_bytep>(row.data()));
  png_write_image(png, pointers.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return out;
}

Bytes jpeg_of(int width, int height, const std::vector<std::uint8_t>& codes, J_COLOR_SPACE space, bool progressive) {
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* memory = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &memory, &size);
  jpeg.image_width = static_cast<unsigned>(width);
  jpeg.image_height = static_cast<unsigned>(height);
  jpeg.input_components = space == JCS_GRAYSCALE ? 1 : space == JCS_RGB ? 3 : 4;
  jpeg.in_color_space = space;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, 95, TRUE);
  if (progressive) jpeg_simple_progression(&jpeg);
  jpeg_start_compress(&jpeg, TRUE);
  while (jpeg.next_scanline < jpeg.image_height) {
    auto* row = const_cast<JSAMPROW>(codes.data() + jpeg.next_scanline * jpeg.image_width *
                                                        static_cast<unsigned>(jpeg.input_components));
    jpeg_write_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_compress(&jpeg);
  const auto* bytes = reinterpret_cast<const std::byte*>(memory);
  Bytes out(bytes, bytes + size);
  jpeg_destroy_compress(&jpeg);
  std::free(memory);
  return out;
}

std::array<int, 4> pixel(const Texture& texture, int x, int y) {
  const std::size_t at = static_cast<std::size_t>(y * texture.width_px + x) * 4;
  return {texture.rgba[at], texture.rgba[at + 1], texture.rgba[at + 2], texture.rgba[at + 3]};
}

using Rgba = std::array<int, 4>;

Texture decoded(const Bytes& bytes) {
  Result<Texture> texture = decode_image(bytes, "test");
  if (!texture) FAIL(describe(texture.fault()));
  return *texture;
}

std::vector<std::uint8_t> noise(std::size_t count) {
  std::mt19937 random(7);
  std::vector<std::uint8_t> codes(count);
  for (std::uint8_t& code : codes) code = static_cast<std::uint8_t>(random());
  return codes;
}

}  // namespace

TEST_CASE("what is encoded is decoded to the same codes") {
  const std::vector<std::uint8_t> gray = noise(37 * 11);
  const Texture gray_texture = decoded(*encode_png(37, 11, 1, gray));
  CHECK(gray_texture.width_px == 37);
  CHECK(gray_texture.height_px == 11);
  for (std::size_t i = 0; i < gray.size(); ++i) {
    const Rgba is = pixel(gray_texture, static_cast<int>(i % 37), static_cast<int>(i / 37));
    CHECK(is == Rgba{gray[i], gray[i], gray[i], 255});
  }
  const std::vector<std::uint8_t> rgb = noise(5 * 3 * 3);
  const Texture rgb_texture = decoded(*encode_png(5, 3, 3, rgb));
  for (std::size_t i = 0; i < 15; ++i) {
    const Rgba is = pixel(rgb_texture, static_cast<int>(i % 5), static_cast<int>(i / 5));
    CHECK(is == Rgba{rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2], 255});
  }
  CHECK(*encode_png(5, 3, 3, rgb) == *encode_png(5, 3, 3, rgb));
}

TEST_CASE("codes that do not fill the picture are refused") {
  const std::vector<std::uint8_t> codes(12);
  for (const auto& [width, height, channels] : std::initializer_list<std::array<int, 3>>{
           {4, 3, 3}, {4, 4, 1}, {4, 2, 1}, {5, 2, 1}, {0, 3, 1}, {-4, -3, 1}, {2, 3, 2}, {3, 0, 1}}) {
    const auto bytes = encode_png(width, height, channels, codes);
    REQUIRE_FALSE(bytes.ok());
    CHECK(bytes.fault().code == "image.invalid");
  }
  CHECK(encode_png(4, 3, 1, codes).ok());
  CHECK(encode_png(2, 2, 3, codes).ok());
}

TEST_CASE("a picture is written to a file, or the fault names it") {
  const auto path = std::filesystem::path(FOCALSTAGE_BINARY_DIR) / "image_test.png";
  const std::vector<std::uint8_t> codes{0, 50, 100, 150, 200, 250};
  REQUIRE(write_png(path, 3, 2, 1, codes).ok());
  CHECK(pixel(decoded(*read_file(path, 10000)), 2, 1) == Rgba{250, 250, 250, 255});
  std::filesystem::remove(path);
  CHECK_FALSE(write_png("/nonexistent/folder/a.png", 3, 2, 1, codes).ok());
  const Status shapeless = write_png(path, 3, 3, 1, codes);
  REQUIRE_FALSE(shapeless.ok());
  CHECK(shapeless.fault().where == path.string());
  CHECK_FALSE(std::filesystem::exists(path));
}

TEST_CASE("light is written in 16 bits that say they are linear") {
  const auto path = std::filesystem::path(FOCALSTAGE_BINARY_DIR) / "light_test.png";
  for (const int channels : {1, 3}) {
    std::vector<std::uint16_t> light;
    for (int i = 0; i < 4 * channels; ++i) light.push_back(static_cast<std::uint16_t>(257 * (i * 17)));
    REQUIRE(write_png16(path, 2, 2, channels, light).ok());
    const Bytes bytes = *read_file(path, 10000);
    CHECK(static_cast<int>(bytes[24]) == 16);  // the header's depth
    const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::size_t gamma = text.find("gAMA");
    REQUIRE(gamma != std::string::npos);
    CHECK(text.substr(gamma + 4, 4) == std::string("\x00\x01\x86\xA0", 4));  // 100000: one
    const Texture read = decoded(bytes);
    const int last = 17 * (4 * channels - 1);
    CHECK(pixel(read, 1, 1) == (channels == 1 ? Rgba{last, last, last, 255} : Rgba{last - 34, last - 17, last, 255}));
    light.pop_back();
    CHECK(write_png16(path, 2, 2, channels, light).fault().code == "image.invalid");
  }
  std::filesystem::remove(path);
}

TEST_CASE("every kind of PNG comes as 8-bit RGBA, its gamma untouched") {
  for (const int interlace : {PNG_INTERLACE_NONE, PNG_INTERLACE_ADAM7}) {
    const Texture palette = decoded(png_of(3, {{0, 1, 2}, {2, 2, 0}}, {8, PNG_COLOR_TYPE_PALETTE, interlace}));
    CHECK(pixel(palette, 0, 0) == Rgba{255, 0, 0, 255});
    CHECK(pixel(palette, 1, 0) == Rgba{0, 255, 0, 255});
    CHECK(pixel(palette, 1, 1) == Rgba{0, 0, 255, 128});
    // 1-bit gray 10100000: white, black, white.
    const Texture bits = decoded(png_of(3, {{0xA0}}, {1, PNG_COLOR_TYPE_GRAY, interlace}));
    CHECK(pixel(bits, 0, 0) == Rgba{255, 255, 255, 255});
    CHECK(pixel(bits, 1, 0) == Rgba{0, 0, 0, 255});
    const Texture gray_alpha = decoded(png_of(1, {{77, 33}}, {8, PNG_COLOR_TYPE_GRAY_ALPHA, interlace}));
    CHECK(pixel(gray_alpha, 0, 0) == Rgba{77, 77, 77, 33});
    // 16 bits are scaled, not cut: 0x80FF / 257 = 128.49, 0xFF7E / 257 = 254.498, 0x0081 / 257 = 0.502.
    const Texture deep =
        decoded(png_of(1, {{0x80, 0xFF, 0xFF, 0x7E, 0x00, 0x81}}, {16, PNG_COLOR_TYPE_RGB, interlace}));
    CHECK(pixel(deep, 0, 0) == Rgba{128, 254, 1, 255});
    const Texture rgba = decoded(png_of(1, {{1, 2, 3, 4}}, {8, PNG_COLOR_TYPE_RGBA, interlace}));
    CHECK(pixel(rgba, 0, 0) == Rgba{1, 2, 3, 4});
  }
}

TEST_CASE("JPEG comes as RGBA, baseline and progressive; CMYK is refused") {
  for (const bool progressive : {false, true}) {
    std::vector<std::uint8_t> rgb;
    for (int i = 0; i < 64 * 32; ++i) rgb.insert(rgb.end(), {200, 100, 50});
    const Texture texture = decoded(jpeg_of(64, 32, rgb, JCS_RGB, progressive));
    CHECK(texture.width_px == 64);
    CHECK(texture.height_px == 32);
    const Rgba is = pixel(texture, 40, 20);
    CHECK(std::abs(is[0] - 200) <= 2);
    CHECK(std::abs(is[1] - 100) <= 2);
    CHECK(std::abs(is[2] - 50) <= 2);
    CHECK(is[3] == 255);
    const Texture gray = decoded(jpeg_of(8, 8, std::vector<std::uint8_t>(64, 90), JCS_GRAYSCALE, progressive));
    CHECK(pixel(gray, 3, 3) == Rgba{90, 90, 90, 255});
  }
  const auto cmyk = decode_image(jpeg_of(8, 8, std::vector<std::uint8_t>(256, 90), JCS_CMYK, false), "ink.jpg");
  REQUIRE_FALSE(cmyk.ok());
  CHECK(cmyk.fault().code == "image.unsupported");
  CHECK(cmyk.fault().where == "ink.jpg");
}

TEST_CASE("a picture cut anywhere is refused") {
  const std::vector<std::uint8_t> rgb = noise(20 * 10 * 3);
  for (const Bytes& whole :
       {*encode_png(20, 10, 3, rgb), jpeg_of(20, 10, rgb, JCS_RGB, false), jpeg_of(20, 10, rgb, JCS_RGB, true)}) {
    for (std::size_t size = 0; size < whole.size(); ++size) {
      const auto texture = decode_image(std::span(whole).first(size), "cut");
      REQUIRE_FALSE(texture.ok());
      CHECK(texture.fault().where == "cut");
    }
  }
}

TEST_CASE("flipped bits give a picture of the same size or a fault, never more") {
  const std::vector<std::uint8_t> rgb = noise(20 * 10 * 3);
  std::mt19937 random(11);
  for (const Bytes& whole :
       {*encode_png(20, 10, 3, rgb), jpeg_of(20, 10, rgb, JCS_RGB, false), jpeg_of(20, 10, rgb, JCS_RGB, true)}) {
    for (int round = 0; round < 1500; ++round) {
      Bytes damaged = whole;
      for (int flips = 0; flips <= round % 3; ++flips) {
        damaged[random() % damaged.size()] ^= static_cast<std::byte>(1u << random() % 8);
      }
      const auto texture = decode_image(damaged, "flipped");
      if (texture) CHECK(texture->rgba.size() == static_cast<std::size_t>(texture->width_px * texture->height_px * 4));
    }
  }
}

TEST_CASE("a short file that promises a huge picture is refused before anything of its size is allocated") {
  const auto put = [](Bytes& bytes, std::size_t at, std::uint32_t value) {
    for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<std::byte>(value >> (24 - 8 * i));
  };
  // Width and height stand at bytes 16 and 20 of a PNG, the header's checksum over bytes 12..28 at 29.
  const auto crc = [](const Bytes& bytes) {
    std::uint32_t sum = 0xFFFFFFFFu;
    for (std::size_t i = 12; i < 29; ++i) {
      sum ^= std::to_integer<std::uint32_t>(bytes[i]);
      for (int bit = 0; bit < 8; ++bit) sum = sum >> 1 ^ (sum & 1 ? 0xEDB88320u : 0u);
    }
    return ~sum;
  };
  const std::vector<std::uint8_t> one{1, 2, 3};
  for (const std::uint32_t side : {16384u, 60000u, 0x7FFFFFFFu}) {
    Bytes png = *encode_png(1, 1, 3, one);
    put(png, 16, side);
    put(png, 20, side);
    put(png, 29, crc(png));
    const auto start = std::chrono::steady_clock::now();
    CHECK_FALSE(decode_image(png, "bomb.png").ok());
    CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(1));
  }
  // A JPEG's frame header: FF C0, length 17, depth, height, width.
  Bytes jpeg = jpeg_of(1, 1, one, JCS_RGB, false);
  for (std::size_t i = 0; i + 9 < jpeg.size(); ++i) {
    if (jpeg[i] != std::byte{0xFF} || jpeg[i + 1] != std::byte{0xC0}) continue;
    for (std::size_t k = 5; k < 9; ++k) jpeg[i + k] = std::byte{0xEA};
  }
  const auto bomb = decode_image(jpeg, "bomb.jpg");
  REQUIRE_FALSE(bomb.ok());
  CHECK(bomb.fault().code == "image.too-large");
}

TEST_CASE("what is no picture is named as such") {
  for (const std::string text : {"", "P6 1 1 255", "GIF89a", "\x89PNG", "\xFF\xD8"}) {
    const auto texture = decode_image(std::as_bytes(std::span(text)), "odd.bin");
    REQUIRE_FALSE(texture.ok());
    CHECK(texture.fault().code == "image.unsupported");
    CHECK(texture.fault().where == "odd.bin");
  }
}

TEST_CASE("16 bits of pictures that others wrote stay 16 bits") {
  const auto fixture = [](const char* name) {
    return *read_file(std::filesystem::path(FOCALSTAGE_SOURCE_DIR) / "tests/io/image/fixture" / name, 10000);
  };
  const Bytes ramp = fixture("ramp16.png");  // by Pillow: 64 x + y
  const Result<Texture> gray = decode_image(ramp, "ramp16.png", PixelBits::as_stored);
  REQUIRE(gray.ok());
  CHECK(gray->rgba.empty());
  REQUIRE(gray->rgba16.size() == 1024 * 2 * 4);
  int wrong = 0;
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 1024; ++x) {
      const std::uint16_t* is = &gray->rgba16[static_cast<std::size_t>(4 * (1024 * y + x))];
      const int was = 64 * x + y;
      wrong += is[0] != was || is[1] != was || is[2] != was || is[3] != 65535 ? 1 : 0;
    }
  }
  CHECK(wrong == 0);
  const Result<Texture> corners = decode_image(fixture("corners16.png"), "corners16.png", PixelBits::as_stored);
  REQUIRE(corners.ok());
  CHECK(corners->rgba16 == std::vector<std::uint16_t>{0x0001, 0x0100, 0xFFFF, 0x8000, 0x1234, 0x5678, 0x9ABC, 0xFFFF,
                                                      0xFFFE, 0x00FF, 0x7FFF, 0x0001, 0, 0, 0, 0});
  CHECK_FALSE(decode_image(ramp, "ramp16.png")->is_deep());
  CHECK_FALSE(decode_image(*encode_png(1, 1, 1, std::vector<std::uint8_t>{7}), "8", PixelBits::as_stored)->is_deep());
}

TEST_CASE("the head of a picture says its size, and lies are found without its pixels") {
  const std::vector<std::uint8_t> rgb = noise(20 * 10 * 3);
  const Bytes png = *encode_png(20, 10, 3, rgb);
  for (const Bytes& whole : {png, jpeg_of(20, 10, rgb, JCS_RGB, false)}) {
    const Result<PictureHead> head = picture_head(whole, "whole");
    REQUIRE(head.ok());
    CHECK(head->width_px == 20);
    CHECK(head->height_px == 10);
  }
  for (std::size_t size = 0; size < png.size(); ++size) {
    const Result<PictureHead> head = picture_head(std::span(png).first(size), "cut");
    REQUIRE_FALSE(head.ok());
    CHECK(head.fault().where == "cut");
  }
}
