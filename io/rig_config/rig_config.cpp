#include "io/rig_config/rig_config.h"

#include "core/scene/words.h"
#include "io/files/files.h"
#include "io/json/checked_value.h"
#include "io/project/validate.h"
#include "io/rig_config/check_config.h"
#include "io/rig_config/read_light_sensor.h"
#include "io/rig_config/read_tracker.h"

namespace focalstage {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t size_limit = 4u << 20;

void read(const Value& object, std::string_view key, fs::path& into, const fs::path& folder) {
  if (const Value* value = object.find(key)) into = folder / *value->text();
}

void read(const Value& object, std::string_view key, std::optional<DeviceConfig>& into) {
  if (const Value* value = object.find(key)) into = device_from(*value);
}

DevicesConfig devices_from(const Value& value, const fs::path& folder) {
  DevicesConfig devices;
  read(value, "projector", devices.projector);
  read(value, "lens_drive", devices.lens_drive);
  read(value, "trigger_board", devices.trigger_board);
  if (const Value* tracker = value.find("tracker")) devices.tracker = tracker_from(*tracker, folder);
  if (const Value* sensor = value.find("light_sensor")) devices.light_sensor = light_sensor_from(*sensor);
  return devices;
}

ResponsePoint point_from(const Value& value) {
  ResponsePoint point;
  read(value, "frequency_hz", point.frequency_hz);
  read(value, "gain_d_per_a", point.gain_d_per_a);
  read(value, "phase_deg", point.phase_deg);
  return point;
}

Projector projector_from(const Value& value) {
  Projector projector;
  projector.name = "main";
  read(value, "model", projector.model);
  read(value, "width_px", projector.width_px);
  read(value, "height_px", projector.height_px);
  read(value, "frames_per_second", projector.frames_per_second);
  read(value, "bits", projector.bits);
  read(value, "latency_ms", projector.latency_ms);
  if (text_of(value, "color") == "rgb") projector.color = ColorMode::rgb;
  if (text_of(value, "pixel_layout") == word_of(PixelLayout::diamond)) projector.pixel_layout = PixelLayout::diamond;
  return projector;
}

MeasuredRig measured_from(const Value& value) {
  MeasuredRig rig;
  rig.projector = projector_from(*value.find("projector"));
  const Value& glasses = *value.find("glasses");
  read(glasses, "lens_to_pupil_mm", rig.glasses.lens_to_pupil_mm);
  read(glasses, "lens_min_d", rig.glasses.lens_range_d[0]);
  read(glasses, "lens_max_d", rig.glasses.lens_range_d[1]);
  read(glasses, "lens_aperture_mm", rig.glasses.lens_aperture_mm);
  read(glasses, "shutter_close_ms", rig.glasses.shutter_close_ms);
  read(glasses, "shutter_open_ms", rig.glasses.shutter_open_ms);
  const Value& response = *glasses.find("lens_response");
  rig.response.left = list_of<ResponsePoint>(response, "left", point_from);
  rig.response.right = list_of<ResponsePoint>(response, "right", point_from);
  return rig;
}

LimitsConfig limits_from(const Value& value) {
  LimitsConfig limits;
  read(value, "lens_current_max_a", limits.lens_current_max_a);
  read(value, "shutter_changes_per_s_max", limits.shutter_changes_per_s_max);
  read(value, "light_share_max", limits.light_share_max);
  return limits;
}

NetworkConfig network_from(const Value& value, const fs::path& folder) {
  NetworkConfig network;
  read(value, "certificate", network.certificate, folder);
  read(value, "key", network.key, folder);
  read(value, "client_ca", network.client_ca, folder);
  read(value, "reflection", network.reflection);
  read(value, "push_bytes_per_s", network.push_bytes_per_s);
  read(value, "calls_per_s", network.calls_per_s);
  read(value, "message_bytes_max", network.message_bytes_max);
  read(value, "connections_max", network.connections_max);
  read(value, "connections_per_peer_max", network.connections_per_peer_max);
  read(value, "streams_per_connection_max", network.streams_per_connection_max);
  return network;
}

ClientConfig client_from(const Value& value) {
  ClientConfig client;
  read(value, "name", client.name);
  read(value, "fingerprint", client.fingerprint);
  for (const std::string& right : texts_of(value, "rights")) {
    if (right == "watch") client.rights.watch = true;
    if (right == "push") client.rights.push = true;
    if (right == "control") client.rights.control = true;
  }
  return client;
}

OscConfig osc_from(const Value& value) {
  OscConfig osc;
  read(value, "listen", osc.listen);
  read(value, "prefix", osc.prefix);
  read(value, "despite_lease", osc.despite_lease);
  osc.peers = texts_of(value, "peers");
  return osc;
}

void read_log(const Value& value, RigConfig& config) {
  read(value, "json", config.log_json);
  std::string level = "info";
  read(value, "level", level);
  config.log_level = level == "debug"     ? LogLevel::debug
                     : level == "warning" ? LogLevel::warning
                     : level == "error"   ? LogLevel::error
                                          : LogLevel::info;
}

RigConfig config_from(const Value& value, const fs::path& folder) {
  RigConfig config;
  if (const Value* rig = value.find("rig")) {
    read(*rig, "name", config.name);
    if (text_of(*rig, "kind") == "devices") config.kind = RigKind::devices;
  }
  if (const Value* devices = value.find("devices")) config.devices = devices_from(*devices, folder);
  if (const Value* measured = value.find("measured")) config.measured = measured_from(*measured);
  if (const Value* limits = value.find("limits")) config.limits = limits_from(*limits);
  if (const Value* network = value.find("network")) {
    read(*network, "listen", config.listen);
    config.network = network_from(*network, folder);
  }
  config.clients = list_of<ClientConfig>(value, "clients", client_from);
  if (const Value* metrics = value.find("metrics")) read(*metrics, "listen", config.metrics_listen);
  if (const Value* osc = value.find("osc")) config.osc = osc_from(*osc);
  read(value, "store", config.store, folder);
  if (const Value* log = value.find("log")) read_log(*log, config);
  return config;
}

}  // namespace

Result<RigConfig> parse_rig_config(std::string_view text, const std::string& source, const fs::path& folder) {
  const auto value = parse_checked(text, source, size_limit, rig_schema(), "rig");
  if (!value) return value.fault();
  RigConfig config = config_from(*value, folder);
  if (const Status sound = check_config(config); !sound) return in_file(sound.fault(), source);
  return config;
}

Result<RigConfig> load_rig_config(const fs::path& file) {
  const auto bytes = read_file(file, size_limit);
  if (!bytes) return bytes.fault();
  const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  return parse_rig_config(text, file.string(), file.parent_path());
}

}  // namespace focalstage
