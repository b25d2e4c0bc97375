#include <csetjmp>
#include <cstdio>

// jpeglib.h needs FILE before it.
#include <jerror.h>
#include <jpeglib.h>

#include "io/image/decoders.h"

namespace focalstage {
namespace {

/// libjpeg leaves a failed call by longjmp, like libpng (png_decode.cpp); all state lives here.
class JpegReader {
 public:
  explicit JpegReader(std::span<const std::byte> bytes) : bytes_(bytes) {
    jpeg_.err = jpeg_std_error(&errors_);
    errors_.error_exit = fail;
    errors_.emit_message = judge;
    jpeg_.client_data = this;
    progress_.progress_monitor = watch;
  }
  ~JpegReader() { jpeg_destroy_decompress(&jpeg_); }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;

  bool read_header() {
    if (setjmp(escape_)) return false;
    jpeg_create_decompress(&jpeg_);
    jpeg_.progress = &progress_;
    jpeg_mem_src(&jpeg_, reinterpret_cast<const unsigned char*>(bytes_.data()), bytes_.size());
    jpeg_read_header(&jpeg_, TRUE);
    width_px = jpeg_.image_width;
    height_px = jpeg_.image_height;
    has_rgb = jpeg_.jpeg_color_space == JCS_GRAYSCALE || jpeg_.jpeg_color_space == JCS_RGB ||
              jpeg_.jpeg_color_space == JCS_YCbCr;
    return true;
  }

  bool read_pixels(std::uint8_t* rgba) {
    if (setjmp(escape_)) return false;
    jpeg_.out_color_space = JCS_EXT_RGBA;
    jpeg_.dct_method = JDCT_ISLOW;  // the one that is the same on every processor
    jpeg_start_decompress(&jpeg_);
    while (jpeg_.output_scanline < jpeg_.output_height) {
      JSAMPROW row = rgba + std::size_t{jpeg_.output_scanline} * width_px * 4;
      jpeg_read_scanlines(&jpeg_, &row, 1);
    }
    jpeg_finish_decompress(&jpeg_);
    return true;
  }

  std::string why() const { return message_; }

  std::uint32_t width_px = 0;
  std::uint32_t height_px = 0;
  bool has_rgb = false;

 private:
  static JpegReader* self(j_common_ptr jpeg) { return static_cast<JpegReader*>(jpeg->client_data); }

  [[noreturn]] static void fail(j_common_ptr jpeg) {
    jpeg->err->format_message(jpeg, self(jpeg)->message_);
    std::longjmp(self(jpeg)->escape_, 1);
  }

  /// Level -1 is a warning of damaged data, where libjpeg would guess; we refuse. Stray bytes between segments and odd
  /// header versions damage nothing.
  static void judge(j_common_ptr jpeg, int level) {
    const int code = jpeg->err->msg_code;
    const bool harmless = code == JWRN_EXTRANEOUS_DATA || code == JWRN_JFIF_MAJOR || code == JWRN_ADOBE_XFORM;
    if (level < 0 && !harmless) fail(jpeg);
  }

  /// A small progressive file can hold thousands of scans over a large picture; real ones have about ten.
  static void watch(j_common_ptr jpeg) {
    constexpr int most_scans = 64;
    if (reinterpret_cast<j_decompress_ptr>(jpeg)->input_scan_number > most_scans) {
      std::snprintf(self(jpeg)->message_, sizeof self(jpeg)->message_, "more than %d scans", most_scans);
      std::longjmp(self(jpeg)->escape_, 1);
    }
  }

  std::span<const std::byte> bytes_;
  jpeg_decompress_struct jpeg_{};
  jpeg_error_mgr errors_{};
  jpeg_progress_mgr progress_{};
  std::jmp_buf escape_{};
  char message_[JMSG_LENGTH_MAX] = "";
};

}  // namespace

Result<PictureHead> jpeg_head(std::span<const std::byte> bytes, const std::string& source) {
  JpegReader reader(bytes);
  if (!reader.read_header()) return image_fault(source, "bad JPEG: " + reader.why());
  if (!reader.has_rgb) {
    return Fault{"image.unsupported", source, "this JPEG is neither gray nor RGB", "export the picture in RGB"};
  }
  return sized(reader.width_px, reader.height_px, source);
}

Result<Texture> decode_jpeg(std::span<const std::byte> bytes, const std::string& source) {
  JpegReader reader(bytes);
  if (!reader.read_header()) return image_fault(source, "bad JPEG: " + reader.why());
  if (!reader.has_rgb) {
    return Fault{"image.unsupported", source, "this JPEG is neither gray nor RGB", "export the picture in RGB"};
  }
  Result<Texture> texture = blank_texture(reader.width_px, reader.height_px, source);
  if (!texture) return texture;
  if (!reader.read_pixels(texture->rgba.data())) return image_fault(source, "bad JPEG: " + reader.why());
  return texture;
}

}  // namespace focalstage
