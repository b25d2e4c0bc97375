#include "io/export/export.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <set>
#include <string>

#include "io/export/image_name.h"
#include "io/export/tables.h"
#include "io/export/vcd.h"
#include "io/image/png.h"
#include "io/show/writer.h"
#include "tests/io/show/sample.h"

namespace focalstage {
namespace {

namespace fs = std::filesystem;

ShowReader show_at(const fs::path& path, const ShowHeader& header) {
  Result<ShowWriter> writer = ShowWriter::start(path, header, false, 1);
  REQUIRE(writer.ok());
  for (int k = 0; k < header.frames; ++k) REQUIRE(writer->add_frame(k, sample::images(header, k)).ok());
  REQUIRE(writer->finish().ok());
  Result<ShowReader> show = ShowReader::open(path);
  REQUIRE(show.ok());
  return std::move(*show);
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

TEST_CASE("an image's name tells eye and power, and is its own") {
  CHECK(image_names({{ImageEye::left, ImageKind::content, 0.5, 0},
                     {ImageEye::right, ImageKind::content, -1.25, 1},
                     {ImageEye::both, ImageKind::surface_light, -0.0, -1},
                     {ImageEye::right, ImageKind::content, -0.004, 2}}) ==
        std::vector<std::string>{"left-+0.50D", "right--1.25D", "both-+0.00D", "right-+0.00D"});
  // 0.501 and 0.499 D both read 0.50.
  CHECK(image_names({{ImageEye::left, ImageKind::content, 0.501, 0},
                     {ImageEye::left, ImageKind::content, 1, 1},
                     {ImageEye::left, ImageKind::content, 0.499, 2}}) ==
        std::vector<std::string>{"left-+0.50D-0", "left-+1.00D", "left-+0.50D-2"});
  CHECK(image_file_name(7, 600, "left-+0.50D") == "frame-0007-left-+0.50D.png");
  CHECK(image_file_name(7, 10000, "x") == "frame-0007-x.png");
  CHECK(image_file_name(7, 10001, "x") == "frame-00007-x.png");
}

TEST_CASE("the tables hold the schedule to the last bit") {
  ShowHeader header = sample::header(1, 20, 10, 1);
  header.images = {{ImageEye::left, ImageKind::content_and_light, 0, 0},
                   {ImageEye::right, ImageKind::content, -0.5, 1}};
  header.schedule.period_s = 0.01;
  header.schedule.slots = {{0, Side::left, 0.1, 0.0005, -0.001, 1.0 / 3.0, 0.25}, {1, Side::right, 2, 1, 1, -0.5, 0}};
  header.schedule.lens_power_d = {{-1, 1}, {-1.5, 0.75}};
  header.schedule.lens_drive_a = {{-0.025, 0.025}, {-0.02, 1e-7}};
  CHECK(schedule_csv(header) ==
        "slot,image,eye,kind,slice,start_s,exposure_s,trigger_s,power_d,smear_d\n"
        "0,0,left,content+light,0,0.1,5e-04,-0.001,0.3333333333333333,0.25\n"
        "1,1,right,content,1,2,1,1,-0.5,0\n");
  CHECK(waveform_csv(header) ==
        "time_s,left_power_d,right_power_d,left_drive_a,right_drive_a\n"
        "0,-1,-1.5,-0.025,-0.02\n"
        "0.005,1,0.75,0.025,1e-07\n");
}

TEST_CASE("an export holds every image to the pixel, and is the same each time") {
  const sample::Folder folder;
  for (const int channels : {1, 3}) {
    const ShowHeader header = sample::header(2, 40, 30, channels);
    const ShowReader show = show_at(folder / "a.h5", header);
    fs::remove_all(folder / "out");
    int told = 0;
    REQUIRE(export_show(show, folder / "out/deep", [&](int done, int total) { told += 10 * done + total; }).ok());
    CHECK(told == 12 + 22);
    const std::vector<std::string> names = names_in(folder / "out/deep");
    CHECK(names == std::vector<std::string>{
                       "frame-0000-both-+0.00D.png", "frame-0000-left-+0.50D.png", "frame-0000-left--0.50D.png",
                       "frame-0000-right-+0.50D.png", "frame-0000-right--0.50D.png", "frame-0001-both-+0.00D.png",
                       "frame-0001-left-+0.50D.png", "frame-0001-left--0.50D.png", "frame-0001-right-+0.50D.png",
                       "frame-0001-right--0.50D.png", "schedule.csv", "timing.vcd", "waveform.csv"});
    CHECK(sample::bytes_of(folder / "out/deep/timing.vcd") == timing_vcd(header));
    CHECK(sample::bytes_of(folder / "out/deep/schedule.csv") == schedule_csv(header));
    CHECK(sample::bytes_of(folder / "out/deep/waveform.csv") == waveform_csv(header));

    const FrameImages images = sample::images(header, 1);
    const std::string png = sample::bytes_of(folder / "out/deep/frame-0001-left-+0.50D.png");
    const Result<Texture> picture = decode_image(std::as_bytes(std::span(png)), "png");
    REQUIRE(picture.ok());
    REQUIRE(picture->width_px == 40);
    REQUIRE(picture->height_px == 30);
    std::size_t different = 0;
    for (std::size_t pixel = 0; pixel < 40 * 30; ++pixel) {
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t channel = channels == 3 ? c : 0;
        const std::uint8_t code = images.image(1)[pixel * static_cast<std::size_t>(channels) + channel];
        if (picture->rgba[4 * pixel + c] != code) ++different;
      }
    }
    CHECK(different == 0);

    REQUIRE(export_show(show, folder / "again").ok());
    for (const std::string& name : names)
      CHECK(sample::bytes_of(folder / "again" / name) == sample::bytes_of(folder / "out/deep" / name));
    fs::remove_all(folder / "again");
  }
}

TEST_CASE("an export that cannot be, or is stopped, says so") {
  const sample::Folder folder;
  const ShowReader show = show_at(folder / "a.h5", sample::header(2, 20, 10, 1));
  CHECK(export_show(show, folder / "a.h5").fault().code == "export.folder");
  CHECK(export_show(show, folder / "a.h5/deeper").fault().code == "export.folder");
  fs::create_directories(folder / "taken/schedule.csv/x");
  CHECK(export_show(show, folder / "taken").fault().code == "file.unwritable");
  std::stop_source stop;
  const auto stop_after_one = [&](int, int) { stop.request_stop(); };
  CHECK(export_show(show, folder / "out", stop_after_one, stop.get_token()).fault().code == "export.cancelled");
  CHECK(names_in(folder / "out").size() == 3 + 5);
}

}  // namespace
}  // namespace focalstage
