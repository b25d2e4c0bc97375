#include <algorithm>
#include <cmath>

#include "devices/optotune/driver.h"

namespace focalstage {

namespace {

constexpr int centi_ma_per_a = 100000;

// Of what is nice to know, or asked for a second safety: a device that does not have it is no worse.
bool may_lack(const Fault& fault) { return fault.code == "optotune.unavailable" || fault.code == "optotune.unknown"; }

double limit_of(const OptotuneSettings& settings) {
  const double limit_a = std::min(settings.most_a, optotune_hard_limit_a);
  return limit_a > 0.0 ? limit_a : 0.0;
}

}  // namespace

// No current first, whatever an earlier program left behind.
Status OptotuneDriver::set_up(OptotuneLine& line, OptotuneReport& report) {
  if (const Status greeted = line.greet(); !greeted) return greeted;
  if (const auto mode = line.ask(*optotune_set_mode(OptotuneMode::current)); !mode) return mode.fault();
  if (const Status zero = line.tell(optotune_set_current(0)); !zero) return zero;
  report.mode = OptotuneMode::current;
  const auto type = line.ask(optotune_ask_firmware_type());
  if (!type) return type.fault();
  report.firmware = std::string(1, static_cast<char>((*type)[1]));
  if (const auto version = line.ask(optotune_ask_version()); version) {
    report.firmware += " " + optotune_version(*version).value_or("");
  } else if (!may_lack(version.fault())) {
    return version.fault();
  }
  if (const auto serial = line.ask(optotune_ask_lens_serial()); serial) {
    report.lens_serial.assign(serial->begin() + 1, serial->end());
  } else if (!may_lack(serial.fault())) {
    return serial.fault();
  }
  return set_limits(line, report);
}

Status OptotuneDriver::set_limits(OptotuneLine& line, OptotuneReport& report) {
  const int most = static_cast<int>(std::floor(limit_of(settings_) * centi_ma_per_a + 1e-6));
  if (const auto set = line.ask(optotune_set_most_current(most)); !set) return set.fault();
  const auto taken = line.ask_number(optotune_ask_most_current());
  if (!taken) return taken.fault();
  if (*taken > most || *taken <= 0) {
    return Fault{"optotune.limit", "optotune",
                 "its limit is " + std::to_string(*taken / 100.0) + " mA and not " + std::to_string(most / 100.0),
                 "set most_a to what it takes"};
  }
  report.most_a = static_cast<double>(*taken) / centi_ma_per_a;
  const int counts = optotune_counts(report.most_a, report.most_a);
  for (const auto& command : {optotune_set_upper_limit(counts, settings_.wide_limits),
                              optotune_set_lower_limit(-counts, settings_.wide_limits)}) {
    const auto set = line.ask(command);
    if (!set && !may_lack(set.fault())) return set.fault();
  }
  return {};
}

}  // namespace focalstage
