#include "devices/player/frame_cache.h"

#include <chrono>
#include <mutex>
#include <set>
#include <thread>

#include <doctest/doctest.h>

#include "tests/devices/sample_show.h"

namespace focalstage {
namespace {

struct Read {
  std::mutex mutex;
  std::multiset<int> frames;
};

class WatchedFrames : public sample::CountedFrames {
 public:
  explicit WatchedFrames(std::shared_ptr<Read> read) : CountedFrames(4), read_(std::move(read)) {}
  Result<FrameImages> frame(int frame) override {
    const std::lock_guard lock(read_->mutex);
    read_->frames.insert(frame);
    return CountedFrames::frame(frame);
  }

 private:
  std::shared_ptr<Read> read_;
};

TEST_CASE("the right frame comes, in any order, however small the memory") {
  FrameCache cache(std::make_unique<sample::CountedFrames>(4), 12, 1 << 20, 1);
  for (const int frame : {0, 1, 2, 11, 0, 5, 4, 3, 7, 7}) {
    const auto got = cache.wait_for(frame);
    REQUIRE(got);
    CHECK((*got)->codes[0] == 16 * frame + 1);
  }
}

TEST_CASE("where there is memory for the whole show, each frame is read once") {
  const auto read = std::make_shared<Read>();
  {
    FrameCache cache(std::make_unique<WatchedFrames>(read), 6, 128);
    for (int n = 0; n < 60; ++n) REQUIRE(cache.wait_for(n % 6));
  }
  CHECK(read->frames == std::multiset<int>{0, 1, 2, 3, 4, 5});
}

TEST_CASE("frames after the one asked for are read without being asked for, across the end") {
  const auto read = std::make_shared<Read>();
  FrameCache cache(std::make_unique<WatchedFrames>(read), 6, 128);
  REQUIRE(cache.wait_for(4));
  const auto all_read = [&] {
    const std::lock_guard lock(read->mutex);
    return read->frames.size() >= 6;
  };
  for (int n = 0; n < 5000 && !all_read(); ++n) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const std::lock_guard lock(read->mutex);
  CHECK(read->frames == std::multiset<int>{0, 1, 2, 3, 4, 5});
}

TEST_CASE("a fault of the source comes out for its frame alone, and a cache that is busy ends") {
  class OneBad : public sample::CountedFrames {
   public:
    OneBad() : CountedFrames(4) {}
    Result<FrameImages> frame(int frame) override {
      if (frame == 2) return Fault{"show.damaged", "frame 2", "broken", ""};
      return CountedFrames::frame(frame);
    }
  };
  FrameCache cache(std::make_unique<OneBad>(), 100, 1 << 20);
  CHECK(cache.wait_for(1));
  CHECK(cache.wait_for(2).fault().where == "frame 2");
  CHECK(cache.wait_for(3));
}

}  // namespace
}  // namespace focalstage
