#include "core/optics/needs.h"

#include <doctest/doctest.h>

#include <limits>

using namespace focalstage;

TEST_CASE("powers are counted to the nearest hundredth of a dioptre") {
  PowerHistogram powers;
  CHECK(powers.empty());
  powers.add(-1.004, 3);
  powers.add(-1.0, 2);
  powers.add(0.256, 1);
  CHECK(powers.cells() == std::vector<PowerHistogram::Cell>{{-1.0, 5}, {0.26, 1}});
  CHECK(powers.weight() == 6);
  CHECK(powers.lowest_d() == -1.0);
  CHECK(powers.highest_d() == 0.26);
}

TEST_CASE("what is no number, or no power that any lens has") {
  PowerHistogram powers;
  powers.add(std::numeric_limits<double>::quiet_NaN(), 3);
  powers.add(1.0, 0);
  CHECK(powers.empty());
  powers.add(std::numeric_limits<double>::infinity(), 1);
  powers.add(-1e300, 1);
  CHECK(powers.lowest_d() == -farthest_need_d);
  CHECK(powers.highest_d() == farthest_need_d);
}

TEST_CASE("frames add up by object, those that come and go too") {
  ObjectNeeds first;
  first.index = 4;
  first.looks = 10;
  first.unlit = 1;
  first.powers.left.add(1.0, 5);
  ObjectNeeds second;
  second.index = 2;
  second.looks = 3;
  second.pinned_slice = 1;
  Needs needs;
  needs.add({first});
  needs.add({second, first});
  REQUIRE(needs.objects.size() == 2);
  CHECK(needs.objects[0] == second);
  CHECK(needs.objects[1].looks == 20);
  CHECK(needs.objects[1].served() == 18);
  CHECK(needs.all().cells() == std::vector<PowerHistogram::Cell>{{1.0, 10}});
}
