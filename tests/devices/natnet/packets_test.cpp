#include "devices/natnet/packets.h"

#include <algorithm>
#include <random>
#include <string>

#include <doctest/doctest.h>

#include "tests/devices/natnet/emulator/server_bytes.h"
#include "tests/devices/natnet/golden_frames.h"

namespace focalstage {
namespace {

using natnet_emulator::Body;
using natnet_emulator::Dialect;
using natnet_emulator::Moment;

constexpr Dialect dialects[] = {{3, 0, false, true, false}, {3, 1, false, true, false}, {4, 0, false, true, false},
                                {4, 0, true, true, false},  {4, 1, true, true, true},   {4, 1, false, true, true},
                                {4, 3, true, false, true}};

NatNetVersion version_of(const Dialect& dialect) { return {dialect.major, dialect.minor}; }

std::string text_of(const Dialect& dialect) {
  return std::to_string(dialect.major) + "." + std::to_string(dialect.minor) + (dialect.stamp ? " with" : " without") +
         " stamp";
}

NatNetBytes golden(const Dialect& dialect) {
  if (dialect.minor >= 1 && dialect.major == 4) return {golden_frame_4_1.begin(), golden_frame_4_1.end()};
  return {golden_frame_3_1.begin(), golden_frame_3_1.end()};
}

std::span<const std::uint8_t> payload(const NatNetBytes& datagram) { return std::span(datagram).subspan(4); }

Moment golden_moment() {
  return {
      1000, {{7, "", {0.25F, 1.5F, -0.75F}, {0, 0, 0, 1}, 0.0005F, 1}}, false, true, 16.5, 1000000, 1000500, 1000900,
      0};
}

void check_golden(const Result<NatNetFrame>& frame) {
  REQUIRE(frame.ok());
  CHECK(frame->number == 1000);
  REQUIRE(frame->bodies.size() == 1);
  CHECK(frame->bodies[0] == NatNetBody{7, {0.25F, 1.5F, -0.75F}, {0.0F, 0.0F, 0.0F, 1.0F}, 0.0005F, true});
  CHECK(frame->timestamp_s == 16.5);
  CHECK(frame->exposed_ticks == 1000000);
  CHECK(frame->sent_ticks == 1000900);
  CHECK_FALSE(frame->models_changed);
}

/// A message of any kind, as the driver reads it; true if some reading took it.
bool read_any(std::span<const std::uint8_t> bytes) {
  bool taken = read_server(bytes).ok();
  for (const Dialect& dialect : dialects) {
    const NatNetVersion version = version_of(dialect);
    taken |= read_frame(bytes, version).ok();
    taken |= read_names(bytes, version, NatNetDescriptionSize::after_type).ok();
    taken |= read_names(bytes, version, NatNetDescriptionSize::none).ok();
  }
  return taken;
}

TEST_CASE("the golden frames read as what they were made of, in every version of their layout") {
  for (const NatNetVersion version : {NatNetVersion{3, 0}, {3, 1}, {4, 0}}) {
    const auto datagram = read_datagram(golden_frame_3_1);
    REQUIRE(datagram.ok());
    CHECK(datagram->id == 7);
    check_golden(read_frame(datagram->payload, version));
  }
  const auto datagram = read_datagram(golden_frame_4_1);
  REQUIRE(datagram.ok());
  check_golden(read_frame(datagram->payload, {4, 1}));
}

TEST_CASE("the emulator writes the golden frames byte for byte") {
  CHECK(natnet_emulator::frame({3, 1}, golden_moment()) == golden({3, 1}));
  CHECK(natnet_emulator::frame({4, 0, false}, golden_moment()) == golden({4, 0}));
  CHECK(natnet_emulator::frame({4, 1}, golden_moment()) == golden({4, 1}));
}

TEST_CASE("bodies are found among everything else a frame can hold") {
  Moment moment = golden_moment();
  moment.crowded = true;
  moment.bodies.push_back({-8, "", {1, 2, 3}, {0.5F, 0.5F, 0.5F, 0.5F}, 0.25F, 0});
  moment.param = 2;
  for (const Dialect& dialect : dialects) {
    CAPTURE(text_of(dialect));
    const NatNetBytes bytes = natnet_emulator::frame(dialect, moment);
    const auto frame = read_frame(payload(bytes), version_of(dialect));
    REQUIRE(frame.ok());
    REQUIRE(frame->bodies.size() == 2);
    CHECK(frame->bodies[0].id == 7);
    CHECK(frame->bodies[1] == NatNetBody{-8, {1, 2, 3}, {0.5F, 0.5F, 0.5F, 0.5F}, 0.25F, false});
    CHECK(frame->sent_ticks == 1000900);
    CHECK(frame->models_changed);
  }
}

TEST_CASE("a body that a later version made longer is read by the section's size") {
  NatNetBytes bytes = golden({4, 1});
  const std::size_t section = 4 + 4 + 8 + 8;  // header, number, marker sets, unlabelled markers
  bytes[section + 4] = 40;
  bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(section + 8 + 38), 2, std::uint8_t{0xaa});
  check_golden(read_frame(payload(bytes), {4, 1}));
  bytes[section + 4] = 37;
  CHECK_FALSE(read_frame(payload(bytes), {4, 1}).ok());
}

TEST_CASE("server information, whole and from an older server that tells less") {
  NatNetBytes bytes(4 + 256, 0);
  const std::string head{"\x01\x00\x17\x01Motive", 10};
  std::copy(head.begin(), head.end(), bytes.begin());
  for (const int b : {3, 1, 0, 0, 4, 1, 0, 0, 0x80, 0x96, 0x98, 0, 0, 0, 0, 0, 0xE7, 5, 1, 0xEF, 0xFF, 0x2A, 0x63}) {
    bytes.push_back(static_cast<std::uint8_t>(b));
  }
  const auto datagram = read_datagram(bytes);
  REQUIRE(datagram.ok());
  const auto server = read_server(datagram->payload);
  REQUIRE(server.ok());
  CHECK(*server == NatNetServer{"Motive", {4, 1}, 10000000});
  CHECK(natnet_emulator::server_info({4, 1}, 10000000, 1511, true) == bytes);

  const auto older = read_server(datagram->payload.first(264));
  REQUIRE(older.ok());
  CHECK(*older == NatNetServer{"Motive", {4, 1}, 0});
  CHECK_FALSE(read_server(datagram->payload.first(263)).ok());
}

TEST_CASE("names of bodies, past marker sets, with and without sizes") {
  const std::vector<Body> bodies{{7, "Head"}, {8, "Pedestal \xc3\xa4"}};
  for (const Dialect& dialect : dialects) {
    const NatNetBytes bytes = natnet_emulator::descriptions(dialect, bodies);
    const auto names = read_names(payload(bytes), version_of(dialect), NatNetDescriptionSize::after_type);
    REQUIRE(names.ok());
    CHECK(*names == NatNetNames{{{7, "Head"}, {8, "Pedestal \xc3\xa4"}}, true});
  }
  const Dialect unsized{4, 1, true, true, false};
  const NatNetBytes bytes = natnet_emulator::descriptions(unsized, bodies);
  const auto names = read_names(payload(bytes), {4, 1}, NatNetDescriptionSize::none);
  REQUIRE(names.ok());
  CHECK(names->bodies.size() == 2);
  CHECK_FALSE(read_names(payload(bytes), {4, 1}, NatNetDescriptionSize::after_type).ok());
}

TEST_CASE("a description of unknown layout and size hides what follows, and says so") {
  const NatNetBytes camera{2, 0, 0, 0, 5, 0, 0, 0, 'c', 0, 1, 2, 3};
  const auto names = read_names(camera, {3, 1}, NatNetDescriptionSize::after_type);
  REQUIRE(names.ok());
  CHECK(*names == NatNetNames{{}, false});
}

TEST_CASE("requests have their published bytes") {
  CHECK(ping_message() == NatNetBytes{0, 0, 5, 0, 0x50, 0x69, 0x6E, 0x67, 0});
  CHECK(keep_alive_message() == NatNetBytes{0x0A, 0, 1, 0, 0});
  CHECK(model_request_message() == NatNetBytes{4, 0, 1, 0, 0});
}

TEST_CASE("a datagram cut at any byte is damaged") {
  for (const Dialect& dialect : dialects) {
    Moment moment = golden_moment();
    moment.crowded = true;
    const NatNetBytes bytes = natnet_emulator::frame(dialect, moment);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      const NatNetBytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
      const auto datagram = read_datagram(cut);
      REQUIRE_FALSE(datagram.ok());
      CHECK(datagram.fault().code == "natnet.damaged");
    }
  }
}

