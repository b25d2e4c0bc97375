#pragma once

#include <functional>
#include <memory>
#include <string>

#include <doctest/doctest.h>

#include "devices/optotune/optotune.h"
#include "devices/roles/clock.h"
#include "tests/devices/optotune/emulator/line.h"

namespace focalstage {

namespace emulated = optotune_emulator;

inline std::unique_ptr<emulated::Line> plugged(const emulated::Options& options = {}) {
  auto line = emulated::Line::open(options);
  REQUIRE(line);
  return line;
}

inline OptotuneSettings settings_of(const emulated::Line& line) {
  OptotuneSettings settings;
  settings.search.sysfs = "/nonexistent";  // nothing that is really plugged in
  settings.search.paths = {line.path()};
  settings.answer_s = 0.25;  // the emulator shares a busy machine
  return settings;
}

inline bool opened(OptotuneLens& lens) {
  const Status status = lens.open();
  if (!status) MESSAGE(describe(status.fault()));
  return status.ok();
}

inline bool until(const std::function<bool()>& so, double longest_s) {
  const double start_s = monotonic_s();
  while (!so()) {
    if (monotonic_s() - start_s > longest_s) return false;
    sleep_until(monotonic_s() + 0.002);
  }
  return true;
}

inline double given_a(const emulated::Line& line) {
  const auto now = line.snapshot();
  return now.mode() == 1 ? now.counts() * now.centi_ma() * 1e-5 / 4095.0 : 0.0;
}

}  // namespace focalstage
