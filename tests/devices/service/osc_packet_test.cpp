#include "devices/service/osc_packet.h"

#include <random>
#include <string_view>

#include <doctest/doctest.h>

namespace focalstage {
namespace {

using Kind = DeskCommand::Kind;

// Written by hand from the OSC 1.0 specification.
std::span<const std::byte> bytes(std::string_view text) { return std::as_bytes(std::span(text.data(), text.size())); }

constexpr std::string_view play("/focalstage/play\0\0\0\0,\0\0\0", 24);
constexpr std::string_view cue("/focalstage/cue\0,s\0\0bow\0", 24);
constexpr std::string_view released("/focalstage/go\0\0,f\0\0\0\0\0\0", 24);
constexpr std::string_view pressed("/focalstage/go\0\0,f\0\0\x3f\x80\0\0", 24);

std::string bundle(std::initializer_list<std::string_view> messages) {
  std::string text("#bundle\0\0\0\0\0\0\0\0\1", 16);
  for (const std::string_view message : messages) {
    text += std::string("\0\0\0", 3) + static_cast<char>(message.size());
    text += message;
  }
  return text;
}

TEST_CASE("messages and bundles as the specification writes them") {
  CHECK(osc_messages(bytes(play)) == std::vector<OscMessage>{{"/focalstage/play", {}, false}});
  CHECK(osc_messages(bytes(cue)) == std::vector<OscMessage>{{"/focalstage/cue", "bow", false}});
  CHECK(osc_messages(bytes(released)).at(0).released);
  CHECK_FALSE(osc_messages(bytes(pressed)).at(0).released);
  const std::string two = bundle({cue, play});
  REQUIRE(osc_messages(bytes(two)).size() == 2);
  CHECK(osc_messages(bytes(two))[1].path == "/focalstage/play");
  CHECK(osc_messages(bytes(bundle({two}))).size() == 2);
}

TEST_CASE("what is cut off, too long, too many or too deep is no message") {
  for (std::size_t length = 0; length < cue.size(); ++length) {
    CAPTURE(length);
    for (const OscMessage& message : osc_messages(bytes(cue.substr(0, length)))) CHECK_FALSE(message.text);
  }
  CHECK(osc_messages(bytes(std::string(most_osc_bytes + 1, '/'))).empty());
  std::string many("#bundle\0\0\0\0\0\0\0\0\1", 16);
  for (int n = 0; n < most_osc_messages + 1; ++n) many += bundle({play}).substr(16);
  CHECK(osc_messages(bytes(many)).empty());
  std::string deep = bundle({play});
  for (int n = 0; n < 5; ++n) deep = bundle({deep});
  CHECK(osc_messages(bytes(deep)).empty());
  CHECK(osc_messages(bytes(std::string("#bundle\0\0\0\0\0\0\0\0\1\xff\xff\xff\xff", 20))).empty());
}

TEST_CASE("damaged packets do no harm") {
  std::mt19937 random(7);
  const std::string whole = bundle({cue, play, bundle({released})});
  for (int n = 0; n < 20'000; ++n) {
    std::string packet = whole;
    for (int k = 0; k < 3; ++k) packet[random() % packet.size()] = static_cast<char>(random());
    packet.resize(packet.size() - random() % 8);
    CHECK(osc_messages(bytes(packet)).size() <= most_osc_messages);
  }
}

TEST_CASE("paths and what they ask for") {
  const std::string prefix = "/focalstage";
  const auto asks = [&](const std::string& path) { return desk_command({path, {}, false}, prefix); };
  CHECK(asks("/focalstage/play") == DeskCommand{Kind::play});
  CHECK(asks("/focalstage/hold") == DeskCommand{Kind::hold});
  CHECK(asks("/focalstage/go") == DeskCommand{Kind::go});
  CHECK(asks("/focalstage/next") == DeskCommand{Kind::next});
  CHECK(asks("/focalstage/back") == DeskCommand{Kind::back});
  CHECK(asks("/focalstage/blackout") == DeskCommand{Kind::blackout});
  CHECK(desk_command({"/focalstage/cue", "bow", false}, prefix) == DeskCommand{Kind::cue, "bow"});
  CHECK_FALSE(asks("/focalstage/cue"));
  CHECK_FALSE(asks("/focalstage/"));
  CHECK_FALSE(asks("/focalstage/play/now"));
  CHECK_FALSE(asks("/other/play"));
  CHECK_FALSE(desk_command({"/focalstage/go", {}, true}, prefix));
  CHECK(desk_command({"/rig/1/go", {}, false}, "/rig/1") == DeskCommand{Kind::go});
}

}  // namespace
}  // namespace focalstage
