#include "devices/display_kms/kms_display.h"

#include <cerrno>
#include <cstring>
#include <mutex>
#include <thread>

#include "devices/display/queued_display.h"
#include "devices/roles/clock.h"

namespace focalstage {

namespace {

constexpr int most_wait_ms = 100;         ///< for a vblank, before the output counts as lost
constexpr double between_looks_s = 0.25;  ///< at the connector

class KmsDisplay final : public QueuedDisplay {
 public:
  KmsDisplay(KmsSettings settings, DrmCalls& drm)
      : QueuedDisplay(settings.most_waiting), settings_(std::move(settings)), drm_(drm) {}
  ~KmsDisplay() override { close(); }

  VideoMode mode() const override {
    const std::lock_guard lock(mode_mutex_);
    return mode_;
  }

 private:
  Result<std::jthread> take() override {
    Result<std::unique_ptr<KmsOutput>> output = KmsOutput::open(drm_, settings_);
    if (!output) return output.fault();
    output_ = std::move(*output);
    {
      const std::lock_guard mode_lock(mode_mutex_);
      mode_ = output_->mode();
    }
    queue_.open(static_cast<std::size_t>(settings_.width_px) * static_cast<std::size_t>(settings_.height_px));
    return std::jthread([this](const std::stop_token& stop) { run(stop); });
  }

  void give_back() override { output_.reset(); }

  void run(const std::stop_token& stop) {
    std::optional<std::uint32_t> before;
    double look_s = monotonic_s() + between_looks_s;
    while (true) {
      const bool last = stop.stop_requested();  // ends in black
      const VideoFrame frame = last ? nullptr : queue_.take();
      if (const int error = output_->flip(frame.get()); error != 0) return lose(std::strerror(-error));
      const auto flip = output_->wait(most_wait_ms);
      if (!flip) return lose("no vblank for 100 ms");
      // The first flip has none before it; a driver that does not count vblanks tells 0 each time.
      const std::uint32_t passed = before ? flip->sequence - *before : 1U;
      before = flip->sequence;
      queue_.shown(flip->time_s, passed > 1 && passed < 1000 ? passed - 1 : 0);
      if (last) return;
      if (monotonic_s() < look_s) continue;
      look_s = monotonic_s() + between_looks_s;
      if (!output_->connected()) return lose("it was unplugged");
    }
  }

  void lose(const std::string& why) {
    output_->off();
    queue_.lose({"display.lost", "display", "its output stopped: " + why,
                 "look at its cable and its power, then open it again"});
  }

  KmsSettings settings_;
  DrmCalls& drm_;
  mutable std::mutex mode_mutex_;
  VideoMode mode_;
  std::unique_ptr<KmsOutput> output_;
};

}  // namespace

std::unique_ptr<Display> make_kms_display(const KmsSettings& settings, DrmCalls& drm) {
  return std::make_unique<KmsDisplay>(settings, drm);
}

}  // namespace focalstage
