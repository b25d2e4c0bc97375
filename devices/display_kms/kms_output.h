#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "devices/display/display.h"
#include "devices/display_kms/drm_calls.h"
#include "devices/display_kms/edid.h"

namespace focalstage {

/// Which display, and how. What is empty fits every one; where several fit, none is taken.
struct KmsSettings {
  std::string maker;   ///< as EDID says it, three letters
  std::string name;    ///< as EDID says it
  std::string serial;  ///< as EDID says it
  int width_px = 912;
  int height_px = 1140;
  double rate_hz = 60.0;
  double rate_tolerance = 0.002;  ///< of the rate: 59.94 is not 60 where this is less than 0.001
  std::size_t most_waiting = 2;
};

/// A connector with something on it.
struct KmsConnector {
  std::string card;
  std::uint32_t id = 0;
  EdidIdentity identity;
  std::vector<drmModeModeInfo> modes;
};

/// All connectors of all cards with something on them. Looks only; needs no master.
std::vector<KmsConnector> list_connectors(DrmCalls& drm);

/// "display.absent", "display.which" or "display.mode": what there is stands in the message.
Result<KmsConnector> choose_connector(const std::vector<KmsConnector>& all, const KmsSettings& settings);
Result<drmModeModeInfo> choose_mode(const KmsConnector& connector, const KmsSettings& settings);

double interval_s(const drmModeModeInfo& mode);

/// One connector lit by one crtc, with three buffers to flip between. For one thread at a time. The output is as it was
/// before when this ends, and off when the program is killed: the kernel takes its buffers away.
class KmsOutput {
 public:
  /// Black is shown when this returns. Faults as above, and "display.permission", "display.busy", "display.refused".
  static Result<std::unique_ptr<KmsOutput>> open(DrmCalls& drm, const KmsSettings& settings);
  KmsOutput(const KmsOutput&) = delete;
  KmsOutput& operator=(const KmsOutput&) = delete;
  ~KmsOutput();

  VideoMode mode() const;

  /// Copies a frame (null: black) into a buffer that is not shown, to be shown from the next vblank on. 0 or -errno.
  int flip(const std::vector<std::uint32_t>* pixels);
  std::optional<DrmFlip> wait(int timeout_ms) { return drm_.wait_flip(card_, timeout_ms); }

  /// No signal: what was shown last does not stay.
  void off();

  /// As the kernel knows it now, without asking the display.
  bool connected();

 private:
  struct Buffer {
    DrmBuffer memory;
    std::uint8_t* bytes = nullptr;
    std::uint32_t framebuffer = 0;
    bool black = false;
  };

  explicit KmsOutput(DrmCalls& drm) : drm_(drm) {}
  Status take(const KmsConnector& connector, const drmModeModeInfo& mode);
  Status find_crtc(const drmModeConnector& connector);
  Status make_buffers();
  /// Bits must arrive as they are: full range, no dithering, a straight gamma ramp, where these can be set.
  void make_exact(const drmModeConnector& connector);
  void fill(Buffer& buffer, const std::vector<std::uint32_t>* pixels) const;

  DrmCalls& drm_;
  int card_ = -1;
  bool master_ = false;
  std::uint32_t connector_ = 0;
  std::uint32_t crtc_ = 0;
  drmModeModeInfo mode_{};
  drmModeCrtc* before_ = nullptr;
  std::array<Buffer, 3> buffers_;
  std::size_t next_ = 1;  ///< buffer 0 is shown first
};

}  // namespace focalstage
