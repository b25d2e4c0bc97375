#include "io/protocol/convert.h"

namespace focalstage {

namespace {

v1::Measured message_from(const Estimate& measured) {
  v1::Measured message;
  message.set_value(measured.value);
  message.set_spread(measured.spread);
  return message;
}

Estimate measured_from(const v1::Measured& message) { return {message.value(), message.spread()}; }

v1::MeasuredEye message_from(const MeasuredEye& eye) {
  v1::MeasuredEye message;
  *message.mutable_shutter_close_ms() = message_from(eye.shutter_close_ms);
  *message.mutable_shutter_open_ms() = message_from(eye.shutter_open_ms);
  *message.mutable_rest_power_d() = message_from(eye.rest_power_d);
  for (const MeasuredHarmonic& harmonic : eye.lens) {
    v1::MeasuredHarmonic* out = message.add_lens();
    out->set_harmonic(harmonic.harmonic);
    *out->mutable_gain_d_per_a() = message_from(harmonic.gain_d_per_a);
    *out->mutable_phase_deg() = message_from(harmonic.phase_deg);
  }
  return message;
}

MeasuredEye eye_from(const v1::MeasuredEye& message) {
  MeasuredEye eye{measured_from(message.shutter_close_ms()),
                  measured_from(message.shutter_open_ms()),
                  measured_from(message.rest_power_d()),
                  {}};
  for (const v1::MeasuredHarmonic& harmonic : message.lens()) {
    eye.lens.push_back(
        {harmonic.harmonic(), measured_from(harmonic.gain_d_per_a()), measured_from(harmonic.phase_deg())});
  }
  return eye;
}

}  // namespace

v1::RigMeasurement message_from(const RigMeasurement& measurement) {
  v1::RigMeasurement message;
  message.set_frequency_hz(measurement.frequency_hz);
  message.set_unix_s(measurement.unix_s);
  *message.mutable_latency_ms() = message_from(measurement.latency_ms);
  *message.mutable_light_rise_ms() = message_from(measurement.light_rise_ms);
  *message.mutable_left() = message_from(measurement.eye.left);
  *message.mutable_right() = message_from(measurement.eye.right);
  return message;
}

RigMeasurement measurement_from(const v1::RigMeasurement& message) {
  RigMeasurement measurement;
  measurement.frequency_hz = message.frequency_hz();
  measurement.unix_s = message.unix_s();
  measurement.latency_ms = measured_from(message.latency_ms());
  measurement.light_rise_ms = measured_from(message.light_rise_ms());
  measurement.eye.left = eye_from(message.left());
  measurement.eye.right = eye_from(message.right());
  return measurement;
}

}  // namespace focalstage
