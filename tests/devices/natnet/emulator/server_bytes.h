#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace focalstage::natnet_emulator {

using Bytes = std::vector<std::uint8_t>;

/// What the emulated server speaks.
struct Dialect {
  int major = 4;
  int minor = 1;
  bool stamp = true;              ///< 4.x: the stamp of precision at the end of a frame
  bool end_tag = true;            ///< of a frame
  bool description_sizes = true;  ///< 4.1: behind the type
};

struct Body {
  std::int32_t id = 0;
  std::string name;
  std::array<float, 3> position{};
  std::array<float, 4> xyzw{0.0F, 0.0F, 0.0F, 1.0F};
  float error = 0.0F;
  std::int16_t param = 1;  ///< bit 0: tracked
};

struct Moment {
  std::int32_t number = 0;
  std::vector<Body> bodies;
  bool crowded = false;   ///< marker sets, skeletons, assets, force plates and devices around the bodies
  bool labelled = false;  ///< the sheet's one labelled marker
  double timestamp = 0.0;
  std::uint64_t exposed = 0;
  std::uint64_t received = 0;
  std::uint64_t sent = 0;
  std::int16_t param = 0;  ///< bit 1: models changed
};

/// Whole datagrams.
Bytes server_info(const Dialect& dialect, std::uint64_t ticks_per_s, std::uint16_t data_port, bool multicast);
Bytes frame(const Dialect& dialect, const Moment& moment);
Bytes descriptions(const Dialect& dialect, const std::vector<Body>& bodies);

}  // namespace focalstage::natnet_emulator
