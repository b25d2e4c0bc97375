#include "io/journal/journal.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

using namespace focalstage;

namespace {

JournalStep step(double mm, Joining joining = Joining::own_step) {
  return {{"Set pupils", {{Edit::Kind::set, "viewer", "", "interpupillary_mm", Value(mm)}}}, joining};
}

const JournalStart base{"/shows/кролик.focal", true, "{\n  \"name\": \"a\\n\"\n}\n"};

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("what was written comes back in order") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.journal";
  { REQUIRE(Journal::start(path, base).ok()); }
  CHECK_FALSE(std::filesystem::exists(path));  // nothing happened, nothing is left
  const std::vector<JournalRecord> records{step(60), step(61, Joining::continues_last), JournalJump{0}, step(62)};
  {
    auto journal = Journal::start(path, base);
    REQUIRE(journal.ok());
    for (const JournalRecord& record : records) REQUIRE(journal->add(record).ok());
    REQUIRE(journal->sync().ok());
    CHECK(read_journal(path).fault().code == "journal.held");
    CHECK(Journal::start(path, base).fault().code == "journal.held");
  }
  const auto content = read_journal(path);
  REQUIRE(content.ok());
  CHECK(content->start == base);
  CHECK(content->records == records);
  CHECK_FALSE(content->torn);
}

TEST_CASE("cut at any byte or with any byte changed, what came before the damage is whole") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.journal";
  const std::vector<JournalRecord> records{step(60), JournalJump{1}, step(62.5)};
  {
    auto journal = Journal::start(path, base);
    for (const JournalRecord& record : records) REQUIRE(journal->add(record).ok());
  }
  const std::string whole = bytes_of(path);
  std::vector<std::size_t> ends;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    if (whole[i] == '\n') ends.push_back(i + 1);
  }
  REQUIRE(ends.size() == 4);
  const auto whole_lines = [&](std::size_t damage) {
    return static_cast<std::size_t>(std::count_if(ends.begin(), ends.end(), [&](auto end) { return end <= damage; }));
  };
  const auto holds = [&](const std::string& bytes, std::size_t lines, bool torn) {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
    const auto content = read_journal(path);
    if (lines == 0) {
      CHECK_FALSE(content.ok());
      return;
    }
    REQUIRE(content.ok());
    REQUIRE(content->records.size() == lines - 1);
    CHECK(std::equal(content->records.begin(), content->records.end(), records.begin()));
    CHECK(content->torn == torn);
  };
  for (std::size_t cut = 0; cut < whole.size(); ++cut) {
    holds(whole.substr(0, cut), whole_lines(cut), std::find(ends.begin(), ends.end(), cut) == ends.end());
  }
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 1);
    holds(damaged, whole_lines(at), true);
  }
}

TEST_CASE("a journal that is discarded is gone, and a folder that is not there is a fault") {
  const TemporaryFolder folder;
  auto journal = Journal::start(folder.path() / "a.journal", base);
  REQUIRE(journal.ok());
  journal->discard();
  CHECK_FALSE(std::filesystem::exists(folder.path() / "a.journal"));
  CHECK(Journal::start(folder.path() / "no" / "a.journal", base).fault().code == "file.unwritable");
  CHECK(read_journal(folder.path() / "none").fault().code == "file.missing");
}
