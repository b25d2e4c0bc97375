#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <xf86drmMode.h>

namespace focalstage {

struct DrmBuffer {
  std::uint32_t handle = 0;
  std::uint32_t pitch = 0;  ///< bytes per row
  std::uint64_t size = 0;   ///< bytes
};

struct DrmFlip {
  std::uint32_t sequence = 0;  ///< of the vblank
  double time_s = 0.0;         ///< monotonic clock
};

/// The calls of libdrm that are used, one for one where nothing else is said, so that a test can stand in for the
/// kernel. Numbers returned are 0 or -errno.
class DrmCalls {
 public:
  virtual ~DrmCalls() = default;

  virtual std::vector<std::string> cards() = 0;   ///< "/dev/dri/card0", ...
  virtual int open(const std::string& path) = 0;  ///< a descriptor, or -errno
  virtual void close(int card) = 0;
  virtual bool monotonic(int card) = 0;  ///< vblanks are told by the monotonic clock
  virtual int set_master(int card) = 0;
  virtual void drop_master(int card) = 0;

  virtual drmModeRes* resources(int card) = 0;
  virtual void free(drmModeRes* resources) = 0;
  virtual drmModeConnector* connector(int card, std::uint32_t id, bool probe) = 0;
  virtual void free(drmModeConnector* connector) = 0;
  virtual drmModeEncoder* encoder(int card, std::uint32_t id) = 0;
  virtual void free(drmModeEncoder* encoder) = 0;
  virtual drmModeCrtc* crtc(int card, std::uint32_t id) = 0;
  virtual void free(drmModeCrtc* crtc) = 0;
  /// The bytes of a connector's property that is a blob; empty where it has none.
  virtual std::vector<std::uint8_t> blob(int card, const drmModeConnector& connector, const std::string& property) = 0;
  /// Sets a connector's property by its name and, where it is an enumeration, by its value's name; -ENOENT where it has
  /// none such.
  virtual int set_property(int card, const drmModeConnector& connector, const std::string& property,
                           const std::string& value) = 0;

  virtual int create_buffer(int card, std::uint32_t width, std::uint32_t height, DrmBuffer& buffer) = 0;
  virtual void destroy_buffer(int card, std::uint32_t handle) = 0;
  /// Its bytes; null: it cannot be mapped.
  virtual std::uint8_t* map_buffer(int card, const DrmBuffer& buffer) = 0;
  virtual void unmap_buffer(std::uint8_t* bytes, std::uint64_t size) = 0;
  virtual int add_framebuffer(int card, std::uint32_t width, std::uint32_t height, const DrmBuffer& buffer,
                              std::uint32_t& framebuffer) = 0;
  virtual void remove_framebuffer(int card, std::uint32_t framebuffer) = 0;

  virtual int set_crtc(int card, std::uint32_t crtc, std::uint32_t framebuffer, std::uint32_t connector,
                       drmModeModeInfo* mode) = 0;
  virtual int set_gamma(int card, std::uint32_t crtc, std::span<std::uint16_t> ramp) = 0;
  virtual int page_flip(int card, std::uint32_t crtc, std::uint32_t framebuffer) = 0;
  /// The next flip that was done; nothing within `timeout_ms`.
  virtual std::optional<DrmFlip> wait_flip(int card, int timeout_ms) = 0;
};

/// The kernel's own.
DrmCalls& kernel_drm();

}  // namespace focalstage
