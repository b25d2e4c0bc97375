#include "devices/mcc1208/wave.h"

#include <algorithm>
#include <cmath>

#include "core/base/periodic.h"
#include "devices/mcc1208/packets.h"

namespace focalstage {

namespace {

constexpr std::size_t most_asked_samples = 1000000;

Fault unable(const std::string& message, const std::string& remedy = "") {
  return {"drive.unable", "mcc1208", message, remedy};
}

double amperes_per_code(const Mcc1208Settings& settings) { return settings.amperes_per_volt * mcc_volts(1); }

Status check_asked(const DrivePeriod& period, const Mcc1208Settings& settings) {
  const std::vector<double>& drive_a = period.drive_a.left;
  if (drive_a.empty() || drive_a.size() > most_asked_samples) return unable("a period has 1 to 1000000 samples");
  if (drive_a != period.drive_a.right) {
    return unable("both lenses hang on one channel, and their periods differ", "give both the same current");
  }
  if (!std::all_of(drive_a.begin(), drive_a.end(), [](double a) { return std::isfinite(a); })) {
    return unable("a sample is no number");
  }
  if (!std::isfinite(period.period_s) || period.period_s <= 0.0) return unable("the period is no time");
  if (amperes_per_code(settings) == 0.0 || !std::isfinite(amperes_per_code(settings))) {
    return unable("what current the amplifier gives per volt is not told",
                  "measure it and set amperes_per_volt and zero_code");
  }
  return {};
}

// The samples are whole, so the pacer alone makes the period.
Result<std::uint32_t> pacer_for(double period_s, const Mcc1208Settings& settings) {
  const double asked_per_s = settings.samples / period_s;
  const auto pacer = mcc_pacer(asked_per_s);
  if (!pacer || asked_per_s > settings.most_scans_per_s * (1.0 + 1e-6 * settings.most_off_ppm)) {
    return unable(
        std::to_string(asked_per_s) + " scans per second are more than " + std::to_string(settings.most_scans_per_s),
        "ask for a longer period or set fewer samples");
  }
  const double made_s = settings.samples / mcc_scans_per_s(*pacer);
  const double off_ppm = 1e6 * std::abs(made_s / period_s - 1.0);
  if (off_ppm > settings.most_off_ppm) {
    return unable("the nearest period that the pacer makes, " + std::to_string(1e3 * made_s) + " ms, is off by " +
                      std::to_string(off_ppm) + " ppm",
                  "ask for that period, or set samples to a divider of this one");
  }
  return *pacer;
}

}  // namespace

Status check_mcc1208(const Mcc1208Settings& settings) {
  const auto senseless = [](const std::string& name, const std::string& allowed) {
    return Fault{"mcc1208.settings", "mcc1208", "the setting " + name + " is not within " + allowed, "mend it"};
  };
  if (settings.zero_code < 0 || settings.zero_code > mcc_top_code) return senseless("zero_code", "0 to 4095");
  if (settings.enable_bit.value_or(0) < 0 || settings.enable_bit.value_or(0) > 15) {
    return senseless("enable_bit", "0 to 15");
  }
  if (settings.samples < 2 || settings.samples > 4000) return senseless("samples", "2 to 4000");
  if (!std::isfinite(settings.amperes_per_volt)) return senseless("amperes_per_volt", "numbers");
  if (!(settings.ramp_s >= 0.0 && settings.ramp_s <= 0.06)) return senseless("ramp_s", "0 to 0.06");
  if (settings.queued_periods < 3 || settings.queued_periods > 32) return senseless("queued_periods", "3 to 32");
  for (const double time_s : {settings.answer_s, settings.watch_s, settings.silence_s}) {
    if (!(time_s > 0.0 && time_s < 10.0)) return senseless("answer_s, watch_s or silence_s", "0 to 10");
  }
  return {};
}

double mcc1208_most_a(const Mcc1208Settings& settings) {
  const double per_code = std::abs(amperes_per_code(settings));
  const int room = std::min(settings.zero_code, mcc_top_code - settings.zero_code);
  const double limit_a = std::min({settings.most_a, mcc1208_hard_limit_a, room * per_code});
  return limit_a > 0.0 ? limit_a : 0.0;  // a limit that is no number lets nothing through
}

int mcc1208_code(double drive_a, const Mcc1208Settings& settings, std::uint64_t& clamped) {
  const double per_code = amperes_per_code(settings);
  const double most_a = mcc1208_most_a(settings);
  if (most_a == 0.0) {
    if (drive_a != 0.0) ++clamped;
    return settings.zero_code;
  }
  if (std::abs(drive_a) > most_a) ++clamped;
  const double most_codes = std::floor(most_a / std::abs(per_code) + 1e-9);  // never rounded beyond the limit
  return settings.zero_code + static_cast<int>(std::clamp(std::round(drive_a / per_code), -most_codes, most_codes));
}

Result<Mcc1208Wave> mcc1208_wave(const DrivePeriod& period, const Mcc1208Settings& settings) {
  if (const Status sensible = check_mcc1208(settings); !sensible) return sensible.fault();
  if (const Status asked = check_asked(period, settings); !asked) return asked.fault();
  const auto pacer = pacer_for(period.period_s, settings);
  if (!pacer) return pacer.fault();
  Mcc1208Wave wave;
  wave.pacer = *pacer;
  wave.period_s = settings.samples / mcc_scans_per_s(*pacer);
  const auto& asked_a = period.drive_a.left;
  const int high = std::clamp(static_cast<int>(std::lround(settings.sync_pulse_s * mcc_scans_per_s(*pacer))), 1,
                              settings.samples - 1);
  wave.pulse_scans = high;
  for (int i = 0; i < settings.samples; ++i) {
    const double drive_a = periodic_at(asked_a, static_cast<double>(i) / settings.samples);
    const int code = mcc1208_code(drive_a, settings, wave.clamped);
    if (i == 0) wave.first_code = code;
    wave.codes.push_back(code);
    append_mcc_scan(wave.bytes, code, i < high ? mcc_top_code : 0);
  }
  return wave;
}

std::vector<std::uint8_t> mcc1208_lead_in(int first_code, double scans_per_s, const Mcc1208Settings& settings) {
  constexpr int packet_scans = static_cast<int>(mcc_packet_bytes) / 4;
  std::vector<std::uint8_t> bytes;
  if (first_code == settings.zero_code) return bytes;
  const double ramp_s = std::clamp(settings.ramp_s, 0.0, 0.06);
  const int scans = static_cast<int>(std::ceil(ramp_s * scans_per_s / packet_scans)) * packet_scans;
  for (int i = 0; i < scans; ++i) {
    const double part = static_cast<double>(i) / scans;
    append_mcc_scan(bytes, settings.zero_code + static_cast<int>(std::lround(part * (first_code - settings.zero_code))),
                    0);
  }
  return bytes;
}

}  // namespace focalstage
