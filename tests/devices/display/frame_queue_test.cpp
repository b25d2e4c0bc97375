#include "devices/display/frame_queue.h"

#include <doctest/doctest.h>

namespace focalstage {
namespace {

VideoFrame frame_of(std::uint32_t pixel) { return std::make_shared<const std::vector<std::uint32_t>>(4, pixel); }

TEST_CASE("frames come in order, and black where there is none") {
  FrameQueue queue(2);
  CHECK(queue.post(frame_of(1)).fault().code == "display.lost");
  queue.open(4);
  REQUIRE(queue.post(frame_of(1)).ok());
  REQUIRE(queue.post(nullptr).ok());
  CHECK(queue.post(frame_of(2)).fault().code == "display.full");
  CHECK(queue.waiting() == 2);
  CHECK(queue.take()->front() == 1);
  queue.shown(1.0, 0);
  CHECK_FALSE(queue.take());
  queue.shown(2.0, 3);
  CHECK_FALSE(queue.take());
  queue.shown(3.0, 0);
  const DisplayReport report = queue.report();
  CHECK(report.vblanks == 6);
  CHECK(report.shown == 1);
  CHECK(report.dark == 1);
  CHECK(report.silent == 1);
  CHECK(report.repeated == 3);
  CHECK(report.newest_vblank_s == 3.0);
}

TEST_CASE("what waits can be forgotten; what is lost or closed takes nothing") {
  FrameQueue queue(2);
  queue.open(4);
  REQUIRE(queue.post(frame_of(1)).ok());
  queue.forget();
  CHECK_FALSE(queue.take());
  CHECK(queue.post(std::make_shared<const std::vector<std::uint32_t>>(5, 0U)).fault().code == "display.size");
  queue.lose({"display.lost", "display", "gone", ""});
  CHECK(queue.post(frame_of(1)).fault().code == "display.lost");
  CHECK(queue.report().fault);
  queue.open(4);
  CHECK_FALSE(queue.report().fault);
  REQUIRE(queue.post(frame_of(1)).ok());
  queue.close();
  CHECK(queue.waiting() == 0);
  CHECK_FALSE(queue.post(frame_of(1)).ok());
}

}  // namespace
}  // namespace focalstage
