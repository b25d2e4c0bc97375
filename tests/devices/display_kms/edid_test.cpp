#include "devices/display_kms/edid.h"

#include <doctest/doctest.h>

#include <random>

#include "tests/devices/display_kms/fake_edid.h"

namespace focalstage {
namespace {

TEST_CASE("who a display is") {
  const auto bytes = edid_of("TXN", 0x4500, 17, "DLP4500", "A17");
  CHECK(parse_edid(bytes) == EdidIdentity{"TXN", 0x4500, "DLP4500", "A17"});
  CHECK(describe(*parse_edid(bytes)) == "TXN 17664 'DLP4500' A17");
  CHECK(parse_edid(edid_of("TXN", 1, 17, "", ""))->serial == "17");
  CHECK(parse_edid(edid_of("TXN", 1, 0, "", ""))->serial.empty());
  CHECK(parse_edid(edid_of("TXN", 1, 4000000000U, "THIRTEEN CHAR", ""))->name == "THIRTEEN CHAR");
  CHECK(parse_edid(edid_of("TXN", 1, 4000000000U, "", ""))->serial == "4000000000");
  auto longer = bytes;
  longer.resize(256, 0x5A);  // an extension
  CHECK(parse_edid(longer) == parse_edid(bytes));
}

TEST_CASE("what is no EDID is none") {
  auto bytes = edid_of("TXN", 1, 1, "A", "B");
  CHECK_FALSE(parse_edid(std::span(bytes).first(127)));
  CHECK_FALSE(parse_edid({}));
  bytes[20] ^= 1U;
  CHECK_FALSE(parse_edid(bytes));
  bytes[20] ^= 1U;
  bytes[0] = 1;
  CHECK_FALSE(parse_edid(bytes));
  std::mt19937 random(3);
  for (int i = 0; i < 5000; ++i) {
    auto damaged = edid_of("TXN", 1, 1, "A", "B");
    for (int k = 0; k < 4; ++k) damaged[8 + random() % 119] = static_cast<std::uint8_t>(random());
    int sum = 0;
    for (std::size_t k = 0; k < 127; ++k) sum += damaged[k];
    damaged[127] = static_cast<std::uint8_t>((256 - sum % 256) % 256);
    const auto identity = parse_edid(damaged);
    REQUIRE(identity);
    CHECK(identity->maker.size() == 3);
    CHECK(identity->name.size() <= 13);
  }
}

}  // namespace
}  // namespace focalstage
