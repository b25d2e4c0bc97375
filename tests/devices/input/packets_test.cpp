#include "devices/input/packets.h"

#include <cmath>
#include <random>
#include <vector>

#include <doctest/doctest.h>

#include "devices/input/probe.h"

namespace focalstage {
namespace {

using Bytes = std::vector<std::uint8_t>;

Deflection after(std::initializer_list<Bytes> reports, const SpaceMouseSettings& settings = {}) {
  SpaceMouseAxes axes(settings);
  for (const Bytes& bytes : reports) {
    if (const auto report = spacemouse_report(bytes)) axes.take(*report, 1.0);
  }
  return axes.deflection(1.0);
}

TEST_CASE("golden reports") {
  const auto right = spacemouse_report(Bytes{0x01, 0x5e, 0x01, 0, 0, 0, 0});
  REQUIRE(right);
  CHECK(*right == SpaceMouseReport{{{350, 0, 0}}, {}, {}});
  const auto yaw = spacemouse_report(Bytes{0x01, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xa2, 0xfe});
  REQUIRE(yaw);
  CHECK(*yaw == SpaceMouseReport{{{0, 0, 0}}, {{0, 0, -350}}, {}});
  CHECK(spacemouse_report(Bytes{0x03, 0x03, 0x00})->buttons == 3u);
  CHECK(spacemouse_report(Bytes{0x03, 0x00, 0x00})->buttons == 0u);
  CHECK(spacemouse_report(Bytes{0x02, 0, 0, 1, 0, 0, 0})->turn == std::array<std::int16_t, 3>{0, 1, 0});
  CHECK(spacemouse_report(Bytes{0x03, 0, 0, 0, 0x80, 1, 1})->buttons == 0x80000000u);
}

TEST_CASE("what is too short, or another report, says nothing") {
  for (std::size_t size = 0; size < 7; ++size) {
    Bytes bytes(size, 1);
    CHECK_FALSE(spacemouse_report(bytes));
  }
  CHECK_FALSE(spacemouse_report(Bytes{0x17, 80, 0, 0, 0, 0, 0}));
  CHECK_FALSE(spacemouse_report(Bytes{0x03}));
  // Twelve bytes are no combined report: the turns are not all there.
  CHECK_FALSE(spacemouse_report(Bytes(12, 1))->turn);
  std::minstd_rand chance(7);
  for (int i = 0; i < 20000; ++i) {
    Bytes bytes(chance() % 20);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(chance() % 5 == 0 ? chance() % 4 : chance());
    const Deflection d = after({bytes});
    for (int k = 0; k < 3; ++k) CHECK((std::abs(d.push[k]) <= 1.0 && std::abs(d.turn[k]) <= 1.0));
  }
}

TEST_CASE("axes: +X right, +Y up, +Z towards the user, turns by the right hand") {
  CHECK(after({{1, 0x5e, 0x01, 0, 0, 0, 0}}).push == glm::dvec3(1.0, 0.0, 0.0));
  CHECK(after({{1, 0, 0, 0x5e, 0x01, 0, 0}}).push == glm::dvec3(0.0, 0.0, 1.0));   // towards the user
  CHECK(after({{1, 0, 0, 0, 0, 0x5e, 0x01}}).push == glm::dvec3(0.0, -1.0, 0.0));  // down
  CHECK(after({{2, 0x5e, 0x01, 0, 0, 0, 0}}).turn == glm::dvec3(1.0, 0.0, 0.0));
  CHECK(after({{2, 0, 0, 0x5e, 0x01, 0, 0}}).turn == glm::dvec3(0.0, 0.0, 1.0));
  CHECK(after({{2, 0, 0, 0, 0, 0x5e, 0x01}}).turn == glm::dvec3(0.0, -1.0, 0.0));
  SpaceMouseSettings other;
  other.axes[1] = {2, 1.0};
  CHECK(after({{1, 0, 0, 0, 0, 0x5e, 0x01}}, other).push.y == 1.0);
}

TEST_CASE("dead zone, and a scale that begins at its edge and ends at full deflection") {
  const auto x = [](int counts) {
    const auto word = static_cast<std::uint16_t>(counts);
    return after({{1, static_cast<std::uint8_t>(word & 0xff), static_cast<std::uint8_t>(word >> 8), 0, 0, 0, 0}})
        .push.x;
  };
  CHECK(x(8) == 0.0);
  CHECK(x(-8) == 0.0);
  CHECK(x(9) == doctest::Approx(1.0 / 342.0));
  CHECK(x(179) == doctest::Approx(0.5));
  CHECK(x(-179) == doctest::Approx(-0.5));
  CHECK(x(350) == 1.0);
  CHECK(x(32767) == 1.0);
  CHECK(x(-32768) == -1.0);
}

TEST_CASE("silence of 100 ms is no push; buttons stay; what was before the silence does not come back") {
  SpaceMouseAxes axes({});
  axes.take(*spacemouse_report(Bytes{1, 0x5e, 0x01, 0, 0, 0, 0}), 1.0);
  axes.take(*spacemouse_report(Bytes{3, 1, 0}), 1.0);
  CHECK(axes.deflection(1.099).push.x == 1.0);
  CHECK(axes.deflection(1.101) == Deflection{{}, {}, 1});
  axes.take(*spacemouse_report(Bytes{3, 0, 0}), 1.2);  // a button is no motion
  CHECK(axes.deflection(1.2) == Deflection{});
  axes.take(*spacemouse_report(Bytes{2, 0, 0, 0x5e, 0x01, 0, 0}), 1.3);
  CHECK(axes.deflection(1.3) == Deflection{{}, {0.0, 0.0, 1.0}, 0});
}

TEST_CASE("motion controllers by their ids, and nothing else of that maker") {
  CHECK(spacemouse_model(0x256f, 0xc635) == "SpaceMouse Compact");
  CHECK(spacemouse_model(0x046d, 0xc626) == "SpaceNavigator");
  for (const int product : {0xc650, 0xc651, 0xc654, 0xc658, 0xc664, 0xc665, 0xc668}) {
    CHECK_FALSE(spacemouse_model(0x256f, static_cast<std::uint16_t>(product)));
  }
  CHECK_FALSE(spacemouse_model(0x046d, 0xc077));
}

}  // namespace
}  // namespace focalstage
