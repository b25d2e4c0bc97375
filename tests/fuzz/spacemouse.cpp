#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "devices/input/packets.h"

// Reports one after the other, each with its length before it.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace focalstage;
  std::span rest(data, size);
  SpaceMouseAxes axes({});
  for (double now_s = 1.0; !rest.empty(); now_s += 0.01) {
    const std::size_t length = std::min<std::size_t>(rest[0] % 20, rest.size() - 1);
    const auto report = spacemouse_report(rest.subspan(1, length));
    rest = rest.subspan(1 + length);
    if (report) axes.take(*report, now_s);
    const Deflection deflection = axes.deflection(now_s);
    for (int i = 0; i < 3; ++i) {
      if (!(std::abs(deflection.push[i]) <= 1.0) || !(std::abs(deflection.turn[i]) <= 1.0)) std::abort();
    }
  }
  return 0;
}
