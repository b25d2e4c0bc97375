#include "devices/rig/conductor.h"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "tests/devices/rig/players_hand.h"

namespace focalstage {
namespace {

using test::Stagehands;
constexpr double period_s = Stagehands::period_s;

std::shared_ptr<const Score> score(std::vector<double> trigger_s = {-0.001, 0.004, 0.012}) {
  Score score;
  score.exposure_s = 0.0005;
  score.form = {3, 4};
  score.drive.period_s = period_s;
  for (const Side eye : both_sides) score.drive.drive_a[eye].assign(400, 0.01);
  score.trigger_s = std::move(trigger_s);
  score.shutter.left = ShutterWindow{0.001, 0.008};
  score.shutter.right = ShutterWindow{0.009, 0.016};
  return std::make_shared<const Score>(score);
}

struct Stand : test::PlayersHand<Stagehands, Conductor> {
  Stand() : PlayersHand(score(), 60) {}
  Stagehands& hands = room;
  Conductor& conductor = leader;
};

std::vector<int> lit_codes(const Stagehands& hands) {
  std::vector<int> codes;
  for (const auto& shown : hands.shown) {
    if (shown.code > 0) codes.push_back(shown.code);
  }
  return codes;
}

TEST_CASE("current first, then tables, then triggers, then each sweep's pictures, whole and in order") {
  Stand stand;
  stand.run(0.2);
  CHECK(stand.hands.lens_on);
  CHECK(stand.hands.shown.empty());  // the board has not found the beat yet
  stand.run(2.8);
  REQUIRE(!stand.fault);
  CHECK(stand.hands.lens_starts == 1);
  REQUIRE(stand.hands.exposures.size() == 1);
  CHECK(stand.hands.exposures[0].form == PictureForm{3, 4});
  REQUIRE(stand.hands.tables.size() == 1);
  REQUIRE(stand.hands.tables[0].trigger_s.size() == 3);
  CHECK(stand.hands.tables[0].trigger_s[2] == doctest::Approx(period_s - 0.001));
  const std::vector<int> codes = lit_codes(stand.hands);
  REQUIRE(codes.size() > 300);
  for (std::size_t i = 0; i < codes.size(); ++i) CHECK(codes[i] == static_cast<int>(i / 3) % 250 + 1);
  // The first picture of a sweep comes before its edge, the others after.
  const auto& shown = stand.hands.shown;
  const auto first = std::ranges::find_if(shown, [](const auto& exposure) { return exposure.code > 0; });
  const double phase_s = std::fmod(first->at_s - stand.hands.first_edge_s, period_s);
  CHECK(phase_s == doctest::Approx(period_s - 0.001).epsilon(0.01));
  CHECK(stand.hands.report.missed == 0);
}

TEST_CASE("a beat that the board told of before the lens drive started is none to begin light by") {
  Stand stand;
  stand.run(1.95);
  REQUIRE(!stand.fault);
  CHECK(stand.devices.board->dark());
  CHECK(stand.devices.projector->dark());
  CHECK(stand.devices.lens->stop());
  stand.conductor.forget();
  stand.settle = 30;
  stand.next_s = stand.hands.now_s;
  const std::size_t shown = lit_codes(stand.hands).size();
  stand.run(1.0);
  if (stand.fault) FAIL(stand.fault->message);
  CHECK(stand.hands.lens_starts == 2);
  CHECK(lit_codes(stand.hands).size() > shown + 60);
}

TEST_CASE("a trigger that comes to nothing is found within three periods") {
  Stand stand;
  stand.run(2.0);
  REQUIRE(!stand.fault);
  const double lost_s = stand.hands.now_s;
  stand.hands.lose_trigger = stand.hands.triggers + 1;
  stand.run(0.2);
  REQUIRE(stand.fault);
  CHECK(stand.fault->code == "rig.missed-light");
  CHECK(stand.hands.now_s - lost_s < 4.0 * period_s);
}

TEST_CASE("a player that falls silent is a doubt before a picture is shown for another") {
  Stand stand;
  stand.run(2.0);
  stand.handing = false;
  stand.run(0.5);
  REQUIRE(stand.fault);
  CHECK(stand.fault->message.find("pictures") != std::string::npos);
  for (const auto& shown : stand.hands.shown) CHECK(shown.code <= stand.code);
}

TEST_CASE("another score: all of the one before is shown, then tables travel in the dark, then light") {
  Stand stand;
  stand.run(2.0);
  const int last = stand.code;
  stand.now = score({0.003, 0.006, 0.011, 0.014});
  stand.settle = 60;
  stand.run(2.5);
  REQUIRE(!stand.fault);
  REQUIRE(stand.hands.tables.size() == 2);
  CHECK(stand.hands.lens_refills == 0);  // the sweep itself is the same
  const std::vector<int> codes = lit_codes(stand.hands);
  std::vector<int> times(256, 0);
  for (const int code : codes) ++times[static_cast<std::size_t>(code)];
  for (int code = 1; code < last; ++code) CHECK(times[static_cast<std::size_t>(code)] == 3);
  CHECK(times[static_cast<std::size_t>(last)] >= 2);  // its sweep ends where the period before its last edge does
  CHECK(times[static_cast<std::size_t>(last) + 1] == 4);
}

TEST_CASE("light that was due while nothing was ready yet is a doubt") {
  Stand stand;
  stand.settle = 5;  // the board needs 16 periods
  stand.run(1.0);
  REQUIRE(stand.fault);
  CHECK(stand.fault->code == "rig.missed-light");
}

TEST_CASE("the beat is followed a tenth of the way each sweep") {
  Stagehands hands;
  const RigDevices devices = test::devices_of(hands);
  CHECK(edge_near_s(devices, 1.0) == 1.0);
  REQUIRE(devices.lens->start({}));
  hands.run_until(0.5);
  double edge_s = 0.5;
  for (int i = 0; i < 200; ++i) edge_s = edge_near_s(devices, edge_s + period_s);
  const double turns = (edge_s - hands.first_edge_s) / period_s;
  CHECK(turns == doctest::Approx(std::round(turns)).epsilon(1e-6));
}

}  // namespace
}  // namespace focalstage
