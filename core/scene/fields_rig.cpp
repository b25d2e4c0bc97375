#include "core/scene/fields_rig.h"

#include <algorithm>

namespace focalstage {

bool LensResponseCodec::read(Reading& reading, const Value& value, LensResponse& out, const Rule& rule) {
  if (!Codec<LensResponse>::read(reading, value, out, rule)) return false;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto earlier = out.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::none_of(out.begin(), earlier, [&](const LensHarmonic& h) { return h.harmonic == out[i].harmonic; })) {
      continue;
    }
    const Reading::Step step(reading, i);
    return reading.fail_at("harmonic", "project.duplicate",
                           "harmonic " + std::to_string(out[i].harmonic) + " is listed twice", "list each once");
  }
  return true;
}

bool Table<Glasses>::check(Reading& reading, const Glasses& glasses) {
  if (glasses.lens_range_d[0] < glasses.lens_range_d[1]) return true;
  return reading.fail_at("lens_range_d", "project.range", "does not rise", "write the lower power first");
}

// Design section 4: uniform samples from the minimum, strictly monotonic between the extrema. A period that turns more
// than twice would show a slice at more than one instant per eye.
bool Table<MeasuredWaveform>::check(Reading& reading, const MeasuredWaveform& waveform) {
  const std::vector<double>& power = waveform.power_d;
  if (waveform.drive_a.size() != power.size()) {
    return reading.fail_at(
        "drive_a", "project.count",
        "has " + std::to_string(waveform.drive_a.size()) + " samples, power_d has " + std::to_string(power.size()),
        "give as many drive samples as power samples");
  }
  const auto top = std::max_element(power.begin(), power.end());
  const bool rises = std::adjacent_find(power.begin(), top + 1, std::greater_equal<>()) == top + 1;
  const bool falls = std::adjacent_find(top, power.end(), std::less_equal<>()) == power.end();
  if (rises && falls && top != power.begin() && power.back() > power.front()) return true;
  return reading.fail_at("power_d", "project.order",
                         "is not one rise from the minimum to the maximum and one fall back",
                         "start the period at its minimum, and smooth the measurement until it is strictly monotonic "
                         "between minimum and maximum");
}

bool WaveformCodec::read(Reading& reading, const Value& value, Waveform& out, const Rule& rule) {
  out.reset();
  if (value.text() && *value.text() == "sine") return true;
  if (value.text()) return not_one_of(reading, *value.text(), {"sine"});
  if (!value.object()) return reading.wrong_type(value, "\"sine\" or a measured period");
  return Codec<MeasuredWaveform>::read(reading, value, out.emplace(), rule);
}

Value WaveformCodec::write(const Waveform& waveform) {
  return waveform ? Codec<MeasuredWaveform>::write(*waveform) : Value("sine");
}

bool Table<Sweep>::check(Reading& reading, const Sweep& sweep) {
  if (sweep.min_power_d < sweep.max_power_d) return true;
  return reading.fail_at("max_power_d", "project.range", "is not above min_power_d", "raise it, or lower min_power_d");
}

namespace {

/// From black to white, never falling.
bool transfer_rises(Reading& reading, const std::vector<double>& transfer) {
  if (transfer.empty()) return true;
  if (transfer.size() < 2 || transfer.front() != 0.0 || transfer.back() != 1.0) {
    return reading.fail_at("transfer", "project.range", "does not run from 0 to 1",
                           "take the light of code 0 off every value, and divide by that of the last");
  }
  if (std::is_sorted(transfer.begin(), transfer.end())) return true;
  return reading.fail_at("transfer", "project.order", "falls from one code to the next",
                         "smooth the measurement until it never falls");
}

}  // namespace

bool Table<Projector>::check(Reading& reading, const Projector& projector) {
  if (!transfer_rises(reading, projector.transfer)) return false;
  const std::size_t count = projector.distortion.size();
  if (count == 0 || count == 4 || count == 5 || count == 8) return true;
  return reading.fail_at("distortion", "project.count", "has " + std::to_string(count) + " coefficients",
                         "write 0, 4, 5 or 8 of them, in OpenCV's order");
}

}  // namespace focalstage
