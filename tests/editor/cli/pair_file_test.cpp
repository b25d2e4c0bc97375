#include "editor/cli/pair_file.h"

#include <filesystem>
#include <fstream>

#include <doctest/doctest.h>

using namespace focalstage;

namespace {

const std::string head = "name,tracker_x_m,tracker_y_m,tracker_z_m,world_x_m,world_y_m,world_z_m\n";

Result<std::vector<PointPair>> read(const std::string& text) {
  const auto path = std::filesystem::temp_directory_path() / "focalstage-pair-file-test.csv";
  std::ofstream(path, std::ios::binary) << text;
  auto pairs = read_pairs(path);
  std::filesystem::remove(path);
  return pairs;
}

void check_refused(const std::string& text, const std::string& line) {
  const auto pairs = read(text);
  REQUIRE_FALSE(pairs);
  CHECK(pairs.fault().code == "align.file");
  CHECK(pairs.fault().where.find("csv: line " + line) != std::string::npos);
}

}  // namespace

TEST_CASE("pairs are read with blanks, comments and another's line ends") {
  const auto pairs = read("# by hand\r\n" + head + " lamp , 1, 2,3 ,-4,5e-1,.25\r\n\n# more\n,0,0,0,0,0,0");
  REQUIRE(pairs);
  REQUIRE(pairs->size() == 2);
  CHECK((*pairs)[0].name == "lamp");
  CHECK((*pairs)[0].tracker_m == glm::dvec3(1, 2, 3));
  CHECK((*pairs)[0].world_m == glm::dvec3(-4, 0.5, 0.25));
  CHECK((*pairs)[1].name.empty());
  CHECK(read(head)->empty());
  CHECK(read("")->empty());
}

TEST_CASE("lines that are no pair are refused by their number") {
  check_refused("a,1,2,3,4,5,6\n", "1");
  check_refused(head + "a,1,2,3,4,5\n", "2");
  check_refused(head + "a,1,2,3,4,5,6,7\n", "2");
  check_refused(head + "a,1,2,3,4,5,6\n\nb,1,2,x,4,5,6\n", "4");
  check_refused(head + "a,1,2,3,4,5,6 7\n", "2");
  check_refused(head + "a,1,2,3,4,5,\n", "2");
}
