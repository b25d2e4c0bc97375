#include <doctest/doctest.h>
#include <fcntl.h>

#include <chrono>
#include <filesystem>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "io/show/disk.h"
#include "io/show/reader.h"
#include "io/show/writer.h"
#include "tests/io/show/child.h"
#include "tests/io/show/sample.h"

namespace focalstage {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr int frames = 6;

std::vector<std::string> arguments(const fs::path& path, bool resume) {
  std::vector<std::string> out{path.string(), std::to_string(frames), "300", "130", "1", "2"};
  if (resume) out.emplace_back("--resume");
  return out;
}

ShowHeader the_header() { return sample::header(frames, 300, 130, 1); }

void add(ShowWriter& writer, int frame) {
  REQUIRE(writer.add_frame(frame, sample::images(the_header(), frame), sample::measure(frame)).ok());
}

/// Resumes at `path`, adds what is missing and finishes; how many frames were there.
int complete(const fs::path& path, const ShowHeader& header) {
  Result<ShowWriter> writer = ShowWriter::start(path, header, true, 1);
  REQUIRE_MESSAGE(writer.ok(), (writer.ok() ? "" : describe(writer.fault())));
  int there = 0;
  for (int k = 0; k < frames; ++k) {
    if (writer->has_frame(k)) {
      ++there;
    } else {
      add(*writer, k);
    }
  }
  REQUIRE(writer->finish().ok());
  return there;
}

TEST_CASE("100 kills at random moments: no half show, and a resume ends in the same bytes") {
  const sample::Folder folder;
  const fs::path path = folder / "killed.h5";
  const auto begin = Clock::now();
  REQUIRE(sample::Child(arguments(folder / "whole.h5", false)).wait() == 0);
  const auto whole_run = std::chrono::duration_cast<std::chrono::microseconds>(Clock::now() - begin);
  const std::string bytes = sample::bytes_of(folder / "whole.h5");
  REQUIRE(ShowReader::open(folder / "whole.h5").ok());

  const unsigned seed = std::random_device{}();
  CAPTURE(seed);
  std::mt19937 random(seed);
  int kills = 0;
  int shows = 0;
  while (kills < 100) {
    sample::Child child(arguments(path, true));
    REQUIRE(child.started());
    std::this_thread::sleep_for(std::chrono::microseconds(random() % static_cast<unsigned>(whole_run.count() * 3 / 2)));
    const int status = child.kill();
    REQUIRE((status == -1 || status == 0));
    if (status == -1) ++kills;
    if (fs::exists(path)) {
      REQUIRE(sample::bytes_of(path) == bytes);
      ++shows;
      fs::remove(path);
    } else {
      REQUIRE(status == -1);
    }
  }
  REQUIRE(sample::Child(arguments(path, true)).wait() == 0);
  CHECK(sample::bytes_of(path) == bytes);
  CHECK_FALSE(fs::exists(folder / "killed.h5.part"));
  CHECK_FALSE(fs::exists(folder / "killed.h5.tmp"));
  MESSAGE(kills << " kills, " << shows << " shows finished in between, all the same");
}

TEST_CASE("a show that is replaced stays whole until the new one is") {
  const sample::Folder folder;
  const fs::path path = folder / "a.h5";
  sample::put(path, "the old one");
  {
    Result<ShowWriter> writer = ShowWriter::start(path, the_header(), false, 1);
    REQUIRE(writer.ok());
    add(*writer, 0);
    CHECK(sample::bytes_of(path) == "the old one");
    std::stop_source stop;
    stop.request_stop();
    for (int k = 1; k < frames; ++k) add(*writer, k);
    CHECK(writer->finish(stop.get_token()).fault().code == "show.cancelled");
    CHECK(sample::bytes_of(path) == "the old one");
    CHECK_FALSE(fs::exists(folder / "a.h5.tmp"));
  }
  CHECK(complete(path, the_header()) == frames);
  CHECK(ShowReader::open(path).ok());
}

TEST_CASE("a part damaged at any place gives up its tail, never its truth") {
  const sample::Folder folder;
  const fs::path whole = folder / "whole.h5";
  complete(whole, the_header());
  const std::string bytes = sample::bytes_of(whole);
  const fs::path path = folder / "a.h5";
  const fs::path log_path = folder / "a.h5.part/frames.log";
  {
    Result<ShowWriter> writer = ShowWriter::start(path, the_header(), false, 1);
    REQUIRE(writer.ok());
    for (const int k : {4, 0, 2}) add(*writer, k);
  }
  const std::string log = sample::bytes_of(log_path);
  std::mt19937 random(5);
  int fewest = frames;
  int most = 0;
  for (int i = 0; i < 120; ++i) {
    CAPTURE(i);
    std::string damaged = log;
    if (i % 3 == 0) damaged.resize(random() % (log.size() + 1));
    if (i % 3 == 1) damaged[random() % damaged.size()] ^= static_cast<char>(1 << (i % 8));
    if (i % 3 == 2) damaged += std::string(1 + random() % 4096, static_cast<char>(random()));
    fs::create_directories(folder / "a.h5.part");
    sample::put(log_path, damaged);
    const int there = complete(path, the_header());
    REQUIRE(sample::bytes_of(path) == bytes);
    REQUIRE((i % 3 != 2 || there == 3));
    fewest = std::min(fewest, there);
    most = std::max(most, there);
  }
  CHECK(fewest == 0);
  CHECK(most == 3);
}

TEST_CASE("a part of anything else is started over without a word") {
  const sample::Folder folder;
  const fs::path path = folder / "a.h5";
  {
    Result<ShowWriter> writer = ShowWriter::start(path, the_header(), false, 1);
    REQUIRE(writer.ok());
    add(*writer, 0);
  }
  ShowHeader other = the_header();
  SUBCASE("another project") { other.project_text += " "; }
  SUBCASE("another moment of one exposure") { other.schedule.slots[2].start_s += 1e-9; }
  SUBCASE("another pose") { other.poses[3].viewer[0] = std::nextafter(other.poses[3].viewer[0], 1.0); }
  SUBCASE("another cue") { other.cues[1].name += "!"; }
  SUBCASE("another compiler") { other.compiler += " reference"; }
  SUBCASE("other frames of the project") { other.first_frame = 1; }
  SUBCASE("an asset by another name") { other.assets[2].path += "2"; }
  CHECK(complete(path, other) == 0);
  CHECK(ShowReader::open(path)->header() == other);
}

TEST_CASE("without resume the same part is started over too") {
  const sample::Folder folder;
  {
    Result<ShowWriter> writer = ShowWriter::start(folder / "a.h5", the_header(), false, 1);
    REQUIRE(writer.ok());
    add(*writer, 0);
  }
  CHECK(ShowWriter::start(folder / "a.h5", the_header(), true, 1)->has_frame(0));
  CHECK_FALSE(ShowWriter::start(folder / "a.h5", the_header(), false, 1)->has_frame(0));
  CHECK_FALSE(ShowWriter::start(folder / "a.h5", the_header(), true, 1)->has_frame(0));
}

TEST_CASE("two writers of one show: the second is told") {
  const sample::Folder folder;
  Result<ShowWriter> first = ShowWriter::start(folder / "a.h5", the_header(), false, 1);
  REQUIRE(first.ok());
  add(*first, 0);
  CHECK(ShowWriter::start(folder / "a.h5", the_header(), false, 1).fault().code == "show.busy");
  CHECK(ShowWriter::start(folder / "a.h5", the_header(), true, 1).fault().code == "show.busy");
  CHECK(first->has_frame(0));
}

TEST_CASE("a log that changes between writing and assembling is found") {
  const sample::Folder folder;
  Result<ShowWriter> writer = ShowWriter::start(folder / "a.h5", the_header(), false, 1);
  REQUIRE(writer.ok());
  for (int k = 0; k < frames; ++k) add(*writer, k);
  const DiskFile log = open_file(folder / "a.h5.part/frames.log", O_RDWR);
  const std::byte byte[1] = {};
  REQUIRE(log.write_at(log.size() - 20, byte));
  CHECK(writer->finish().fault().code == "show.part-damaged");
  CHECK_FALSE(fs::exists(folder / "a.h5"));
  CHECK_FALSE(fs::exists(folder / "a.h5.tmp"));
}

TEST_CASE("nothing that was in memory before reaches the file") {
  const sample::Folder folder;
  std::vector<std::string> shows;
  for (const std::string fill : {"0", "85", "170"}) {
    const fs::path path = folder / (fill + ".h5");
    REQUIRE(sample::Child(arguments(path, false), {"MALLOC_PERTURB_=" + fill}).wait() == 0);
    shows.push_back(sample::bytes_of(path));
  }
  CHECK(shows[0] == shows[1]);
  CHECK(shows[1] == shows[2]);
}

}  // namespace
}  // namespace focalstage
