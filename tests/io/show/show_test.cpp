#include <doctest/doctest.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <string>
#include <thread>
#include <vector>

#include "io/show/reader.h"
#include "io/show/seal.h"
#include "io/show/writer.h"
#include "tests/io/show/sample.h"

namespace focalstage {
namespace {

namespace fs = std::filesystem;

/// Writes the sample's frames in `order`, with `threads`; the file's bytes.
std::string written(const fs::path& path, const ShowHeader& header, const std::vector<int>& order, int threads) {
  Result<ShowWriter> writer = ShowWriter::start(path, header, false, threads);
  REQUIRE_MESSAGE(writer.ok(), (writer.ok() ? "" : describe(writer.fault())));
  for (const int frame : order) {
    const Status added = writer->add_frame(frame, sample::images(header, frame), sample::measure(frame));
    REQUIRE_MESSAGE(added.ok(), (added.ok() ? "" : describe(added.fault())));
  }
  const Status finished = writer->finish();
  REQUIRE_MESSAGE(finished.ok(), (finished.ok() ? "" : describe(finished.fault())));
  return sample::bytes_of(path);
}

std::vector<int> in_order(int frames) {
  std::vector<int> order(static_cast<std::size_t>(frames));
  std::iota(order.begin(), order.end(), 0);
  return order;
}

TEST_CASE("a show reads back as it was written") {
  const sample::Folder folder;
  struct Size {
    int frames, width_px, height_px, channels;
  };
  // Larger than a chunk, smaller, a single pixel, and colour; edges that fall inside a chunk.
  for (const Size& size : {Size{3, 300, 130, 1}, Size{2, 17, 9, 1}, Size{1, 1, 1, 1}, Size{2, 257, 65, 3}}) {
    CAPTURE(size.width_px);
    const ShowHeader header = sample::header(size.frames, size.width_px, size.height_px, size.channels);
    const fs::path path = folder / "a.h5";
    written(path, header, in_order(size.frames), 0);
    const Result<ShowReader> show = ShowReader::open(path);
    REQUIRE_MESSAGE(show.ok(), (show.ok() ? "" : describe(show.fault())));
    CHECK(show->header() == header);
    CHECK(show->sha256() == *check_seal(path));
    for (int k = 0; k < size.frames; ++k) {
      const FrameImages expected = sample::images(header, k);
      const Result<FrameImages> frame = show->frame(k);
      REQUIRE(frame.ok());
      CHECK(frame->count == 5);
      CHECK(frame->codes == expected.codes);
      const Result<FrameImages> image = show->image(k, 1);
      REQUIRE(image.ok());
      CHECK(image->count == 1);
      CHECK(std::equal(image->codes.begin(), image->codes.end(), expected.image(1).begin(), expected.image(1).end()));
      CHECK(sample::same(show->measures()[static_cast<std::size_t>(k)], sample::measure(k)));
    }
    CHECK_FALSE(fs::exists(folder / "a.h5.part"));
    CHECK_FALSE(fs::exists(folder / "a.h5.tmp"));
    CHECK(show->frame(size.frames).fault().code == "show.frame");
    CHECK(show->frame(-1).fault().code == "show.frame");
    CHECK(show->image(0, 5).fault().code == "show.frame");
  }
}

TEST_CASE("a show of two projectors reads back, each with its own size, images and exposures") {
  const sample::Folder folder;
  ShowHeader header = sample::header(2, 40, 30, 1);
  const std::string one = "[{ \"name\": \"main\" }]";
  header.project_text.replace(header.project_text.find(one), one.size(),
                              "[{ \"name\": \"main\" }, { \"name\": \"other\" }]");
  ShowHeader other = sample::header(2, 300, 70, 3);
  other.images.pop_back();
  header.others = {{1440.0, 300, 70, 3, other.images, sample::schedule(other.images).slots}};
  const fs::path path = folder / "a.h5";
  Result<ShowWriter> writer = ShowWriter::start(path, header, false, 1);
  REQUIRE_MESSAGE(writer.ok(), (writer.ok() ? "" : describe(writer.fault())));
  REQUIRE(writer->add_frame(0, sample::images(header, 0), sample::measure(0), 0));
  CHECK_FALSE(writer->has_frame(0));
  CHECK(writer->has_frame(0, 0));
  CHECK_FALSE(writer->add_frame(0, sample::images(header, 0), {}, 1));  // the first one's size
  CHECK_FALSE(writer->add_frame(0, sample::images(header, 0), {}, 2));
  REQUIRE(writer->add_frame(0, sample::images(other, 0), sample::measure(5), 1));
  CHECK(writer->has_frame(0));
  REQUIRE(writer->add_frame(1, sample::images(other, 1), sample::measure(6), 1));
  CHECK(writer->finish().fault().code == "show.missing-frame");
  {  // killed here, and gone on with
    writer = Fault{"none", "", "", ""};
    writer = ShowWriter::start(path, header, true, 1);
    REQUIRE(writer);
    CHECK(writer->has_frame(0));
    CHECK(writer->has_frame(1, 1));
    CHECK_FALSE(writer->has_frame(1));
  }
  REQUIRE(writer->add_frame(1, sample::images(header, 1), sample::measure(1), 0));
  REQUIRE(writer->finish());
  CHECK_FALSE(fs::exists(folder / "a.h5.part"));
  const Result<ShowReader> show = ShowReader::open(path);
  REQUIRE_MESSAGE(show.ok(), (show.ok() ? "" : describe(show.fault())));
  CHECK(show->header() == header);
  for (int k = 0; k < 2; ++k) {
    CHECK(show->frame(k)->codes == sample::images(header, k).codes);
    CHECK(show->frame(k, 1)->codes == sample::images(other, k).codes);
    CHECK(sample::same(show->measures()[static_cast<std::size_t>(k)], sample::measure(k)));
    CHECK(sample::same(show->measures(1)[static_cast<std::size_t>(k)], sample::measure(5 + k)));
  }
  CHECK(show->image(1, 3, 1)->width_px == 300);
}

TEST_CASE("more projectors in a show than in its project: refused") {
  const sample::Folder folder;
  ShowHeader header = sample::header(1, 20, 10, 1);
  header.others = {{1440.0, 20, 10, 1, header.images, header.schedule.slots}};
  const Result<ShowWriter> writer = ShowWriter::start(folder / "a.h5", header, false, 1);
  REQUIRE_FALSE(writer);
  CHECK(writer.fault().where.find("/projector") != std::string::npos);
}

TEST_CASE("a second projector's datasets are held to the same rules") {
  const sample::Folder folder;
  ShowHeader header = sample::header(1, 20, 10, 1);
  const std::string one = "[{ \"name\": \"main\" }]";
  header.project_text.replace(header.project_text.find(one), one.size(),
                              "[{ \"name\": \"main\" }, { \"name\": \"other\" }]");
  header.others = {{1440.0, 20, 10, 1, header.images, header.schedule.slots}};
  std::string where;
  SUBCASE("slot") { header.others[0].slots[0].image = 9, where = "/projector/1/slot/image"; }
  SUBCASE("size") { header.others[0].width_px = 0, where = "/projector/1/images"; }
  SUBCASE("slice") { header.others[0].images[0].slice = 7, where = "/projector/1/image/slice"; }
  SUBCASE("rate") { header.others[0].frames_per_second = 0.0, where = "/projector/1 attribute frames_per_second"; }
  const Result<ShowWriter> writer = ShowWriter::start(folder / "a.h5", header, false, 1);
  REQUIRE_FALSE(writer);
  CHECK(writer.fault().where.find(where) != std::string::npos);
}

TEST_CASE("a show of nothing but a screen: no objects, no cues, no assets, no slots") {
  const sample::Folder folder;
  ShowHeader header = sample::header(2, 20, 10, 1);
  header.assets.clear();
  header.cues.clear();
  header.schedule.slots.clear();
  header.schedule.lens_power_d = {};
  header.schedule.lens_drive_a = {};
  for (FramePoses& poses : header.poses) {
    poses.objects.clear();
    poses.surfaces.clear();
  }
  header.project_text = sample::project_text(0, 0);
  SUBCASE("with images") {}
  SUBCASE("and without images") { header.images.clear(); }
  const fs::path path = folder / "empty.h5";
  written(path, header, {0, 1}, 1);
  const Result<ShowReader> show = ShowReader::open(path);
  REQUIRE_MESSAGE(show.ok(), (show.ok() ? "" : describe(show.fault())));
  CHECK(show->header() == header);
  CHECK(show->frame(1)->codes == sample::images(header, 1).codes);
}

TEST_CASE("the bytes depend on the header and the frames alone") {
  const sample::Folder folder;
  const ShowHeader header = sample::header(4, 300, 130, 1);
  const std::string bytes = written(folder / "a.h5", header, {0, 1, 2, 3}, 1);
  CHECK(bytes == written(folder / "b.h5", header, {3, 1, 0, 2}, 2));
  CHECK(bytes == written(folder / "a.h5", header, {2, 3, 1, 0}, 5));

  SUBCASE("and not on where a run stopped") {
    {
      Result<ShowWriter> first = ShowWriter::start(folder / "c.h5", header, false, 1);
      REQUIRE(first.ok());
      REQUIRE(first->add_frame(2, sample::images(header, 2), sample::measure(2)).ok());
      REQUIRE(first->add_frame(0, sample::images(header, 0), sample::measure(0)).ok());
      CHECK(first->finish().fault().code == "show.missing-frame");
    }
    Result<ShowWriter> second = ShowWriter::start(folder / "c.h5", header, true, 2);
    REQUIRE(second.ok());
    CHECK(second->has_frame(0));
    CHECK_FALSE(second->has_frame(1));
    CHECK(second->has_frame(2));
    CHECK(second->measures()[2].worst_defocus_d == 0.25);
    for (const int frame : {1, 3})
      REQUIRE(second->add_frame(frame, sample::images(header, frame), sample::measure(frame)));
    REQUIRE(second->finish().ok());
    CHECK(sample::bytes_of(folder / "c.h5") == bytes);
  }
}

TEST_CASE("frames that do not belong are refused") {
  const sample::Folder folder;
  const ShowHeader header = sample::header(2, 20, 10, 1);
  Result<ShowWriter> writer = ShowWriter::start(folder / "a.h5", header, false, 1);
  REQUIRE(writer.ok());
  const FrameImages good = sample::images(header, 0);
  CHECK(writer->add_frame(2, good).fault().code == "show.frame");
  CHECK(writer->add_frame(-1, good).fault().code == "show.frame");
  FrameImages wrong = good;
  wrong.codes.pop_back();
  CHECK(writer->add_frame(0, wrong).fault().code == "show.frame");
  wrong = good;
  wrong.width_px = 19;
  CHECK(writer->add_frame(0, wrong).fault().code == "show.frame");
  REQUIRE(writer->add_frame(0, good).ok());
  CHECK(writer->add_frame(0, good).fault().code == "show.frame");
}

TEST_CASE("a measure without every object is spread over the project's list") {
  const sample::Folder folder;
  const ShowHeader header = sample::header(1, 20, 10, 1);
  Result<ShowWriter> writer = ShowWriter::start(folder / "a.h5", header, false, 1);
  REQUIRE(writer.ok());
  FrameMeasure only_second = sample::measure(0);
  only_second.objects.erase(only_second.objects.begin());
  REQUIRE(writer->add_frame(0, sample::images(header, 0), only_second).ok());
  FrameMeasure expected = sample::measure(0);
  expected.objects[0] = {};
  CHECK(sample::same(writer->measures()[0], expected));
  REQUIRE(writer->finish().ok());
  CHECK(sample::same(ShowReader::open(folder / "a.h5")->measures()[0], expected));
}

TEST_CASE("what the optimal assignment gained stands in the show, and in no other show") {
  const sample::Folder folder;
  const ShowHeader header = sample::header(2, 20, 10, 1);
  const auto write = [&](const char* name, bool optimal) {
    Result<ShowWriter> writer = ShowWriter::start(folder / name, header, false, 1);
    REQUIRE(writer.ok());
    for (int k = 0; k < 2; ++k) {
      FrameMeasure measure = sample::measure(k);
      if (optimal && k == 1) measure.optimal = {{7, 6, 1, 4480, 12.5, 0.25}, {8, 8, 0, 5120, 13.5, 0.5}};
      REQUIRE(writer->add_frame(k, sample::images(header, k), measure).ok());
    }
    REQUIRE(writer->finish().ok());
    return ShowReader::open(folder / name)->measures();
  };
  const auto measures = write("optimal.h5", true);
  CHECK(measures[0].optimal == PerEye<OptimalMeasure>{});
  CHECK(measures[1].optimal.left == OptimalMeasure{7, 6, 1, 4480, 12.5, 0.25});
  CHECK(measures[1].optimal.right == OptimalMeasure{8, 8, 0, 5120, 13.5, 0.5});
  CHECK(write("linear.h5", false)[1].optimal == PerEye<OptimalMeasure>{});
  CHECK(sample::bytes_of(folder / "optimal.h5").find("optimal_tiles") != std::string::npos);
  CHECK(sample::bytes_of(folder / "linear.h5").find("optimal_tiles") == std::string::npos);
}

TEST_CASE("frames may come from several threads at once") {
  const sample::Folder folder;
  const ShowHeader header = sample::header(16, 100, 70, 1);
  const std::string bytes = written(folder / "a.h5", header, in_order(16), 1);
  Result<ShowWriter> writer = ShowWriter::start(folder / "b.h5", header, false, 2);
  REQUIRE(writer.ok());
  std::atomic<int> next = 0;
  std::atomic<int> failures = 0;
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < 4; ++t) {
      threads.emplace_back([&] {
        for (int k = next++; k < header.frames; k = next++)
          if (!writer->add_frame(k, sample::images(header, k), sample::measure(k))) ++failures;
      });
    }
  }
  CHECK(failures == 0);
  REQUIRE(writer->finish().ok());
  CHECK(sample::bytes_of(folder / "b.h5") == bytes);
  const Result<ShowReader> show = ShowReader::open(folder / "b.h5");
  REQUIRE(show.ok());
  std::vector<std::jthread> readers;
  for (int t = 0; t < 4; ++t) {
    readers.emplace_back([&, t] {
      for (int k = t; k < header.frames; k += 4)
        if (show->frame(k)->codes != sample::images(header, k).codes) ++failures;
    });
  }
  readers.clear();
  CHECK(failures == 0);
}

