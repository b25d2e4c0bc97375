#include "devices/rig/projector_led.h"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "devices/rig/device_rig.h"
#include "tests/devices/rig/master_hall.h"
#include "tests/devices/rig/players_hand.h"

namespace focalstage {
namespace {

using test::MasterHall;
constexpr double show_period_s = 1.0 / 60.0;  // what a show was made for; the projector has its own

std::shared_ptr<const Score> score(std::vector<double> trigger_s = {0.002, 0.006, 0.012}) {
  Score score;
  score.exposure_s = 0.0005;
  score.drive.period_s = show_period_s;
  for (const Side eye : both_sides) score.drive.drive_a[eye].assign(400, 0.01);
  score.trigger_s = std::move(trigger_s);
  score.shutter.left = ShutterWindow{0.001, 0.008};
  score.shutter.right = ShutterWindow{0.009, 0.016};
  return std::make_shared<const Score>(score);
}

struct Stand : test::PlayersHand<MasterHall, ProjectorLed> {
  Stand() : PlayersHand(score(), 480) {}
  MasterHall& hall = room;
  ProjectorLed& led = leader;

  std::vector<MasterHall::Shown> lit() const {
    std::vector<MasterHall::Shown> found;
    std::ranges::copy_if(hall.shown, std::back_inserter(found), [](const auto& shown) { return shown.code > 0; });
    return found;
  }
};

TEST_CASE(
    "light comes once the lens drive is in step with the projector's own periods, and each sweep once, in order") {
  for (const double ppm : {-200.0, 80.0}) {
    CAPTURE(ppm);
    Stand stand;
    stand.hall.drive_ppm = ppm;
    stand.run(20.0);
    if (stand.fault) MESSAGE(describe(*stand.fault));
    REQUIRE(!stand.fault);
    REQUIRE(stand.hall.exposures.size() == 1);
    CHECK(stand.hall.exposures[0].start_s == std::vector<double>{0.002, 0.006, 0.012});
    const auto lit = stand.lit();
    REQUIRE(lit.size() > 600);
    double worst_s = 0.0;
    for (std::size_t i = 0; i < lit.size(); ++i) {
      CHECK(lit[i].code == static_cast<int>(i) % 250 + 1);
      CHECK(lit[i].shutters);
      if (i > 0) CHECK(lit[i].at_s - lit[i - 1].at_s == doctest::Approx(stand.hall.projector_period_s));
      worst_s = std::max(worst_s, std::abs(lit[i].lens_s));
    }
    MESSAGE("lens drive within ", 1e6 * worst_s, " us of the projector");
    CHECK(worst_s < 20e-6);
    // Its edges are the first exposure's: shutters are told from there, and there are no triggers.
    REQUIRE(stand.hall.tables.size() == 1);
    const BoardTable& table = stand.hall.tables[0];
    CHECK(table.trigger_s.empty());
    CHECK(table.shutter.left->open_s == doctest::Approx(show_period_s - 0.001));
    CHECK(table.shutter.left->close_s == doctest::Approx(show_period_s + 0.006));
    CHECK(table.shutter.right->open_s == doctest::Approx(0.007));
  }
}

TEST_CASE("sweeps are told apart by the projector's beat: what is handed over stays as far ahead for a minute") {
  Stand stand;
  stand.run(60.0);
  REQUIRE(!stand.fault);
  CHECK(stand.next_s - stand.hall.now_s > 4.5 * show_period_s);
  CHECK(stand.next_s - stand.hall.now_s < 7.5 * show_period_s);
  const double turns = (stand.next_s - stand.hall.projector_s) / stand.hall.projector_period_s;
  CHECK(std::abs(turns - std::round(turns)) < 0.02);
  CHECK(stand.lit().size() > 3000);
}

TEST_CASE("a drive that slips, or whose edge is not seen, is a doubt, and light is never before that") {
  SUBCASE("it slips") {
    Stand stand;
    stand.run(12.0);
    REQUIRE(!stand.fault);
    stand.hall.drive_s += 0.001;
    const double slipped_s = stand.hall.now_s;
    stand.run(5.0);
    REQUIRE(stand.fault);
    CHECK(stand.fault->code == "rig.out-of-step");
    CHECK(stand.hall.now_s - slipped_s < 1.6);
  }
  SUBCASE("its line breaks") {
    Stand stand;
    stand.run(12.0);
    REQUIRE(!stand.fault);
    stand.hall.lens_wired = false;
    const double broken_s = stand.hall.now_s;
    stand.run(5.0);
    REQUIRE(stand.fault);
    CHECK(stand.fault->code == "rig.out-of-step");
    CHECK(stand.hall.now_s - broken_s < 1.2);
  }
  SUBCASE("it was never wired") {
    Stand stand;
    stand.hall.lens_wired = false;
    stand.run(12.0);
    REQUIRE(stand.fault);  // pictures came, and no step
    CHECK(stand.lit().empty());
    CHECK(stand.hall.arms == 0);
  }
}

TEST_CASE("a player that falls silent is a doubt once the projector has no pictures") {
  Stand stand;
  stand.run(12.0);
  REQUIRE(!stand.fault);
  stand.handing = false;
  stand.run(0.5);
  REQUIRE(stand.fault);
  CHECK(stand.fault->code == "rig.missed-light");
}

TEST_CASE("another score: all before it is shown, then tables anew in the dark, then light") {
  Stand stand;
  stand.run(12.0);
  REQUIRE(!stand.fault);
  const int last = stand.code;
  stand.now = score({0.004, 0.010});
  stand.settle = 480;
  stand.run(14.0);
  if (stand.fault) MESSAGE(describe(*stand.fault));
  REQUIRE(!stand.fault);
  REQUIRE(stand.hall.tables.size() == 2);
  CHECK(stand.hall.exposures.back().start_s == std::vector<double>{0.004, 0.010});
  std::vector<int> codes;
  for (const auto& shown : stand.lit()) codes.push_back(shown.code);
  const auto end_of_first = std::ranges::find(codes, last);
  CHECK(end_of_first != codes.end());
  CHECK(std::ranges::count(codes, last % 250 + 1) >= 1);
  for (const auto& shown : stand.lit()) CHECK(std::abs(shown.lens_s) < 20e-6);
}

TEST_CASE("a rig whose lens drive cannot follow the projector says so before anything moves") {
  MasterHall hall;
  DeviceRig rig(test::devices_of(hall, false), DeviceRigSettings{});
  const Status ready = rig.ready();
  REQUIRE(!ready);
  CHECK(ready.fault().where == "projector");
  MasterHall other;
  DeviceRig follows(test::devices_of(other, true), DeviceRigSettings{});
  CHECK(follows.ready());
  CHECK(follows.settle_sweeps() == DeviceRigSettings{}.following_sweeps);
}

}  // namespace
}  // namespace focalstage
