#pragma once

#include <array>

#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

/// A LightCrafter 4500 as its public descriptions have it, written without a look at the driver.
namespace focalstage::lightcrafter_emulator {

using Bytes = std::vector<std::uint8_t>;

struct Options {
  bool strict = true;        ///< refuses settings while it runs, and "start" without a validation
  int validation_polls = 3;  ///< that find it busy
  bool start_twice = false;  ///< hears only the second "start" after a change of settings
  bool echo_sequence = true;
  int frame_delay = 1;     ///< frames from the video input to light
  int signal_width = 912;  ///< what it says that it receives
  int signal_height = 1140;
  std::size_t most_lights = 512;  ///< that are kept: older ones are forgotten
};

struct Misbehaviour {
  double delay_s = 0.0;                  ///< of every answer
  bool silent = false;                   ///< does what it is told and answers nothing
  bool deaf = false;                     ///< neither does nor answers
  std::optional<std::uint16_t> refuses;  ///< a command, as TI writes it (0x1A24)
  bool refuses_all = false;
  bool wrong_sequence = false;
  bool short_read = false;         ///< three bytes of each answer
  bool stale_first = false;        ///< an answer to something else before the right one
  std::uint8_t hardware_bits = 0;  ///< that differ from health
  std::uint8_t validation_bits = 0;
  bool validates_for_ever = false;
  bool never_runs = false;
  bool keeps_shining = false;                         ///< ignores "stop" and "LEDs off", though it says yes
  std::optional<std::size_t> disconnect_after_bytes;  ///< of those it receives from now on
};

/// Light that left it, in device time.
struct Light {
  double start_s = 0.0;
  double length_s = 0.0;
  int leds = 0;          ///< bit 0 red, 1 green, 2 blue
  double current = 0.0;  ///< 0..1 of each
  bool video = false;    ///< a whole frame of video mode, no pattern
  int pattern = 0;
  int bits = 0;
  bool inverted = false;
  std::uint64_t frame = 0;  ///< which of the frames handed to it, from 0
  std::shared_ptr<const std::vector<std::uint32_t>> pixels;

  /// What the mirrors showed, 0..2^bits - 1, row by row.
  std::vector<std::uint8_t> levels() const;
  bool black() const;
};

struct Answers {
  std::vector<Bytes> reports;
  double delay_s = 0.0;
  bool gone = false;  ///< it vanished from the bus
};

class Board {
 public:
  explicit Board(Options options = {}) : options_(options) {}

  /// One output report: 64 bytes.
  Answers take(std::span<const std::uint8_t> report);

  /// A video frame, 0x00RRGGBB row by row, whose vsync came at `vsync_s` of device time, not before the one before.
  void video_frame(std::span<const std::uint32_t> pixels, double vsync_s);
  /// A vsync whose frame is the same as before.
  void vsync(double vsync_s);

  std::vector<Light> lights() const;
  std::vector<Light> take_lights();

  void misbehave(const Misbehaviour& how);
  /// Stops by itself, as after an error.
  void stumble();
  /// As after switching it off and on: video mode, LEDs by the sequencer.
  void power_cycle();

  bool running() const;
  std::uint64_t messages() const;
  std::uint64_t refusals() const;
  std::vector<std::uint16_t> history() const;  ///< every command written, in order
  double brightness() const;

 private:
  struct Entry {
    int trigger = 0, pattern = 0, bits = 0, leds = 0;
    bool invert = false, black_after = false;
    std::uint32_t exposure_us = 0, period_us = 0;
  };
  enum class Verdict { done, refused };

  void message(Answers& answers);
  Verdict write(std::uint16_t command, std::span<const std::uint8_t> data);
  Verdict write_running(std::uint16_t command, std::span<const std::uint8_t> data);
  Verdict write_setting(std::uint16_t command, std::span<const std::uint8_t> data);
  Verdict write_mailbox(std::uint16_t command, std::span<const std::uint8_t> data);
  std::optional<Bytes> read(std::uint16_t command);
  Bytes answer(std::uint8_t flags, std::uint8_t sequence, const Bytes& data) const;
  std::vector<Entry> table() const;
  std::uint8_t check() const;
  void begin_period(double vsync_s);
  void shine(Light light);

  mutable std::mutex mutex_;
  Options options_;
  Misbehaviour how_;
  std::size_t bytes_ = 0;

  Bytes pending_;
  std::size_t missing_ = 0;

  // As after power-up.
  bool awake_ = true, pattern_mode_ = false, running_ = false, paused_ = false, validated_ = false, first_start_ = true;
  std::uint8_t source_ = 0, trigger_mode_ = 0, led_enable_ = 8, mailbox_ = 0, input_source_ = 0;
  std::array<std::uint8_t, 3> current_{0x97, 0x78, 0x7D};
  bool invert_pwm_ = false, repeat_ = true, parked_ = false, frozen_ = false, aborted_ = false;
  int validating_ = 0;
  int entries_ = 1, variable_entries_ = 1;
  std::uint32_t exposure_us_ = 0, period_us_ = 0;
  std::size_t address_ = 0, variable_address_ = 0;
  std::vector<Entry> fixed_ = std::vector<Entry>(128), variable_ = std::vector<Entry>(1824);

  std::deque<std::shared_ptr<const std::vector<std::uint32_t>>> frames_;
  std::uint64_t frame_count_ = 0;
  double busy_until_s_ = -1e9;
  std::optional<double> vsync_s_;
  std::deque<Light> lights_;
  std::uint64_t messages_ = 0, refusals_ = 0;
  std::vector<std::uint16_t> history_;
};

}  // namespace focalstage::lightcrafter_emulator