TEST_CASE("a header that no show can hold is refused before a file is touched") {
  const sample::Folder folder;
  ShowHeader header = sample::header(2, 20, 10, 1);
  std::string where;
  SUBCASE("image") { header.schedule.slots[1].image = 5, where = "/projector/0/slot/image"; }
  SUBCASE("eye") { header.schedule.slots[0].eye = Side::right, where = "/projector/0/slot/eye"; }
  SUBCASE("order") {
    std::swap(header.schedule.slots[0].start_s, header.schedule.slots[1].start_s), where = "/projector/0/slot/start_s";
  }
  SUBCASE("power") { header.images[0].power_d = NAN, where = "/projector/0/image/power_d"; }
  SUBCASE("rows") { header.schedule.lens_power_d.right.pop_back(), where = "/lens/power_d"; }
  SUBCASE("drive") { header.schedule.lens_drive_a.left.push_back(0), where = "/lens/drive_a"; }
  SUBCASE("shutter") { header.schedule.shutter.right.close_s = INFINITY, where = "/shutter/right_s"; }
  SUBCASE("poses") { header.poses.pop_back(), where = "/pose/viewer"; }
  SUBCASE("objects") { header.poses[1].objects.pop_back(), where = "/pose/objects"; }
  SUBCASE("cue") { header.cues[0].frame = 2, where = "/cue/frame"; }
  SUBCASE("rate") { header.rate_hz = 0, where = "/ attribute rate_hz"; }
  SUBCASE("size") { header.width_px = 0, where = "/projector/0/images"; }
  SUBCASE("channels") { header.channels = 2, where = "/projector/0/images"; }
  SUBCASE("asset order") { std::swap(header.assets[0], header.assets[1]), where = "/asset/" + header.assets[1].sha256; }
  SUBCASE("asset bytes") {
    header.assets[0].bytes = SharedBytes(header.assets[0].bytes.begin(), header.assets[0].bytes.end() - 1),
    where = "/asset/" + header.assets[0].sha256;
  }
  SUBCASE("another project's surfaces") { header.project_text = sample::project_text(2, 2), where = "/pose/surfaces"; }
  SUBCASE("another project's objects") { header.project_text = sample::project_text(1, 1), where = "/pose/objects"; }
  SUBCASE("another project's slices") { header.images[1].slice = 2, where = "/projector/0/image/slice"; }
  SUBCASE("text") { header.project_text += '\0', where = "/project"; }
  const auto writer = ShowWriter::start(folder / "a.h5", header, false, 1);
  REQUIRE_FALSE(writer.ok());
  CHECK(writer.fault().code == "show.invalid");
  CHECK(writer.fault().where == (folder / "a.h5").string() + ": " + where);
  CHECK(fs::is_empty(folder.path()));
}

}  // namespace
}  // namespace focalstage
