#include "devices/runtime/rate_limit.h"

#include <doctest/doctest.h>

namespace focalstage {
namespace {

using std::chrono::milliseconds;

TEST_CASE("a burst, then so many a second") {
  const RateLimit::Clock::time_point start(std::chrono::seconds(1000));
  RateLimit limit(10.0, 3.0);
  for (int n = 0; n < 3; ++n) CHECK(limit.take(1.0, start));
  CHECK_FALSE(limit.take(1.0, start));
  CHECK_FALSE(limit.take(1.0, start + milliseconds(90)));
  CHECK(limit.take(1.0, start + milliseconds(110)));
  int taken = 0;
  for (int ms = 0; ms < 2000; ++ms) taken += limit.take(1.0, start + milliseconds(1000 + ms));
  CHECK(taken >= 22);
  CHECK(taken <= 23);
}

TEST_CASE("what is owed is waited for, in the order it was taken") {
  const RateLimit::Clock::time_point start(std::chrono::seconds(1000));
  RateLimit limit(100.0, 50.0);
  CHECK(limit.owe(50.0, start) == milliseconds(0));
  CHECK(limit.owe(20.0, start) == milliseconds(200));
  CHECK(limit.owe(20.0, start) == milliseconds(400));
  CHECK(limit.owe(20.0, start + milliseconds(400)) == milliseconds(200));
}

}  // namespace
}  // namespace focalstage
