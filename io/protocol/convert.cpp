#include "io/protocol/convert.h"

#include <array>
#include <string_view>
#include <utility>

#include "io/json/utf8.h"

namespace focalstage {

namespace {

v1::LensResponse message_from(const LensResponse& response) {
  v1::LensResponse message;
  for (const LensHarmonic& point : response) {
    v1::LensHarmonic* harmonic = message.add_harmonics();
    harmonic->set_harmonic(point.harmonic);
    harmonic->set_gain_d_per_a(point.gain_d_per_a);
    harmonic->set_phase_deg(point.phase_deg);
  }
  return message;
}

LensResponse response_from(const v1::LensResponse& message) {
  LensResponse response;
  for (const v1::LensHarmonic& point : message.harmonics()) {
    LensHarmonic harmonic;
    harmonic.harmonic = point.harmonic();
    harmonic.gain_d_per_a = point.gain_d_per_a();
    harmonic.phase_deg = point.phase_deg();
    response.push_back(harmonic);
  }
  return response;
}

v1::Glasses message_from(const Glasses& glasses) {
  v1::Glasses message;
  message.set_lens_to_pupil_mm(glasses.lens_to_pupil_mm);
  message.set_lens_min_d(glasses.lens_range_d[0]);
  message.set_lens_max_d(glasses.lens_range_d[1]);
  message.set_lens_aperture_mm(glasses.lens_aperture_mm);
  message.set_shutter_close_ms(glasses.shutter_close_ms);
  message.set_shutter_open_ms(glasses.shutter_open_ms);
  *message.mutable_left() = message_from(glasses.lens_response.left);
  *message.mutable_right() = message_from(glasses.lens_response.right);
  return message;
}

Glasses glasses_from(const v1::Glasses& message) {
  Glasses glasses;
  glasses.lens_to_pupil_mm = message.lens_to_pupil_mm();
  glasses.lens_range_d = {message.lens_min_d(), message.lens_max_d()};
  glasses.lens_aperture_mm = message.lens_aperture_mm();
  glasses.shutter_close_ms = message.shutter_close_ms();
  glasses.shutter_open_ms = message.shutter_open_ms();
  glasses.lens_response.left = response_from(message.left());
  glasses.lens_response.right = response_from(message.right());
  return glasses;
}

v1::Projector message_from(const Projector& projector) {
  v1::Projector message;
  message.set_name(projector.name);
  message.set_model(projector.model);
  message.set_width_px(projector.width_px);
  message.set_height_px(projector.height_px);
  message.set_frames_per_second(projector.frames_per_second);
  message.set_bits(projector.bits);
  message.set_color(projector.color == ColorMode::rgb ? v1::COLOR_RGB : v1::COLOR_GRAY);
  message.set_latency_ms(projector.latency_ms);
  const bool diamond = projector.pixel_layout == PixelLayout::diamond;
  message.set_pixel_layout(diamond ? v1::PIXEL_LAYOUT_DIAMOND : v1::PIXEL_LAYOUT_SQUARE);
  return message;
}

Projector projector_from(const v1::Projector& message) {
  Projector projector;
  projector.name = message.name();
  projector.model = message.model();
  projector.width_px = message.width_px();
  projector.height_px = message.height_px();
  projector.frames_per_second = message.frames_per_second();
  projector.bits = message.bits();
  projector.color = message.color() == v1::COLOR_RGB ? ColorMode::rgb : ColorMode::gray;
  projector.latency_ms = message.latency_ms();
  const bool diamond = message.pixel_layout() == v1::PIXEL_LAYOUT_DIAMOND;
  projector.pixel_layout = diamond ? PixelLayout::diamond : PixelLayout::square;
  return projector;
}

v1::Device message_from(const DeviceReport& device) {
  // Drivers hand on what devices say of themselves; a message that is no UTF-8 would never be read.
  v1::Device message;
  message.set_driver(valid_utf8(device.driver));
  message.set_model(valid_utf8(device.model));
  message.set_serial(valid_utf8(device.serial));
  message.set_address(valid_utf8(device.address));
  return message;
}

DeviceReport device_from(const v1::Device& message) {
  return {message.driver(), message.model(), message.serial(), message.address()};
}

v1::SlotReport message_from(const SlotReport& slot) {
  v1::SlotReport message;
  message.set_slot(slot.slot);
  message.set_image(slot.image);
  message.set_eye(slot.eye);
  message.set_asked_power_d(slot.asked_power_d);
  message.set_delivered_power_d(slot.delivered_power_d);
  message.set_asked_smear_d(slot.asked_smear_d);
  message.set_delivered_smear_d(slot.delivered_smear_d);
  message.set_asked_s(slot.asked_s);
  message.set_delivered_s(slot.delivered_s);
  message.set_right_image(slot.right_image);
  message.set_own_shutter_open(slot.own_shutter_open);
  message.set_other_shutter_closed(slot.other_shutter_closed);
  message.set_delivered(slot.delivered);
  message.set_exposures(slot.exposures);
  message.set_missed(slot.missed);
  message.set_unmeasured(slot.unmeasured);
  return message;
}

SlotReport slot_from(const v1::SlotReport& message) {
  SlotReport slot;
  slot.slot = message.slot();
  slot.image = message.image();
  slot.eye = message.eye();
  slot.asked_power_d = message.asked_power_d();
  slot.delivered_power_d = message.delivered_power_d();
  slot.asked_smear_d = message.asked_smear_d();
  slot.delivered_smear_d = message.delivered_smear_d();
  slot.asked_s = message.asked_s();
  slot.delivered_s = message.delivered_s();
  slot.right_image = message.right_image();
  slot.own_shutter_open = message.own_shutter_open();
  slot.other_shutter_closed = message.other_shutter_closed();
  slot.delivered = message.delivered();
  slot.exposures = message.exposures();
  slot.missed = message.missed();
  slot.unmeasured = message.unmeasured();
  return slot;
}

/// Which status of gRPC a code of ours travels as; tools that know nothing of us then still understand it.
grpc::StatusCode status_code(std::string_view code) {
  static constexpr std::array<std::pair<std::string_view, grpc::StatusCode>, 8> known{{
      {"rig.held", grpc::StatusCode::ABORTED},
      {"rig.lease", grpc::StatusCode::UNAUTHENTICATED},
      {"rig.damaged", grpc::StatusCode::DATA_LOSS},
      {"rig.disk-full", grpc::StatusCode::RESOURCE_EXHAUSTED},
      {"rig.request", grpc::StatusCode::INVALID_ARGUMENT},
      {"rig.cancelled", grpc::StatusCode::CANCELLED},
      {"rig.unauthorised", grpc::StatusCode::PERMISSION_DENIED},
      {"rig.busy", grpc::StatusCode::RESOURCE_EXHAUSTED},
  }};
  for (const auto& [name, status] : known) {
    if (name == code) return status;
  }
  return grpc::StatusCode::FAILED_PRECONDITION;
}

}  // namespace

v1::RigDescription message_from(const RigDescription& rig) {
  v1::RigDescription message;
  message.set_name(rig.name);
  message.set_kind(rig.kind);
  for (const Projector& projector : rig.projectors) *message.add_projectors() = message_from(projector);
  *message.mutable_glasses() = message_from(rig.glasses);
  message.set_frequency_hz(rig.frequency_hz);
  message.set_lens_current_max_a(rig.lens_current_max_a);
  message.set_shutter_changes_per_s_max(rig.shutter_changes_per_s_max);
  if (rig.measurement) *message.mutable_measurement() = message_from(*rig.measurement);
  return message;
}

RigDescription description_from(const v1::RigDescription& message) {
  RigDescription rig;
  rig.name = message.name();
  rig.kind = message.kind();
  for (const v1::Projector& projector : message.projectors()) rig.projectors.push_back(projector_from(projector));
  rig.glasses = glasses_from(message.glasses());
  rig.frequency_hz = message.frequency_hz();
  rig.lens_current_max_a = message.lens_current_max_a();
  rig.shutter_changes_per_s_max = message.shutter_changes_per_s_max();
  if (message.has_measurement()) rig.measurement = measurement_from(message.measurement());
  return rig;
}

v1::RigState message_from(const RigState& state) {
  v1::RigState message;
  message.set_state(state.state);
  message.set_show_sha256(state.show_sha256);
  message.set_sweeps(state.sweeps);
  message.set_missed_exposures(state.missed_exposures);
  message.set_lens_phase(state.lens_phase);
  message.set_temperature_c(state.temperature_c);
  message.set_fault(valid_utf8(state.fault));
  for (const SlotReport& slot : state.slots) *message.add_slots() = message_from(slot);
  message.set_holder(state.holder);
  message.set_frame(state.frame);
  message.set_late_sweeps(state.late_sweeps);
  for (const LatenessBin& bin : state.lateness) {
    v1::LatenessBin* out = message.add_lateness();
    out->set_up_to_us(bin.up_to_us);
    out->set_sweeps(bin.sweeps);
  }
  message.set_revision(state.revision);
  for (const Temperature& temperature : state.temperatures) {
    v1::Temperature* out = message.add_temperatures();
    out->set_part(temperature.part);
    out->set_celsius(temperature.celsius);
  }
  message.set_pose_to_light_ms(state.pose_to_light_ms);
  for (const PartReport& part : state.parts) {
    v1::Part* out = message.add_parts();
    *out->mutable_device() = message_from(part.device);
    out->set_phase(part.phase);
    out->set_fault(valid_utf8(part.fault));
  }
  return message;
}

RigState state_from(const v1::RigState& message) {
  RigState state;
  state.state = message.state();
  state.show_sha256 = message.show_sha256();
  state.sweeps = message.sweeps();
  state.missed_exposures = message.missed_exposures();
  state.lens_phase = message.lens_phase();
  state.temperature_c = message.temperature_c();
  state.fault = message.fault();
  for (const v1::SlotReport& slot : message.slots()) state.slots.push_back(slot_from(slot));
  state.holder = message.holder();
  state.frame = message.frame();
  state.late_sweeps = message.late_sweeps();
  for (const v1::LatenessBin& bin : message.lateness()) state.lateness.push_back({bin.up_to_us(), bin.sweeps()});
  state.revision = message.revision();
  for (const v1::Temperature& part : message.temperatures())
    state.temperatures.push_back({part.part(), part.celsius()});
  state.pose_to_light_ms = message.pose_to_light_ms();
  for (const v1::Part& part : message.parts()) {
    state.parts.push_back({device_from(part.device()), part.phase(), part.fault()});
  }
  return state;
}

v1::DeviceList message_from(const DeviceListing& listing) {
  v1::DeviceList message;
  for (const DeviceReport& device : listing.devices) *message.add_devices() = message_from(device);
  for (const DriverFailure& failure : listing.failures) {
    v1::DriverFailure* out = message.add_failures();
    out->set_driver(failure.driver);
    *out->mutable_fault() = message_from(failure.fault);
  }
  return message;
}

DeviceListing listing_from(const v1::DeviceList& message) {
  DeviceListing listing;
  for (const v1::Device& device : message.devices()) listing.devices.push_back(device_from(device));
  for (const v1::DriverFailure& failure : message.failures()) {
    listing.failures.push_back({failure.driver(), fault_from(failure.fault())});
  }
  return listing;
}

v1::Fault message_from(const Fault& fault) {
  // Faults quote what they found in files; a message that is no UTF-8 would never be read at the other end.
  v1::Fault message;
  message.set_code(valid_utf8(fault.code));
  message.set_where(valid_utf8(fault.where));
  message.set_message(valid_utf8(fault.message));
  message.set_remedy(valid_utf8(fault.remedy));
  return message;
}

Fault fault_from(const v1::Fault& message) {
  return {message.code(), message.where(), message.message(), message.remedy()};
}

grpc::Status status_from(const Fault& fault) {
  return {status_code(fault.code), describe(fault), message_from(fault).SerializeAsString()};
}

Fault fault_from(const grpc::Status& status, const std::string& address) {
  v1::Fault details;
  if (!status.error_details().empty() && details.ParseFromString(status.error_details()) && !details.code().empty()) {
    return fault_from(details);
  }
  switch (status.error_code()) {
    case grpc::StatusCode::UNAVAILABLE:
      return {"rig.unreachable", address, "no rig answers there",
              "start focalstage-runtime, or give the HOST:PORT where it runs"};
    case grpc::StatusCode::DEADLINE_EXCEEDED:
      return {"rig.unreachable", address, "the rig did not answer in time", "look at the rig's log"};
    case grpc::StatusCode::CANCELLED:
      return {"rig.cancelled", address, "the call was cancelled", ""};
    default:
      return {"rig.refused", address, status.error_message(), "look at the rig's log"};
  }
}

}  // namespace focalstage
