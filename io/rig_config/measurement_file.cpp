#include "io/rig_config/measurement_file.h"

#include <string_view>

#include "io/files/files.h"
#include "io/json/checked_value.h"
#include "io/json/json.h"
#include "io/project/validate.h"

namespace focalstage {

namespace {

constexpr std::uint64_t size_limit = 1u << 20;

constexpr std::string_view schema = R"({
  "type": "object", "additionalProperties": false,
  "required": ["focalstage_measured", "rig", "unix_s", "frequency_hz", "latency_ms", "light_rise_ms", "left", "right"],
  "properties": {
    "focalstage_measured": { "const": 1 },
    "rig": { "type": "string" },
    "unix_s": { "type": "number" },
    "frequency_hz": { "type": "number", "exclusiveMinimum": 0 },
    "latency_ms": { "$ref": "#/definitions/measured" },
    "light_rise_ms": { "$ref": "#/definitions/measured" },
    "left": { "$ref": "#/definitions/eye" },
    "right": { "$ref": "#/definitions/eye" }
  },
  "definitions": {
    "measured": { "type": "object", "additionalProperties": false, "required": ["value", "spread"],
                  "properties": { "value": { "type": "number" }, "spread": { "type": "number", "minimum": 0 } } },
    "eye": { "type": "object", "additionalProperties": false,
             "required": ["shutter_close_ms", "shutter_open_ms", "rest_power_d", "lens"],
             "properties": {
               "shutter_close_ms": { "$ref": "#/definitions/measured" },
               "shutter_open_ms": { "$ref": "#/definitions/measured" },
               "rest_power_d": { "$ref": "#/definitions/measured" },
               "lens": { "type": "array", "minItems": 1, "maxItems": 100, "items": {
                 "type": "object", "additionalProperties": false, "required": ["harmonic", "gain_d_per_a", "phase_deg"],
                 "properties": { "harmonic": { "type": "integer", "minimum": 0, "maximum": 99 },
                                 "gain_d_per_a": { "$ref": "#/definitions/measured" },
                                 "phase_deg": { "$ref": "#/definitions/measured" } } } } } }
  }
})";

Value value_of(const Estimate& measured) {
  Value value;
  value.set("value", measured.value);
  value.set("spread", measured.spread);
  return value;
}

Value value_of(const MeasuredEye& eye) {
  Value value;
  value.set("shutter_close_ms", value_of(eye.shutter_close_ms));
  value.set("shutter_open_ms", value_of(eye.shutter_open_ms));
  value.set("rest_power_d", value_of(eye.rest_power_d));
  Value::Array lens;
  for (const MeasuredHarmonic& harmonic : eye.lens) {
    Value item;
    item.set("harmonic", harmonic.harmonic);
    item.set("gain_d_per_a", value_of(harmonic.gain_d_per_a));
    item.set("phase_deg", value_of(harmonic.phase_deg));
    lens.push_back(std::move(item));
  }
  value.set("lens", std::move(lens));
  return value;
}

Estimate measured_at(const Value& object, std::string_view key) {
  const Value& value = *object.find(key);
  return {number_of(value, "value"), number_of(value, "spread")};
}

MeasuredEye eye_at(const Value& object, std::string_view key) {
  const Value& value = *object.find(key);
  return {measured_at(value, "shutter_close_ms"), measured_at(value, "shutter_open_ms"),
          measured_at(value, "rest_power_d"), list_of<MeasuredHarmonic>(value, "lens", [](const Value& item) {
            return MeasuredHarmonic{static_cast<int>(number_of(item, "harmonic")), measured_at(item, "gain_d_per_a"),
                                    measured_at(item, "phase_deg")};
          })};
}

}  // namespace

std::string measurement_text(const KeptMeasurement& kept) {
  const RigMeasurement& measurement = kept.measurement;
  Value value;
  value.set("focalstage_measured", 1);
  value.set("rig", kept.rig);
  value.set("unix_s", static_cast<double>(measurement.unix_s));
  value.set("frequency_hz", measurement.frequency_hz);
  value.set("latency_ms", value_of(measurement.latency_ms));
  value.set("light_rise_ms", value_of(measurement.light_rise_ms));
  value.set("left", value_of(measurement.eye.left));
  value.set("right", value_of(measurement.eye.right));
  return write_json(value) + "\n";
}

Result<KeptMeasurement> parse_measurement(std::string_view text, const std::string& source) {
  const auto value = parse_checked(text, source, size_limit, schema, "measured");
  if (!value) return value.fault();
  KeptMeasurement kept;
  kept.rig = text_of(*value, "rig");
  kept.measurement.unix_s = static_cast<std::int64_t>(number_of(*value, "unix_s"));
  kept.measurement.frequency_hz = number_of(*value, "frequency_hz");
  kept.measurement.latency_ms = measured_at(*value, "latency_ms");
  kept.measurement.light_rise_ms = measured_at(*value, "light_rise_ms");
  kept.measurement.eye = {eye_at(*value, "left"), eye_at(*value, "right")};
  return kept;
}

Result<std::optional<KeptMeasurement>> load_measurement(const std::filesystem::path& file) {
  const auto bytes = read_file(file, size_limit);
  if (!bytes) {
    if (bytes.fault().code == "file.missing") return std::optional<KeptMeasurement>();
    return bytes.fault();
  }
  const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  Result<KeptMeasurement> kept = parse_measurement(text, file.string());
  if (!kept) return kept.fault();
  return std::optional<KeptMeasurement>(std::move(*kept));
}

Status save_measurement(const std::filesystem::path& file, const KeptMeasurement& kept) {
  return write_file_atomically(file, measurement_text(kept));
}

}  // namespace focalstage
