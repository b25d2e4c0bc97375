#include "devices/display/queued_display.h"

#include <doctest/doctest.h>

#include <atomic>
#include <string>
#include <vector>

using namespace focalstage;

namespace {

/// An output that notes what becomes of it, in order.
class NotedDisplay final : public QueuedDisplay {
 public:
  NotedDisplay() : QueuedDisplay(2) {}
  ~NotedDisplay() override { close(); }

  VideoMode mode() const override { return {2, 1, 0.01}; }

  void lose() { queue_.lose({"display.lost", "display", "unplugged", ""}); }
  FrameQueue& frames() { return queue_; }

  bool absent = false;
  std::vector<std::string> noted;

 private:
  Result<std::jthread> take() override {
    noted.emplace_back("take");
    if (absent) return Fault{"display.absent", "display", "there is none", ""};
    queue_.open(2);
    return std::jthread([this](const std::stop_token& stop) {
      while (!stop.stop_requested()) std::this_thread::yield();
      ended_ = true;
    });
  }
  void give_back() override { noted.emplace_back(ended_.exchange(false) ? "give back" : "nothing"); }

  std::atomic<bool> ended_ = false;
};

VideoFrame frame() { return std::make_shared<const std::vector<std::uint32_t>>(2U, 7U); }

using Words = std::vector<std::string>;

}  // namespace

TEST_CASE("an output is taken once, and given back when its thread is through") {
  NotedDisplay display;
  CHECK(display.post(frame()).fault().code == "display.lost");
  REQUIRE(display.open().ok());
  REQUIRE(display.open().ok());
  CHECK(display.noted == Words{"nothing", "take"});
  display.close();
  CHECK(display.noted == Words{"nothing", "take", "give back"});
  CHECK(display.post(frame()).fault().code == "display.lost");
}

TEST_CASE("opened after a loss, the output is given back before it is taken again") {
  NotedDisplay display;
  REQUIRE(display.open().ok());
  display.lose();
  CHECK(display.post(frame()).fault().code == "display.lost");
  CHECK(display.report().fault.has_value());
  REQUIRE(display.open().ok());
  CHECK(display.noted == Words{"nothing", "take", "give back", "take"});
  CHECK_FALSE(display.report().fault.has_value());
  CHECK(display.post(frame()).ok());
}

TEST_CASE("what cannot be taken is closed, and may be there the next time") {
  NotedDisplay display;
  display.absent = true;
  CHECK(display.open().fault().code == "display.absent");
  CHECK(display.post(frame()).fault().code == "display.lost");
  display.absent = false;
  CHECK(display.open().ok());
  CHECK(display.post(frame()).ok());
}

TEST_CASE("frames wait until they are taken or made black") {
  NotedDisplay display;
  REQUIRE(display.open().ok());
  REQUIRE(display.post(frame()).ok());
  REQUIRE(display.post(nullptr).ok());
  CHECK(display.post(frame()).fault().code == "display.full");
  CHECK(display.waiting() == 2);
  CHECK(display.frames().take() != nullptr);
  CHECK(display.waiting() == 1);
  display.black();
  CHECK(display.waiting() == 0);
  CHECK(display.frames().take() == nullptr);
}
