#include "editor/cli/self_test_output.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "core/base/number_words.h"
#include "core/schedule/lens_response.h"
#include "editor/cli/output.h"

namespace focalstage {
namespace {

Value value_of(const Estimate& estimate) {
  Value value;
  value.set("value", estimate.value);
  value.set("spread", estimate.spread);
  return value;
}

Value value_of(const MeasuredEye& eye) {
  Value value;
  value.set("shutter_close_ms", value_of(eye.shutter_close_ms));
  value.set("shutter_open_ms", value_of(eye.shutter_open_ms));
  value.set("rest_power_d", value_of(eye.rest_power_d));
  Value::Array lens;
  for (const MeasuredHarmonic& one : eye.lens) {
    Value item;
    item.set("harmonic", one.harmonic);
    item.set("gain_d_per_a", value_of(one.gain_d_per_a));
    item.set("phase_deg", value_of(one.phase_deg));
    lens.push_back(std::move(item));
  }
  value.set("lens", std::move(lens));
  return value;
}

using Rows = std::vector<std::vector<std::string>>;

void add(Rows& rows, const std::string& what, const Estimate& estimate, int decimals, const char* unit) {
  rows.push_back({what, fixed_text(estimate.value, decimals), "±", fixed_text(estimate.spread, decimals), unit});
}

void add_eye(Rows& rows, const std::string& side, const MeasuredEye& eye) {
  add(rows, side + " shutter opens in", eye.shutter_open_ms, 3, "ms");
  add(rows, side + " shutter closes in", eye.shutter_close_ms, 3, "ms");
  add(rows, side + " lens at rest", eye.rest_power_d, 3, "D");
  for (const MeasuredHarmonic& one : eye.lens) {
    const std::string name = side + " lens, harmonic " + std::to_string(one.harmonic);
    add(rows, name + ", gain", one.gain_d_per_a, 2, "D/A");
    if (one.harmonic > 0) add(rows, name + ", phase", one.phase_deg, 2, "degrees");
  }
}

/// Lenses on one channel get one current, halfway between what each would need.
std::string apart_text(const PerEye<MeasuredEye>& eye) {
  const auto swept = [](const MeasuredEye& one) {
    const auto found = std::ranges::find(one.lens, 1, &MeasuredHarmonic::harmonic);
    return found == one.lens.end() ? std::optional<LensHarmonic>()
                                   : LensHarmonic{1, found->gain_d_per_a.value, found->phase_deg.value, {}};
  };
  const std::optional<LensHarmonic> left = swept(eye.left), right = swept(eye.right);
  if (!left || !right) return "";
  return "On one channel, each lens would stray by " + fixed_text(strays(*left, *right), 4) +
         " D per dioptre that is swept.\n";
}

}  // namespace

Value value_of(const RigMeasurement& measurement) {
  Value value;
  value.set("frequency_hz", measurement.frequency_hz);
  value.set("unix_s", static_cast<double>(measurement.unix_s));
  value.set("latency_ms", value_of(measurement.latency_ms));
  value.set("light_rise_ms", value_of(measurement.light_rise_ms));
  value.set("left", value_of(measurement.eye.left));
  value.set("right", value_of(measurement.eye.right));
  return value;
}

std::string measurement_table(const RigMeasurement& measurement) {
  Rows rows;
  add(rows, "projector latency", measurement.latency_ms, 4, "ms");
  add(rows, "light rises in", measurement.light_rise_ms, 4, "ms");
  add_eye(rows, "left", measurement.eye.left);
  add_eye(rows, "right", measurement.eye.right);
  return table_text({{"measured"}, {"value", true}, {""}, {"spread", true}, {"unit"}}, rows) +
         apart_text(measurement.eye);
}

}  // namespace focalstage
