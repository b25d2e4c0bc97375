#include "devices/mcc1208/packets.h"

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include <doctest/doctest.h>

namespace focalstage {
namespace {

using Bytes = std::vector<std::uint8_t>;

TEST_CASE("a scan starts with the published bytes") {
  const auto pacer = mcc_pacer(24e3);
  REQUIRE(pacer.has_value());
  const std::array<std::uint8_t, 9> golden{0x00, 0x00, 0x00, 0x00, 0xc3, 0x09, 0x00, 0x00, 0x03};
  CHECK(mcc_scan_start(*pacer) == golden);
}

TEST_CASE("the pacer makes the published rates exactly") {
  struct Row {
    double rate;
    std::uint32_t pacer;
  };
  for (const Row row : {Row{6e3, 9999},
                        {9.6e3, 6249},
                        {12e3, 4999},
                        {15e3, 3999},
                        {19.2e3, 3124},
                        {24e3, 2499},
                        {30e3, 1999},
                        {48e3, 1249}}) {
    CAPTURE(row.rate);
    CHECK(mcc_pacer(row.rate) == row.pacer);
    CHECK(mcc_scans_per_s(row.pacer) == row.rate);
  }
}

TEST_CASE("no pacer for rates beyond the device or beyond sense") {
  for (const double rate :
       {0.0, -1.0, 50001.0, 1e-9, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    CAPTURE(rate);
    CHECK_FALSE(mcc_pacer(rate).has_value());
  }
  CHECK(mcc_pacer(50e3) == 1199U);
}

TEST_CASE("volts and codes agree with the published sine of 1 V about 2.5 V") {
  const std::array<int, 8> golden{2048, 2627, 2867, 2627, 2048, 1469, 1229, 1469};
  for (std::size_t i = 0; i < golden.size(); ++i) {
    CHECK(mcc_code(2.5 + std::sin(static_cast<double>(i) * std::acos(-1.0) / 4.0)) == golden[i]);
  }
  CHECK(mcc_code(-1.0) == 0);
  CHECK(mcc_code(5.0) == 4095);
  CHECK(mcc_code(std::numeric_limits<double>::infinity()) == 4095);
  CHECK(mcc_code(std::numeric_limits<double>::quiet_NaN()) == 0);
  CHECK(mcc_volts(2048) == 2.5);
}

TEST_CASE("a scan is two little-endian codes, the low channel first") {
  Bytes bytes;
  append_mcc_scan(bytes, 0x0123, 0x0fff);
  CHECK(bytes == Bytes{0x23, 0x01, 0xff, 0x0f});
}

TEST_CASE("a status is its two bits, whatever else is set") {
  CHECK(read_mcc_status(Bytes{0x08, 0x00}) == MccStatus{true, false});
  CHECK(read_mcc_status(Bytes{0x10, 0x00}) == MccStatus{false, true});
  CHECK(read_mcc_status(Bytes{0xe7, 0xff}) == MccStatus{false, false});
  CHECK_FALSE(read_mcc_status(Bytes{0x08}).has_value());
  CHECK_FALSE(read_mcc_status(Bytes{}).has_value());
}

TEST_CASE("a serial number is eight printable characters") {
  CHECK(read_mcc_serial(Bytes{'0', '1', 'A', 'B', '2', '3', 'C', 'D'}) == "01AB23CD");
  CHECK_FALSE(read_mcc_serial(Bytes{'0', '1', 'A', 'B', '2', '3', 'C'}).has_value());
  CHECK_FALSE(read_mcc_serial(Bytes{'0', '1', 'A', 'B', 0, '3', 'C', 'D'}).has_value());
}

TEST_CASE("what erases firmware or writes memories has no name") {
  for (const MccRequest request :
       {MccRequest::direction, MccRequest::latch, MccRequest::output, MccRequest::scan_start, MccRequest::scan_stop,
        MccRequest::clear_fifo, MccRequest::blink, MccRequest::status, MccRequest::serial}) {
    const int number = static_cast<int>(request);
    CHECK(number != 0x50);
    CHECK(number != 0x30);
    CHECK(number != 0x31);
  }
}

TEST_CASE("random answers are read within bounds") {
  std::mt19937 chance(1208);
  for (int i = 0; i < 20000; ++i) {
    Bytes bytes(chance() % 12);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(chance());
    CHECK(read_mcc_status(bytes).has_value() == (bytes.size() == 2));
    const auto codes = read_mcc_outputs(bytes);
    if (codes) CHECK((bytes.size() == 4 && (*codes)[0] <= mcc_top_code && (*codes)[1] <= mcc_top_code));
    const auto serial = read_mcc_serial(bytes);
    if (serial) CHECK(serial->size() == 8);
  }
}

}  // namespace
}  // namespace focalstage