TEST_CASE("a payload cut at any byte is damaged, but for the parts that servers may leave out") {
  for (const Dialect& dialect : dialects) {
    const NatNetBytes bytes = natnet_emulator::frame(dialect, golden_moment());
    const auto whole = payload(bytes);
    for (std::size_t size = 0; size < whole.size(); ++size) {
      // A heap block of exactly this size: the sanitizer sees a read past it.
      const NatNetBytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
      const std::size_t gone = whole.size() - size;
      const bool allowed = dialect.end_tag && (gone == 4 || (dialect.stamp && (gone == 8 || gone == 12)));
      const bool without_tag = !dialect.end_tag && dialect.stamp && (gone == 4 || gone == 8);
      CAPTURE(text_of(dialect));
      CAPTURE(gone);
      CHECK(read_frame(cut, version_of(dialect)).ok() == (allowed || without_tag));
    }
    const NatNetBytes described = natnet_emulator::descriptions(dialect, {{7, "Head"}});
    for (std::size_t size = 0; size < described.size() - 4; ++size) {
      const auto part = payload(described).first(size);
      const NatNetBytes cut(part.begin(), part.end());
      CHECK_FALSE(read_names(cut, version_of(dialect), NatNetDescriptionSize::after_type).ok());
    }
  }
}

