#include "io/study/row_file.h"

#include <signal.h>
#include <sys/resource.h>

#include <fstream>
#include <sstream>

#include <doctest/doctest.h>

#include "tests/support/temporary_folder.h"

using namespace focalstage;

namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

void write(const std::filesystem::path& path, const std::string& text) { std::ofstream(path) << text; }

}  // namespace

TEST_CASE("rows are there when the file is opened again") {
  const TemporaryFolder folder;
  {
    auto file = RowFile::open(folder / "a.csv", "x,y");
    REQUIRE(file);
    CHECK(file->rows().lines.empty());
    CHECK(file->append("1,2"));
    CHECK(file->append("3,4"));
  }
  CHECK(text_of(folder / "a.csv") == "x,y\n1,2\n3,4\n");
  const auto again = RowFile::open(folder / "a.csv", "x,y");
  REQUIRE(again);
  CHECK(again->rows().lines == std::vector<std::string>{"1,2", "3,4"});
  CHECK_FALSE(again->rows().torn);
}

TEST_CASE("cut off at any byte, the rows before it are there and the file can be added to") {
  const TemporaryFolder folder;
  const std::string whole = "x,y\n1,2\n3,4\n";
  for (std::size_t length = 0; length <= whole.size(); ++length) {
    CAPTURE(length);
    const auto path = folder / ("cut" + std::to_string(length));
    write(path, whole.substr(0, length));
    const std::size_t rows = length < 8 ? 0 : length < 12 ? 1 : 2;
    if (length > 0) {
      const auto read = read_rows(path, "x,y");
      REQUIRE(read);
      CHECK(read->lines.size() == rows);
      CHECK(read->torn == (whole[length - 1] != '\n'));
    }
    auto file = RowFile::open(path, "x,y");
    REQUIRE(file);
    CHECK(file->rows().lines.size() == rows);
    CHECK(file->append("5,6"));
    CHECK(text_of(path) == (rows == 0 ? "x,y\n" : whole.substr(0, 4 + 4 * rows)) + "5,6\n");
  }
}

TEST_CASE("another file is not touched") {
  const TemporaryFolder folder;
  for (const char* text : {"name,size\na,1\n", "no rows at all", "\n"}) {
    write(folder / "other", text);
    CHECK(RowFile::open(folder / "other", "x,y").fault().code == "study.rows");
    CHECK(read_rows(folder / "other", "x,y").fault().code == "study.rows");
    CHECK(text_of(folder / "other") == text);
  }
  CHECK(RowFile::open(folder / "none" / "a.csv", "x,y").fault().code == "file.unwritable");
}

TEST_CASE("one process at a time") {
  const TemporaryFolder folder;
  const auto mine = RowFile::open(folder / "a.csv", "x,y");
  REQUIRE(mine);
  CHECK(RowFile::open(folder / "a.csv", "x,y").fault().code == "trials.busy");
}

TEST_CASE("a row that does not fit leaves the file as it was") {
  const TemporaryFolder folder;
  auto file = RowFile::open(folder / "a.csv", "x,y");
  REQUIRE(file);
  REQUIRE(file->append("1,2"));
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const auto old = ::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{10, before.rlim_max};  // room for two bytes of the next row
  ::setrlimit(RLIMIT_FSIZE, &small);
  const Status refused = file->append("333,444");
  ::setrlimit(RLIMIT_FSIZE, &before);
  ::signal(SIGXFSZ, old);
  REQUIRE_FALSE(refused);
  CHECK(refused.fault().code == "file.unwritable");
  CHECK(text_of(folder / "a.csv") == "x,y\n1,2\n");
  CHECK(file->append("5,6"));
  CHECK(text_of(folder / "a.csv") == "x,y\n1,2\n5,6\n");
}
