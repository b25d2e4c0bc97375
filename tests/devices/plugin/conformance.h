#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "devices/plugin/library.h"
#include "devices/plugin/plugin_projector.h"
#include "devices/roles/clock.h"

namespace focalstage::test {

/// Long waits are for crowded machines; what is meant to happen happens in milliseconds.
inline bool within(double seconds, const std::function<bool()>& holds) {
  for (const double end_s = monotonic_s() + seconds; monotonic_s() < end_s;) {
    if (holds()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return holds();
}

inline Exposures four_in_100_ms() {
  Exposures exposures;
  exposures.period_s = 0.100;
  exposures.start_s = {0.001, 0.025, 0.050, 0.075};
  exposures.exposure_s = 0.002;
  return exposures;
}

/// Four pictures whose codes are `first`, `first` + 1...
inline std::vector<Picture> period_of(const ProjectorDevice& projector, int first) {
  const ProjectorAbilities able = projector.abilities();
  std::vector<Picture> pictures;
  for (int i = 0; i < 4; ++i) {
    const auto codes = std::make_shared<std::vector<std::uint8_t>>(
        static_cast<std::size_t>(able.width_px) * static_cast<std::size_t>(able.height_px),
        static_cast<std::uint8_t>(first + i));
    pictures.push_back({codes, *codes});
  }
  return pictures;
}

/// What every projector plugin keeps to, as a list of what this one breaks: "dark", "counts"... Empty: nothing.
class Conformance {
 public:
  explicit Conformance(const PluginProjectorSettings& settings) : settings_(settings) {}

  std::vector<std::string> run() {
    projector_ = make_plugin_projector(settings_);
    for (const auto step :
         {&Conformance::opens, &Conformance::shows, &Conformance::misses, &Conformance::darkens, &Conformance::fills,
          &Conformance::restarts, &Conformance::reopens, &Conformance::closes, &Conformance::dark_by_itself}) {
      (this->*step)();
      if (!broken_.empty()) break;
    }
    return broken_;
  }

  bool breaks(const std::string& rule) const { return std::ranges::find(broken_, rule) != broken_.end(); }

 private:
  void keep(const std::string& rule, bool kept) {
    if (!kept && !breaks(rule)) broken_.push_back(rule);
  }

  void opens() {
    const Status opened = projector_->open();
    if (!opened) return broken_.push_back("opens: " + opened.fault().code);
    keep("names itself", !projector_->id().model.empty());
    keep("ready", projector_->state().phase == DevicePhase::ready);
    const Exposures nothing;
    keep("refuses no exposures", !projector_->arm(nothing).ok());
  }

  bool begin(const Exposures& exposures = four_in_100_ms()) {
    const bool begun = projector_->arm(exposures).ok() && projector_->start().ok();
    keep("arms and starts", begun);
    return begun;
  }

  bool answers() const {
    const DevicePhase phase = projector_->state().phase;
    return phase == DevicePhase::ready || phase == DevicePhase::running;
  }

  /// Posts whatever it takes until so many periods were shown.
  bool feed(std::uint64_t periods) {
    int posted = 0;
    return within(10.0, [&] {
      while (posted < static_cast<int>(projector_->report().periods) + 3 &&
             projector_->post(period_of(*projector_, 4 * posted + 1)).ok())
        ++posted;
      return !answers() || projector_->report().periods >= periods;
    });
  }

  void shows() {
    if (!begin()) return;
    keep("shows", feed(12));
    const ProjectorReport report = projector_->report();
    keep("answers while it shows", answers());
    keep("counts what it shows", report.missed == 0 && report.exposures >= 48);
    keep("tells in time", monotonic_s() - report.told_s < 0.5 && report.told_s <= monotonic_s());
  }

  /// Nobody posts: black, and counted.
  void misses() {
    keep("counts what it misses", within(3.0, [&] { return !answers() || projector_->report().missed >= 8; }));
    keep("answers while it misses", answers());
  }

  void darkens() {
    const double told_s = monotonic_s();
    const bool dark = projector_->dark();
    keep("dark", dark && monotonic_s() - told_s < 0.2);
    keep("dark once told", projector_->state().phase == DevicePhase::ready);
    const auto late = projector_->post(period_of(*projector_, 1));
    keep("takes nothing in the dark", !late.ok() && late.fault().code == "projector.dark");
  }

  void fills() {
    Exposures slow{8.0, 1, 8, {0.0, 2.0, 4.0, 6.0}, 0.1};  // nothing is shown meanwhile
    if (!begin(slow)) return;
    const int ahead = projector_->abilities().most_periods_ahead;
    int taken = 0;
    Status posted;
    while (taken < 4 * ahead && (posted = projector_->post({})).ok()) ++taken;
    keep("full", !posted.ok() && posted.fault().code == "projector.full" && taken == ahead);
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    keep("holds what it said", answers());
    (void)projector_->dark();
  }

  void restarts() {
    if (!begin()) return;
    keep("counts anew", projector_->report().exposures < 4);
    keep("shows again", feed(2) && projector_->report().missed == 0);
    // Dark while pictures are on their way, from another thread.
    std::atomic<bool> dark = false;
    const std::jthread watchdog([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(30));
      dark = projector_->dark();
    });
    const bool ended = within(1.0, [&] {
      const Status posted = projector_->post(period_of(*projector_, 1));
      return !posted && posted.fault().code == "projector.dark";
    });
    keep("dark while it is fed", ended && within(0.3, [&] { return dark.load(); }));
  }

  void reopens() {
    projector_->close();
    keep("opens again", projector_->open().ok() && projector_->open().ok());
    if (begin()) keep("shows when opened again", feed(2));
  }

  void closes() {
    projector_->close();
    keep("off once closed", projector_->state().phase == DevicePhase::off);
  }

  /// The plugin's own words, without the role before them: after `blank` nothing is taken.
  void dark_by_itself() {
    const auto table = load_projector_plugin(settings_.plugin.library);
    if (!table) return;
    std::vector<focalstage_setting> options;
    for (const auto& [key, value] : settings_.plugin.options) options.push_back({key.c_str(), value.c_str()});
    focalstage_projector_device* device = nullptr;
    char error[FOCALSTAGE_ERROR_BYTES] = {};
    const focalstage_projector& plugin = **table;
    if (plugin.open(options.data(), static_cast<std::uint32_t>(options.size()), &device, error) != FOCALSTAGE_OK) {
      return keep("opens", false);
    }
    const std::int64_t start_ns = 0;
    const focalstage_exposures exposures{40e6, 1'000'000, 1, 8, 1, &start_ns};
    std::uint8_t* buffer = nullptr;
    keep("configures", plugin.configure(device, &exposures, error) == FOCALSTAGE_OK);
    keep("starts", plugin.start(device, error) == FOCALSTAGE_OK);
    keep("takes a picture", plugin.acquire(device, &buffer, 50'000'000, error) == FOCALSTAGE_OK && buffer != nullptr &&
                                plugin.submit(device, buffer, 0, 0, error) == FOCALSTAGE_OK);
    keep("blanks", plugin.blank(device) == FOCALSTAGE_OK);
    keep("gives no buffer while blank", plugin.acquire(device, &buffer, 1'000'000, error) == FOCALSTAGE_DARK);
    keep("takes no picture while blank", plugin.submit(device, nullptr, 1, 0, error) == FOCALSTAGE_DARK);
    plugin.close(device);
  }

  PluginProjectorSettings settings_;
  std::unique_ptr<ProjectorDevice> projector_;
  std::vector<std::string> broken_;
};

}  // namespace focalstage::test
