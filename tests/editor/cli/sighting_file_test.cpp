#include "editor/cli/sighting_file.h"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>

#include "tests/support/temporary_folder.h"

using namespace focalstage;

namespace {

Result<std::vector<Sighting>> read(const std::string& text, const Rigid& tracker = {}) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "s.csv") << text;
  return read_sightings(folder.path() / "s.csv", tracker);
}

const std::string head = std::string(sighting_columns) + "\n";

}  // namespace

TEST_CASE("sightings are read in the world's axes") {
  const Rigid tracker{{1.0, 2.0, 3.0}, {std::sqrt(0.5), 0.0, std::sqrt(0.5), 0.0}};  // a quarter turn about y
  const auto read_back = read(head + "# a remark\n\nfirst, right ,0.1,0.2,0.3,0,0,0,1,4,5,6,7,8,9\n", tracker);
  if (!read_back) FAIL(describe(read_back.fault()));
  REQUIRE(read_back->size() == 1);
  const Sighting& sighting = read_back->front();
  CHECK(sighting.name == "first");
  CHECK(sighting.eye == Side::right);
  CHECK(sighting.world_from_body.position_m.x == doctest::Approx(1.3));
  CHECK(sighting.world_from_body.position_m.y == doctest::Approx(2.2));
  CHECK(sighting.world_from_body.position_m.z == doctest::Approx(2.9));
  CHECK(sighting.mark_m == glm::dvec3(4.0, 5.0, 6.0));
  CHECK(sighting.spot_m == glm::dvec3(7.0, 8.0, 9.0));
}

TEST_CASE("a line that is no sighting is named") {
  for (const char* line : {"a,both,0,0,0,0,0,0,1,0,0,0,0,0,0\n", "a,left,0,0,0,0,0,0,1,0,0,0,0,0\n",
                           "a,left,0,0,0,0,0,0,1,0,0,0,0,0,0,0\n", "a,left,0,0,x,0,0,0,1,0,0,0,0,0,0\n", "left\n"}) {
    const auto refused = read(head + line);
    CAPTURE(line);
    REQUIRE_FALSE(refused.ok());
    CHECK(refused.fault().code == "sightings.file");
    CHECK(refused.fault().where.find("line 2") != std::string::npos);
  }
  CHECK(read("name,eye\n").fault().where.find("line 1") != std::string::npos);
}
