#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "devices/natnet/settings.h"

namespace focalstage {

using NatNetBytes = std::vector<std::uint8_t>;

/// Message ids that a client meets (NatNet SDK).
enum class NatNetMessage : std::uint16_t {
  connect = 0,
  server_info = 1,
  request_model = 4,
  model = 5,
  frame = 7,
  keep_alive = 10,
};

struct NatNetVersion {
  int major = 0;
  int minor = 0;

  auto operator<=>(const NatNetVersion&) const = default;
};

/// Whether the layout of this version is known: 3.x and 4.x.
bool natnet_version_known(const NatNetVersion& version);

struct NatNetServer {
  std::string application;
  NatNetVersion version;
  std::uint64_t ticks_per_s = 0;  ///< 0: an older server, which does not tell

  bool operator==(const NatNetServer&) const = default;
};

/// A rigid body as the server wrote it: nothing turned, nothing judged.
struct NatNetBody {
  std::int32_t id = 0;
  std::array<float, 3> position_m{};
  std::array<float, 4> rotation_xyzw{};
  float mean_error_m = 0.0F;
  bool valid = false;

  bool operator==(const NatNetBody&) const = default;
};

struct NatNetFrame {
  std::int32_t number = 0;
  std::vector<NatNetBody> bodies;
  double timestamp_s = 0.0;
  std::uint64_t exposed_ticks = 0;  ///< middle of the exposure; 0: not told
  std::uint64_t sent_ticks = 0;
  bool models_changed = false;

  bool operator==(const NatNetFrame&) const = default;
};

struct NatNetName {
  std::int32_t id = 0;
  std::string name;

  bool operator==(const NatNetName&) const = default;
};

/// The names of rigid bodies. Without sizes a description of unknown layout hides those after it: `whole` is false
/// then.
struct NatNetNames {
  std::vector<NatNetName> bodies;
  bool whole = true;

  bool operator==(const NatNetNames&) const = default;
};

/// A datagram taken apart; the payload is the datagram's own bytes.
struct NatNetDatagram {
  std::uint16_t id = 0;
  std::span<const std::uint8_t> payload;
};

/// "natnet.damaged" unless the datagram has the length that its header tells.
Result<NatNetDatagram> read_datagram(std::span<const std::uint8_t> bytes);

/// Payloads of one message each: "natnet.damaged", naming the byte, where one ends early or contradicts itself.
Result<NatNetServer> read_server(std::span<const std::uint8_t> payload);
Result<NatNetFrame> read_frame(std::span<const std::uint8_t> payload, const NatNetVersion& version);
Result<NatNetNames> read_names(std::span<const std::uint8_t> payload, const NatNetVersion& version,
                               NatNetDescriptionSize size);

/// What a client sends.
NatNetBytes ping_message();
NatNetBytes model_request_message();
NatNetBytes keep_alive_message();

}  // namespace focalstage
