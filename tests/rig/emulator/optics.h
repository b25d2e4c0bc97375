#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

namespace focalstage::rig_emulator {

struct PixelRectangle {
  int left = 0;
  int top = 0;
  int width = 0;
  int height = 0;
};

/// A picture that waits for its trigger.
struct WaitingPicture {
  bool black = false;
  std::uint32_t crc = 0;         ///< CRC-32 of its bytes, as zlib's
  double mean_level = 0.0;       ///< of all its pixels, 0 to 1
  std::vector<double> levels{};  ///< of those of each region
};

/// Light that began.
struct Begun {
  double start_s = 0.0;  ///< device time
  double exposure_s = 0.0;
  bool dark = false;  ///< no picture was there, or a black one
  std::uint32_t crc = 0;
  double mean_level = 0.0;
  std::vector<double> levels{};
};

struct OpticsSettings {
  std::string socket;  ///< where the projector plugin `wire` finds it
  std::uint32_t width_px = 1024;
  std::uint32_t height_px = 768;
  std::uint32_t most_periods_ahead = 6;
  double latency_s = 0.00015;
  std::vector<PixelRectangle> regions;  ///< whose light somebody wants to know
};

/// A triggered projector's light engine at the other end of the plugin `wire`: it keeps the frames that come and shows
/// the next at each trigger.
class Optics {
 public:
  explicit Optics(const OpticsSettings& settings);
  ~Optics();
  Optics(const Optics&) = delete;
  Optics& operator=(const Optics&) = delete;

  void unplug();
  void plug_in();

  /// Device time is `device_s`, which is `monotonic_s` for the host: it is told how the counts stand.
  void advance_to(double device_s, double monotonic_s);

  /// An edge on its trigger input, at that device time. None: it is off, stopped, or was made blank.
  std::optional<Begun> trigger(double device_s);

  /// The next trigger comes to nothing.
  void lose_next_trigger();

 private:
  void serve(const std::stop_token& stop);
  void talk(int connection, const std::stop_token& stop);
  void take(int connection, std::uint32_t type, std::span<const std::uint8_t> body);
  void tell_counts(double device_s, double monotonic_s);
  double level_in(const PixelRectangle& region, std::span<const std::uint8_t> pixels) const;
  WaitingPicture picture_of(std::uint32_t exposure, std::span<const std::uint8_t> pixels);
  void forget();

  struct Seen {
    std::vector<std::uint8_t> pixels;
    WaitingPicture picture;
  };

  OpticsSettings settings_;
  mutable std::mutex mutex_;
  bool plugged_in_ = false;
  int listener_ = -1;
  int connection_ = -1;
  bool running_ = false;
  bool lose_next_ = false;
  double exposure_s_ = 0.0;
  std::deque<WaitingPicture> waiting_;
  std::map<std::uint32_t, Seen> seen_;  ///< by exposure
  std::uint64_t run_ = 0;
  std::uint64_t shown_ = 0;
  std::uint64_t missed_ = 0;
  std::jthread thread_;
};

}  // namespace focalstage::rig_emulator
