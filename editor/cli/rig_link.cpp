#include "editor/cli/rig_link.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "core/base/number_words.h"
#include "editor/cli/output.h"

namespace focalstage {
namespace {

constexpr std::chrono::milliseconds connect_deadline{3000};
constexpr std::array<const char*, 3> eye_names{"left", "right", "both"};

std::string eye_name(int eye) { return eye >= 0 && eye < 3 ? eye_names[static_cast<std::size_t>(eye)] : "?"; }

/// What came of it is null where the rig can't see its light.
Value value_of(const SlotReport& slot) {
  const auto seen = [&](Value value) { return slot.unmeasured ? Value() : value; };
  Value value;
  value.set("slot", slot.slot);
  value.set("image", slot.image);
  value.set("eye", eye_name(slot.eye));
  value.set("measured", !slot.unmeasured);
  value.set("asked_power_d", slot.asked_power_d);
  value.set("delivered_power_d", seen(slot.delivered_power_d));
  value.set("asked_smear_d", slot.asked_smear_d);
  value.set("delivered_smear_d", seen(slot.delivered_smear_d));
  value.set("asked_s", slot.asked_s);
  value.set("delivered_s", seen(slot.delivered_s));
  value.set("right_image", seen(slot.right_image));
  value.set("own_shutter_open", seen(slot.own_shutter_open));
  value.set("other_shutter_closed", seen(slot.other_shutter_closed));
  value.set("delivered", seen(slot.delivered));
  value.set("exposures", seen(static_cast<double>(slot.exposures)));
  value.set("missed", seen(static_cast<double>(slot.missed)));
  return value;
}

std::string signed_number(double value, int decimals) {
  const std::string text = fixed_text(value, decimals);
  return text.starts_with('-') ? text : "+" + text;
}

const char* yes_no(bool yes) { return yes ? "yes" : "NO"; }

std::vector<std::string> row_of(const SlotReport& slot) {
  const double off_us = (slot.delivered_s - slot.asked_s) * 1e6;
  if (slot.unmeasured) {
    return {std::to_string(slot.slot),
            eye_name(slot.eye),
            std::to_string(slot.image),
            signed_number(slot.asked_power_d, 3),
            "-",
            fixed_text(slot.asked_s * 1e3, 3),
            "-",
            "-",
            "-",
            "-",
            "-",
            "-",
            "not measured"};
  }
  return {std::to_string(slot.slot),
          eye_name(slot.eye),
          std::to_string(slot.image),
          signed_number(slot.asked_power_d, 3),
          signed_number(slot.delivered_power_d, 3),
          fixed_text(slot.asked_s * 1e3, 3),
          signed_number(off_us, 1),
          yes_no(slot.right_image),
          yes_no(slot.own_shutter_open),
          yes_no(slot.other_shutter_closed),
          std::to_string(slot.exposures),
          std::to_string(slot.missed),
          yes_no(slot.delivered)};
}

}  // namespace

Result<RigClient> connect_to_rig(const std::string& host_port) {
  return RigClient::connect(host_port, connect_deadline);
}

void add_rig_option(CLI::App& app, std::string& host_port) {
  host_port = default_rig_address;
  app.add_option("--to", host_port, "the rig's address")->type_name("HOST:PORT")->capture_default_str();
}

Value value_of(const DeviceReport& device) {
  Value value;
  value.set("driver", device.driver);
  value.set("model", device.model);
  value.set("serial", device.serial);
  value.set("address", device.address);
  return value;
}

Value value_of(const RigState& state) {
  Value value;
  value.set("state", state.state);
  value.set("show_sha256", state.show_sha256);
  value.set("sweeps", static_cast<double>(state.sweeps));
  value.set("missed_exposures", static_cast<double>(state.missed_exposures));
  value.set("lens_phase", state.lens_phase);
  value.set("temperature_c", state.temperature_c);
  value.set("fault", state.fault);
  value.set("holder", state.holder);
  value.set("frame", state.frame);
  value.set("late_sweeps", static_cast<double>(state.late_sweeps));
  value.set("pose_to_light_ms", state.pose_to_light_ms);
  Value::Array lateness;
  for (const LatenessBin& bin : state.lateness) {
    Value item;
    item.set("up_to_us", std::isfinite(bin.up_to_us) ? Value(bin.up_to_us) : Value());
    item.set("sweeps", static_cast<double>(bin.sweeps));
    lateness.push_back(std::move(item));
  }
  value.set("lateness", std::move(lateness));
  Value::Array parts;
  for (const PartReport& part : state.parts) {
    Value item = value_of(part.device);
    item.set("phase", part.phase);
    item.set("fault", part.fault);
    parts.push_back(std::move(item));
  }
  value.set("parts", std::move(parts));
  Value::Array slots;
  for (const SlotReport& slot : state.slots) slots.push_back(value_of(slot));
  value.set("slots", std::move(slots));
  return value;
}

std::string state_line(const RigState& state) {
  std::string text = state.state + ": " + std::to_string(state.sweeps) + " sweeps, " +
                     std::to_string(state.missed_exposures) + " exposures missed, " +
                     std::to_string(state.late_sweeps) + " sweeps late, frame " + std::to_string(state.frame);
  if (!state.show_sha256.empty()) text += " of show " + state.show_sha256.substr(0, 12);
  if (state.pose_to_light_ms > 0.0) {
    text += ", " + std::to_string(std::lround(state.pose_to_light_ms)) + " ms from pose to light";
  }
  if (!state.holder.empty()) text += ", held by " + state.holder;
  return text + "\n";
}

std::string state_text(const RigState& state) {
  std::string text = state_line(state);
  if (!state.fault.empty()) text += "latched: " + state.fault + " (focalstage rig go clears it)\n";
  for (const PartReport& part : state.parts) {
    const std::string which = part.device.serial.empty() ? "" : " " + part.device.serial;
    text += part.device.driver + which + ": " + part.phase + (part.fault.empty() ? "" : ", " + part.fault) + "\n";
  }
  if (state.slots.empty()) return text;
  std::vector<std::vector<std::string>> rows;
  for (const SlotReport& slot : state.slots) rows.push_back(row_of(slot));
  const auto delivered =
      std::count_if(state.slots.begin(), state.slots.end(), [](const auto& s) { return s.delivered; });
  text += "\n" + table_text({{"slot", true},
                             {"eye"},
                             {"image", true},
                             {"asked D", true},
                             {"got D", true},
                             {"start ms", true},
                             {"off us", true},
                             {"image ok"},
                             {"own open"},
                             {"other shut"},
                             {"shown", true},
                             {"missed", true},
                             {"delivered"}},
                            rows);
  if (std::ranges::all_of(state.slots, &SlotReport::unmeasured)) {
    return text + "\nthis rig can't see its light: no slot was measured\n";
  }
  return text + "\n" + std::to_string(delivered) + " of " + std::to_string(rows.size()) + " slots delivered\n";
}

}  // namespace focalstage