TEST_CASE("counts and sizes beyond the message are refused at once") {
  for (const int at : {4, 8, 12, 16, 20, 24, 66, 70, 74, 78, 82, 86}) {
    for (const std::uint32_t value : {0x7fffffffU, 0x80000000U, 0xffffffffU, 0x10000000U}) {
      NatNetBytes bytes = golden({4, 1});
      for (int i = 0; i < 4; ++i)
        bytes[static_cast<std::size_t>(4 + at + i)] = static_cast<std::uint8_t>(value >> (8 * i));
      CHECK_FALSE(read_frame(payload(bytes), {4, 1}).ok());
    }
  }
}

TEST_CASE("random bytes are read without harm") {
  std::mt19937 random(6);
  std::size_t taken = 0;
  for (int i = 0; i < 50000; ++i) {
    NatNetBytes bytes(random() % 300);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random() % 4 == 0 ? random() : 0);
    taken += read_any(bytes) ? 1 : 0;
  }
  // A whole message with a few wrong bytes gets further in.
  Moment moment = golden_moment();
  moment.crowded = true;
  for (int i = 0; i < 50000; ++i) {
    const Dialect& dialect = dialects[random() % std::size(dialects)];
    const NatNetBytes datagram =
        i % 2 == 0 ? natnet_emulator::frame(dialect, moment) : natnet_emulator::descriptions(dialect, {{7, "Head"}});
    NatNetBytes bytes(datagram.begin() + 4, datagram.end());
    for (int wrong = 0; wrong < 3; ++wrong) bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    taken += read_any(bytes) ? 1 : 0;
  }
  CHECK(taken > 0);
  CHECK(taken < 100000);
}

}  // namespace
}  // namespace focalstage
