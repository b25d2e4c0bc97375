#include <cstddef>
#include <cstdint>
#include <span>

#include "devices/natnet/packets.h"

// The first byte chooses the server's version; the rest is a datagram.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace focalstage;
  if (size == 0) return 0;
  const NatNetVersion version{data[0] % 2 == 0 ? 3 : 4, data[0] / 2 % 3};
  const auto datagram = read_datagram(std::span(data, size).subspan(1));
  if (!datagram) return 0;
  (void)read_server(datagram->payload);
  (void)read_frame(datagram->payload, version);
  for (const auto size_place : {NatNetDescriptionSize::after_type, NatNetDescriptionSize::none}) {
    (void)read_names(datagram->payload, version, size_place);
  }
  return 0;
}
