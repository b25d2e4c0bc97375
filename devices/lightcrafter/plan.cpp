#include "devices/lightcrafter/plan.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "devices/lightcrafter/timing.h"
#include "devices/planes/plane_order.h"

namespace focalstage::lightcrafter {

namespace {

Fault unable(const std::string& message, const std::string& remedy) {
  return {"projector.unable", "LightCrafter 4500", message, remedy};
}

std::string us(double value) { return std::to_string(std::llround(value)) + " us"; }

std::int64_t to_us(double seconds) { return std::llround(seconds * 1e6); }

std::string several(std::size_t count, const char* what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

/// The most bits that this many patterns of that length may have; 0: none.
int deepest(double exposure_us, std::size_t patterns) {
  for (int bits = 8; bits >= 1; --bits) {
    if (exposure_us >= least_exposure_us(bits) && patterns <= static_cast<std::size_t>(most_patterns(bits)))
      return bits;
  }
  return 0;
}

std::string depth_remedy(double exposure_us, std::size_t patterns) {
  const int bits = deepest(exposure_us, patterns);
  if (bits == 0) return "show fewer pictures, each for longer";
  return "show " + several(static_cast<std::size_t>(bits), "bit") + " or fewer, or fewer pictures, each for longer";
}

std::optional<Fault> check_numbers(const Exposures& exposures, double interval_s, const PlanRules& rules) {
  const int bits = rules.shown_bits.value_or(exposures.form.bits);
  const auto in_depths = [](int value) { return value >= 1 && value <= 8; };
  if (!in_depths(exposures.form.bits) || !in_depths(bits) || bits > exposures.form.bits) {
    return unable(
        "pictures of " + std::to_string(exposures.form.bits) + " bits cannot be shown with " + std::to_string(bits),
        "give 1..8 bits, shown with at most as many");
  }
  if (exposures.form.channels != 1 && exposures.form.channels != 3) {
    return unable("pictures of " + std::to_string(exposures.form.channels) + " channels", "send gray or rgb pictures");
  }
  const auto real = [](double value) { return std::isfinite(value) && std::abs(value) < 1.0; };
  const bool numbers = real(exposures.period_s) && real(exposures.exposure_s) && real(interval_s) &&
                       std::ranges::all_of(exposures.start_s, real) && interval_s > 0.0;
  if (!numbers || exposures.period_s <= 0.0) return unable("times that are no times", "give seconds, below one");
  if (std::abs(exposures.period_s - interval_s) > rules.period_tolerance * interval_s) {
    return unable("a period of " + us(exposures.period_s * 1e6) + " was asked for and the display gives one of " +
                      us(interval_s * 1e6),
                  "choose a display mode of the sweep's rate");
  }
  return std::nullopt;
}

std::optional<Fault> check_patterns(const Exposures& exposures, int bits) {
  const std::size_t patterns = exposures.start_s.size() * static_cast<std::size_t>(exposures.form.channels);
  const double each_us = exposures.exposure_s * 1e6 / exposures.form.channels;
  if (patterns > static_cast<std::size_t>(most_patterns(bits))) {
    return unable(several(patterns, "pattern") + " of " + std::to_string(bits) + " bits need more planes than the " +
                      several(static_cast<std::size_t>(most_patterns(bits)), "pattern") + " of a video frame",
                  depth_remedy(each_us, patterns));
  }
  if (!exposures.start_s.empty() && each_us + 0.5 < least_exposure_us(bits)) {
    return unable("an exposure of " + us(each_us) + " is shorter than the least at " + std::to_string(bits) +
                      " bits, " + us(least_exposure_us(bits)),
                  depth_remedy(each_us, patterns));
  }
  return std::nullopt;
}

class Planner {
 public:
  Planner(const Exposures& exposures, double interval_s, const PlanRules& rules)
      : exposures_(exposures),
        rules_(rules),
        bits_(rules.shown_bits.value_or(exposures.form.bits)),
        interval_us_(std::min(interval_s, exposures.period_s) * 1e6) {
    plan_.pack = {
        width_px, height_px, static_cast<int>(exposures.start_s.size()), exposures.form.channels, exposures.form.bits,
        bits_};
  }

  Result<PatternPlan> make() {
    const std::size_t count = exposures_.start_s.size();
    if (count > 0) plan_.lead_s = exposures_.start_s.front();
    for (std::size_t i = 0; i < count; ++i) {
      add_exposure(i);
      if (const auto fault = end_exposure(i)) return *fault;
    }
    if (count == 0) add_dark(least_exposure_us(1));
    plan_.entries.front().lut.trigger = LutEntry::Trigger::external_positive;
    for (const PlanEntry& entry : plan_.entries) plan_.total_us += entry.period_us;
    if (plan_.total_us + dark_us > interval_us_) {
      return unable("from the first exposure to the end of the last pass " + us(plan_.total_us) + " of a period of " +
                        us(interval_us_) + ", and " + us(dark_us) + " must be left before the next vsync",
                    "show fewer pictures, or shorter ones");
    }
    return std::move(plan_);
  }

 private:
  /// Times are rounded once, from the first exposure on, so that roundings do not add up.
  std::int64_t start_us(std::size_t i) const { return to_us(exposures_.start_s[i] - exposures_.start_s.front()); }
  std::int64_t end_us(std::size_t i, int channel) const {
    return to_us(exposures_.start_s[i] - exposures_.start_s.front() +
                 exposures_.exposure_s * channel / exposures_.form.channels);
  }

  void add_exposure(std::size_t i) {
    std::int64_t from = start_us(i);
    for (int channel = 0; channel < exposures_.form.channels; ++channel) {
      LutEntry lut;
      lut.trigger = LutEntry::Trigger::none;
      lut.pattern = static_cast<std::uint8_t>(static_cast<int>(i) * exposures_.form.channels + channel);
      lut.bits = static_cast<std::uint8_t>(bits_);
      lut.leds = exposures_.form.channels == 3 ? static_cast<std::uint8_t>(1U << channel) : rules_.leds;
      const std::int64_t to = end_us(i, channel + 1);
      const auto length = static_cast<std::uint32_t>(to - from);
      plan_.entries.push_back({lut, std::max(length, least_exposure_us(bits_)), length});
      plan_.entries.back().period_us = plan_.entries.back().exposure_us;
      from = to;
    }
  }

  /// Darkness up to the next exposure, or none where the two touch.
  std::optional<Fault> end_exposure(std::size_t i) {
    const bool last = i + 1 == exposures_.start_s.size();
    const std::int64_t gap = last ? 0 : start_us(i + 1) - end_us(i, exposures_.form.channels);
    PlanEntry& entry = plan_.entries.back();
    if (gap < -1) {
      return unable("exposures " + std::to_string(i) + " and " + std::to_string(i + 1) + " overlap by " +
                        us(static_cast<double>(-gap)),
                    "give exposures in time order, each ending before the next begins");
    }
    if (last) {
      entry.lut.black_after = rules_.black_after;
      return std::nullopt;
    }
    if (gap <= 1) {  // they touch: what rounding left between them goes to the first
      const std::int64_t length = std::max<std::int64_t>(entry.exposure_us + gap, least_exposure_us(bits_));
      entry.exposure_us = entry.period_us = static_cast<std::uint32_t>(length);
      return std::nullopt;
    }
    const std::int64_t least = rules_.gap == Gap::spare_time ? dark_us : least_exposure_us(1);
    if (gap < least) {
      return unable("exposures " + std::to_string(i) + " and " + std::to_string(i + 1) + " are " +
                        us(static_cast<double>(gap)) + " apart, and the least time in the dark is " +
                        us(static_cast<double>(least)),
                    "let them touch, or move them further apart");
    }
    if (rules_.gap == Gap::spare_time) {
      entry.period_us += static_cast<std::uint32_t>(gap);
      entry.lut.black_after = rules_.black_after;
    } else {
      add_dark(static_cast<std::uint32_t>(gap));
    }
    return std::nullopt;
  }

  void add_dark(std::uint32_t length_us) {
    LutEntry lut;
    lut.trigger = LutEntry::Trigger::none;
    lut.bits = 1;
    lut.leds = 0;
    plan_.entries.push_back({lut, length_us, length_us});
  }

  const Exposures& exposures_;
  const PlanRules& rules_;
  int bits_;
  double interval_us_;
  PatternPlan plan_;
};

}  // namespace

Result<PatternPlan> plan_patterns(const Exposures& exposures, double interval_s, const PlanRules& rules) {
  if (const auto fault = check_numbers(exposures, interval_s, rules)) return *fault;
  if (const auto fault = check_patterns(exposures, rules.shown_bits.value_or(exposures.form.bits))) return *fault;
  return Planner(exposures, interval_s, rules).make();
}

}  // namespace focalstage::lightcrafter
