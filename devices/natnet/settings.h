#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace focalstage {

enum class NatNetCast { multicast, unicast };

/// Which axis of the stream is up. Poses are handed on with +Y up.
enum class NatNetAxes { y_up, z_up };

/// Where a server of 4.1 or later puts the size of each model description.
enum class NatNetDescriptionSize { after_type, none };

/// A NatNet server and how this site streams. Addresses are IPv4 in dots.
struct NatNetSettings {
  std::string server = "127.0.0.1";
  std::string local = "0.0.0.0";  ///< our own address in the server's network; 0.0.0.0: the system chooses
  std::uint16_t command_port = 1510;
  std::uint16_t data_port = 1511;  ///< unicast with 0: frames come to the socket of commands alone
  NatNetCast cast = NatNetCast::multicast;
  std::string group = "239.255.42.99";
  NatNetAxes axes = NatNetAxes::y_up;
  NatNetDescriptionSize description_size = NatNetDescriptionSize::after_type;
  std::map<std::int32_t, std::string> names;  ///< by id; these come before the server's own
  double ping_s = 0.25;                       ///< between requests that were not answered
  double keep_alive_s = 1.0;
  double silence_s = 0.1;  ///< without a good frame for so long, the stream is lost
};

}  // namespace focalstage
