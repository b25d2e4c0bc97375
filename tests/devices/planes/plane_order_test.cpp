#include "devices/planes/plane_order.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace focalstage {
namespace {

/// A plane's name in TI's user guide.
std::string name_of(int plane) { return "GRB"[plane / 8] + std::to_string(plane % 8); }

std::string names_of(int bits, int number) {
  const PlaneSpan planes = planes_of(bits, number);
  std::string names;
  for (int i = 0; i < planes.count; ++i) names += (i > 0 ? " " : "") + name_of(planes.first + i);
  return names;
}

TEST_CASE("the planes of TI's patterns") {
  const std::vector<int> counts{24, 12, 8, 6, 4, 4, 3, 3};
  for (int bits = 1; bits <= 8; ++bits) CHECK(most_patterns(bits) == counts[static_cast<std::size_t>(bits - 1)]);
  CHECK(names_of(1, 0) == "G0");
  CHECK(names_of(1, 8) == "R0");
  CHECK(names_of(1, 23) == "B7");
  CHECK(names_of(2, 11) == "B6 B7");
  CHECK(names_of(3, 2) == "G6 G7 R0");
  CHECK(names_of(4, 3) == "R4 R5 R6 R7");
  CHECK(names_of(5, 0) == "G1 G2 G3 G4 G5");
  CHECK(names_of(5, 1) == "G7 R0 R1 R2 R3");
  CHECK(names_of(5, 2) == "R5 R6 R7 B0 B1");
  CHECK(names_of(5, 3) == "B3 B4 B5 B6 B7");
  CHECK(names_of(6, 1) == "G6 G7 R0 R1 R2 R3");
  CHECK(names_of(7, 0) == "G1 G2 G3 G4 G5 G6 G7");
  CHECK(names_of(7, 2) == "B1 B2 B3 B4 B5 B6 B7");
  CHECK(names_of(8, 1) == "R0 R1 R2 R3 R4 R5 R6 R7");
}

TEST_CASE("no plane is used twice, and none lies outside the pixel") {
  for (int bits = 1; bits <= 8; ++bits) {
    std::uint32_t used = 0;
    for (int n = 0; n < most_patterns(bits); ++n) {
      const PlaneSpan planes = planes_of(bits, n);
      const std::uint32_t mask = ((1U << planes.count) - 1U) << planes.first;
      CHECK((used & mask) == 0U);
      CHECK((mask >> 24) == 0U);
      used |= mask;
    }
  }
}

TEST_CASE("a pixel and its planes") {
  CHECK(pixel_of(1U << 0) == 0x000100U);
  CHECK(pixel_of(1U << 8) == 0x010000U);
  CHECK(pixel_of(1U << 16) == 0x000001U);
  CHECK(pixel_of(1U << 23) == 0x000080U);
  for (int plane = 0; plane < 24; ++plane) CHECK(planes_in(pixel_of(1U << plane)) == 1U << plane);
}

}  // namespace
}  // namespace focalstage
