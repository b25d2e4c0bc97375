#include <algorithm>
#include <array>
#include <utility>

#include "tests/devices/lightcrafter/emulator/board.h"

// What light leaves the board: its pattern table, its mirrors, its lamps.
namespace focalstage::lightcrafter_emulator {

namespace {

/// The lowest plane of a pattern: of 0..7 green, of 8..15 red, of 16..23 blue; less than 0 where there is no such one.
int lowest_plane(int bits, int pattern) {
  static const std::array<std::vector<int>, 9> lowest{{
      {},
      {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23},
      {0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22},
      {0, 3, 6, 9, 12, 15, 18, 21},
      {0, 4, 8, 12, 16, 20},
      {1, 7, 13, 19},
      {0, 6, 12, 18},
      {1, 9, 17},
      {0, 8, 16},
  }};
  if (bits < 1 || bits > 8) return -1;
  const auto& patterns = lowest[static_cast<std::size_t>(bits)];
  return std::cmp_less(pattern, patterns.size()) ? patterns[static_cast<std::size_t>(pattern)] : -1;
}

bool plane_of(std::uint32_t pixel, int plane) {
  const int shift = plane < 8 ? 8 + plane : plane < 16 ? 16 + plane - 8 : plane - 16;
  return (pixel >> shift & 1U) != 0;
}

constexpr std::array<std::uint32_t, 9> least_us{0, 235, 700, 1570, 1700, 2000, 2500, 4500, 8333};

}  // namespace

std::vector<std::uint8_t> Light::levels() const {
  if (!pixels) return {};
  const int lowest = lowest_plane(bits, pattern);
  std::vector<std::uint8_t> shown(pixels->size(), 0);
  for (std::size_t i = 0; i < shown.size() && lowest >= 0; ++i) {
    for (int k = 0; k < bits; ++k) {
      if (plane_of((*pixels)[i], lowest + k) != inverted) shown[i] = static_cast<std::uint8_t>(shown[i] | 1 << k);
    }
  }
  return shown;
}

bool Light::black() const {
  if (!pixels) return true;
  if (video) return std::ranges::all_of(*pixels, [](std::uint32_t pixel) { return (pixel & 0xFFFFFFU) == 0; });
  const auto shown = levels();
  return std::ranges::all_of(shown, [](std::uint8_t level) { return level == 0; });
}

std::vector<Board::Entry> Board::table() const {
  const bool variable = trigger_mode_ >= 3;
  const auto& from = variable ? variable_ : fixed_;
  std::vector<Entry> entries(from.begin(), from.begin() + (variable ? variable_entries_ : entries_));
  for (Entry& entry : entries) {
    if (variable) continue;
    entry.exposure_us = exposure_us_;
    entry.period_us = period_us_;
  }
  return entries;
}

std::uint8_t Board::check() const {
  std::uint8_t found = how_.validation_bits;
  const auto entries = table();
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Entry& entry = entries[i];
    const bool deep = entry.bits >= 1 && entry.bits <= 8;
    const bool exists = lowest_plane(entry.bits, entry.pattern) >= 0 || entry.pattern == 24 || entry.pattern == 0x3F;
    if (!deep || !exists) found |= 2;
    if (deep && (entry.exposure_us < least_us[static_cast<std::size_t>(entry.bits)] ||
                 entry.exposure_us > 200'000'000U || entry.period_us < entry.exposure_us)) {
      found |= 1;
    }
    const std::uint32_t spare = entry.period_us - entry.exposure_us;
    if (spare > 0 && spare < 230) found |= 16;
    const Entry& before = entries[(i + entries.size() - 1) % entries.size()];
    if ((entry.trigger == 1 || entry.trigger == 2) && !before.black_after) found |= 8;
  }
  return found;
}

void Board::video_frame(std::span<const std::uint32_t> pixels, double vsync_s) {
  const std::lock_guard lock(mutex_);
  if (!frozen_) frames_.push_back(std::make_shared<const std::vector<std::uint32_t>>(pixels.begin(), pixels.end()));
  ++frame_count_;
  begin_period(vsync_s);
}

void Board::vsync(double vsync_s) {
  const std::lock_guard lock(mutex_);
  if (!frames_.empty()) frames_.push_back(frames_.back());
  ++frame_count_;
  begin_period(vsync_s);
}

void Board::begin_period(double vsync_s) {
  const auto delay = static_cast<std::size_t>(options_.frame_delay);
  while (frames_.size() > delay + 1) frames_.pop_front();
  const double before_s = vsync_s_.value_or(vsync_s - 1.0 / 60.0);
  vsync_s_ = vsync_s;
  if (!awake_ || parked_) return;
  Light light;
  light.start_s = vsync_s;
  if (frames_.size() == delay + 1) {
    light.pixels = frames_.front();
    light.frame = frame_count_ - 1 - delay;
  }
  if (!pattern_mode_) {
    light.video = true;
    light.length_s = vsync_s - before_s;
    light.bits = 8;
    light.leds = (led_enable_ & 8) != 0 ? 7 : led_enable_ & 7;
    shine(light);
    return;
  }
  if (!running_ || source_ != 0 || (trigger_mode_ != 0 && trigger_mode_ != 4)) return;
  if (busy_until_s_ > vsync_s + 1e-9) {  // the table was longer than the time between vsyncs
    aborted_ = true;
    running_ = false;
    return;
  }
  double at_s = vsync_s;
  for (const Entry& entry : table()) {
    light.start_s = at_s;
    light.length_s = 1e-6 * entry.exposure_us;
    light.leds = (led_enable_ & 8) != 0 ? entry.leds : led_enable_ & 7;
    light.pattern = entry.pattern;
    light.bits = entry.bits;
    light.inverted = entry.invert;
    shine(light);
    at_s += 1e-6 * entry.period_us;
  }
  busy_until_s_ = at_s;
  if (!repeat_) running_ = false;
}

void Board::shine(Light light) {
  // The board's LED driver takes currents the other way round.
  const int raw = *std::ranges::min_element(current_);
  light.current = (invert_pwm_ ? raw : 255 - raw) / 255.0;
  if (light.leds == 0 || light.current <= 0.0 || !light.pixels) return;
  lights_.push_back(std::move(light));
  while (lights_.size() > options_.most_lights) lights_.pop_front();
}

std::vector<Light> Board::lights() const {
  const std::lock_guard lock(mutex_);
  return {lights_.begin(), lights_.end()};
}

std::vector<Light> Board::take_lights() {
  const std::lock_guard lock(mutex_);
  std::vector<Light> taken(lights_.begin(), lights_.end());
  lights_.clear();
  return taken;
}

}  // namespace focalstage::lightcrafter_emulator
