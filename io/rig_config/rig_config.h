#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/base/sides.h"
#include "core/scene/project.h"
#include "io/rig_config/light_config.h"
#include "io/rig_config/tracker_config.h"

namespace focalstage {

enum class RigKind { sim, devices };

struct DevicesConfig {
  std::optional<DeviceConfig> projector;
  std::optional<DeviceConfig> lens_drive;
  std::optional<DeviceConfig> trigger_board;
  std::optional<TrackerConfig> tracker;
  std::optional<LightSensorConfig> light_sensor;

  bool operator==(const DevicesConfig&) const = default;
};

/// A lens at one frequency; a lag is a negative phase.
struct ResponsePoint {
  double frequency_hz = 0.0;
  double gain_d_per_a = 0.0;
  double phase_deg = 0.0;

  bool operator==(const ResponsePoint&) const = default;
};

/// What was measured of a rig.
struct MeasuredRig {
  Projector projector;  ///< name, model, size, rate, bits, color and latency; the rest is a project's
  Glasses glasses;      ///< without the lens response
  PerEye<std::vector<ResponsePoint>> response;  ///< by rising frequency, the first at 0

  bool operator==(const MeasuredRig&) const = default;
};

/// What may be given out, whatever a show asks.
struct LimitsConfig {
  double lens_current_max_a = 0.29;
  double shutter_changes_per_s_max = 200.0;
  double light_share_max = 0.8;

  bool operator==(const LimitsConfig&) const = default;
};

/// Who may reach the runtime from where, and how much of it one may take.
struct NetworkConfig {
  std::filesystem::path certificate;  ///< with `key` and `client_ca`: mutual TLS, also on loopback
  std::filesystem::path key;
  std::filesystem::path client_ca;
  std::optional<bool> reflection;  ///< unsaid: on loopback without certificates alone
  double push_bytes_per_s = 1e9;
  double calls_per_s = 500.0;
  int message_bytes_max = 2 << 20;
  int connections_max = 64;
  int connections_per_peer_max = 32;
  int streams_per_connection_max = 32;

  bool operator==(const NetworkConfig&) const = default;
};

struct Rights {
  bool watch = false;
  bool push = false;
  bool control = false;

  bool operator==(const Rights&) const = default;
};

/// A client known by its certificate's common name or fingerprint, or by both.
struct ClientConfig {
  std::string name;
  std::string fingerprint;  ///< SHA-256 of the certificate, lower-case hex
  Rights rights;

  bool operator==(const ClientConfig&) const = default;
};

struct OscConfig {
  std::string listen;
  std::string prefix = "/focalstage";
  std::vector<std::string> peers;  ///< IP addresses beside loopback
  bool despite_lease = false;

  bool operator==(const OscConfig&) const = default;
};

enum class LogLevel { debug, info, warning, error };

/// The runtime's configuration, rig.json. What the file does not say is as it is here.
struct RigConfig {
  std::string name;
  RigKind kind = RigKind::sim;
  DevicesConfig devices;
  std::optional<MeasuredRig> measured;
  LimitsConfig limits;
  std::string listen = "127.0.0.1:50371";
  NetworkConfig network;
  std::vector<ClientConfig> clients;
  std::string metrics_listen;  ///< empty: none
  std::optional<OscConfig> osc;
  std::filesystem::path store;  ///< empty: the user's own
  LogLevel log_level = LogLevel::info;
  bool log_json = false;

  bool operator==(const RigConfig&) const = default;
};

/// The published schema, io/schema/rig.schema.json.
std::string_view rig_schema();

/// Reads a configuration; its paths are relative to the file's folder. Faults "json.*", "rig.schema", "rig.config",
/// "file.*" name the file and the place in it.
Result<RigConfig> load_rig_config(const std::filesystem::path& file);

/// The same from text; `source` names it in faults.
Result<RigConfig> parse_rig_config(std::string_view text, const std::string& source,
                                   const std::filesystem::path& folder = {});

}  // namespace focalstage
