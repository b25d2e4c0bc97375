#include "devices/runtime/lease.h"

#include <doctest/doctest.h>

namespace focalstage {
namespace {

using std::chrono::milliseconds;

TEST_CASE("one holds the rig, others hear who, and giving it back lets them in") {
  LeaseDesk desk(milliseconds(1000));
  const auto now = LeaseDesk::Clock::now();
  const auto first = desk.acquire("anna:1", now);
  REQUIRE(first);
  CHECK(desk.holder(now) == "anna:1");
  const auto second = desk.acquire("bert:2", now);
  CHECK(second.fault().code == "rig.held");
  CHECK(second.fault().where == "anna:1");
  CHECK(desk.use(*first, now));
  CHECK(desk.use("guess", now).fault().code == "rig.lease");
  CHECK(desk.use("", now).fault().code == "rig.lease");
  desk.release("guess");
  CHECK(desk.holder(now) == "anna:1");
  desk.release(*first);
  CHECK(desk.holder(now).empty());
  CHECK(desk.use(*first, now).fault().code == "rig.lease");
  CHECK(desk.acquire("bert:2", now));
}

TEST_CASE("a holder that is not heard of loses the rig; each use prolongs the lease") {
  LeaseDesk desk(milliseconds(1000));
  const auto start = LeaseDesk::Clock::now();
  const std::string token = *desk.acquire("anna:1", start);
  CHECK(desk.use(token, start + milliseconds(900)));
  CHECK(desk.use(token, start + milliseconds(1800)));
  CHECK(desk.acquire("bert:2", start + milliseconds(2799)).fault().code == "rig.held");
  CHECK(desk.use(token, start + milliseconds(2801)).fault().code == "rig.lease");
  CHECK(desk.acquire("bert:2", start + milliseconds(2801)));
}

}  // namespace
}  // namespace focalstage
