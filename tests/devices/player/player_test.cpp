#include "devices/player/player.h"

#include <condition_variable>
#include <mutex>

#include <doctest/doctest.h>

#include "tests/devices/player/recording_rig.h"
#include "tests/devices/sample_show.h"

namespace focalstage {
namespace {

constexpr double period_s = 1.0 / 60.0;

struct Stand {
  RecordingRig rig;
  LimitedRig limited;
  Player player;
  double next_s = 1.0;

  explicit Stand(AtEnd at_end = AtEnd::loop, bool wait = true) : limited(rig, {}), player(limited, {at_end, 2, wait}) {}

  std::vector<AskedSweep> sweeps(int count) {
    std::vector<AskedSweep> asked;
    for (int n = 0; n < count; ++n) {
      asked.push_back(player.hand_over(next_s));
      next_s += period_s;
    }
    return asked;
  }

  /// The first code of each sweep's images; 0 where nothing was shown.
  std::vector<int> first_codes() const {
    std::vector<int> codes;
    for (const auto& sweep : rig.sweeps) codes.push_back(sweep.codes.empty() ? 0 : sweep.codes[0]);
    return codes;
  }
};

TEST_CASE("a sweep is given as drive, images in the order of the exposures, edge, triggers and shutters") {
  Stand stand;
  stand.player.activate(sample::counted(1));
  CHECK(stand.player.state() == PlayState::ready);
  REQUIRE(stand.player.play());
  stand.sweeps(4);
  REQUIRE(stand.rig.sweeps.size() == 4);
  CHECK(stand.rig.exposure_s_ == 0.0005);
  CHECK(stand.rig.sweeps[0].new_drive);
  CHECK_FALSE(stand.rig.sweeps[1].new_drive);
  for (const int settling : {0, 1}) {
    CHECK(stand.rig.sweeps[static_cast<std::size_t>(settling)].trigger_s.empty());
    CHECK(stand.rig.sweeps[static_cast<std::size_t>(settling)].codes.empty());
  }
  CHECK(stand.rig.sweeps[2].codes == std::vector{1, 2, 3, 4});
  REQUIRE(stand.rig.sweeps[2].trigger_s.size() == 4);
  CHECK(stand.rig.sweeps[2].trigger_s[0] == doctest::Approx(0.00285));
  CHECK(stand.rig.sweeps[2].trigger_s[3] == doctest::Approx(0.01335));
  CHECK(stand.rig.sweeps[2].shutter_commands == 4);
}

TEST_CASE("each frame plays for its whole number of sweeps, and the show begins again or is held") {
  // 20 frames a second at 60 sweeps: 3 sweeps each. Codes are 16 * frame + 1.
  Stand loops;
  loops.player.activate(sample::counted(2, 0, 20.0));
  REQUIRE(loops.player.play());
  loops.sweeps(2 + 8);
  CHECK(loops.first_codes() == std::vector{0, 0, 1, 1, 1, 17, 17, 17, 1, 1});

  Stand holds(AtEnd::hold);
  holds.player.activate(sample::counted(2, 0, 20.0));
  REQUIRE(holds.player.play());
  holds.sweeps(2 + 8);
  CHECK(holds.first_codes() == std::vector{0, 0, 1, 1, 1, 17, 17, 17, 17, 17});
  CHECK(holds.player.state() == PlayState::holding);
}

TEST_CASE("hold repeats the frame, play goes on from it, a number of sweeps ends in hold") {
  Stand stand;
  stand.player.activate(sample::counted(5));
  REQUIRE(stand.player.play());
  stand.sweeps(3);
  REQUIRE(stand.player.hold());
  stand.sweeps(2);
  REQUIRE(stand.player.play(2));
  stand.sweeps(4);
  CHECK(stand.first_codes() == std::vector{0, 0, 1, 17, 17, 17, 33, 49, 49});
  CHECK(stand.player.state() == PlayState::holding);
}

TEST_CASE("a cue jumps to its frame; an unknown one is refused") {
  ShowHeader header = sample::header(5);
  header.cues = {{"start", 0}, {"bow", 3}};
  Stand stand;
  CHECK(stand.player.cue("bow").fault().code == "rig.refused");
  stand.player.activate(sample::loaded(header, std::make_unique<sample::CountedFrames>(4)));
  REQUIRE(stand.player.play());
  stand.sweeps(3);
  REQUIRE(stand.player.cue("bow"));
  stand.sweeps(2);
  CHECK(stand.first_codes() == std::vector{0, 0, 1, 49, 65});
  CHECK(stand.player.cue("curtain").fault().where == "cue \"curtain\"");
}

TEST_CASE("next and back go from cue to cue, wherever the show stands between them") {
  ShowHeader header = sample::header(9);
  header.cues = {{"bow", 6}, {"start", 2}, {"again", 6}, {"middle", 4}, {"beyond", 9}};
  Stand stand;
  CHECK(stand.player.next().fault().code == "rig.refused");
  stand.player.activate(sample::loaded(header, std::make_unique<sample::CountedFrames>(4)));
  const auto frame = [&] { return stand.player.frame(); };
  CHECK_FALSE(stand.player.back());
  REQUIRE(stand.player.next());
  CHECK(frame() == 2);
  CHECK(stand.player.back().fault().message.find("before") != std::string::npos);
  CHECK(frame() == 2);
  REQUIRE(stand.player.next());
  REQUIRE(stand.player.next());
  CHECK(frame() == 6);
  CHECK(stand.player.next().fault().message.find("after") != std::string::npos);
  CHECK(frame() == 6);
  REQUIRE(stand.player.back());
  CHECK(frame() == 4);
  REQUIRE(stand.player.play());
  stand.sweeps(3);  // two to settle; then frame 5 is next, which still follows the cue at 4
  CHECK(frame() == 5);
  REQUIRE(stand.player.back());
  CHECK(frame() == 2);
}

TEST_CASE("a cue whose frame is not there yet is followed when it is; until then the show goes on") {
  class SlowBow : public sample::CountedFrames {
   public:
    explicit SlowBow(std::shared_ptr<std::mutex> gate) : CountedFrames(4), gate_(std::move(gate)) {}
    Result<FrameImages> frame(int frame) override {
      if (frame == 7) const std::lock_guard wait(*gate_);
      return CountedFrames::frame(frame);
    }

   private:
    std::shared_ptr<std::mutex> gate_;
  };
  const auto gate = std::make_shared<std::mutex>();
  ShowHeader header = sample::header(9);
  header.cues = {{"bow", 7}};
  auto show = std::make_shared<LoadedShow>(LoadedShow{"a", header, *sweep_plan(header, 8), nullptr});
  Stand stand(AtEnd::loop, false);
  {
    // Memory for three frames: the cue's frame is beyond what is read ahead.
    show->frames = std::make_unique<FrameCache>(std::make_unique<SlowBow>(gate), 9, 1 << 20, 1);
    const std::lock_guard shut(*gate);
    REQUIRE(show->frames->wait_for(0));
    while (!show->frames->prepare(1)) {
    }
    stand.player.activate(show);
    REQUIRE(stand.player.play());
    stand.sweeps(3);
    REQUIRE(stand.player.cue("bow"));
    stand.sweeps(1);
    CHECK(stand.first_codes() == std::vector{0, 0, 1, 17});
  }
  while (!show->frames->prepare(7)) {
  }
  stand.sweeps(1);
  CHECK(stand.first_codes().back() == 113);
}

TEST_CASE("blackout is dark at once and stays until go") {
  Stand stand;
  stand.player.activate(sample::counted(1));
  REQUIRE(stand.player.play());
  stand.sweeps(3);
  stand.player.blackout(1.04);
  CHECK(stand.rig.dark_s == std::vector{1.04});
  CHECK(stand.player.state() == PlayState::dark);
  CHECK_FALSE(stand.player.running());
  CHECK(stand.player.play().fault().code == "rig.refused");
  CHECK(stand.player.hold().fault().code == "rig.refused");
  REQUIRE(stand.player.go());
  CHECK(stand.player.state() == PlayState::ready);
  REQUIRE(stand.player.play());
  stand.next_s = 2.0;
  stand.sweeps(3);
  CHECK(stand.rig.sweeps[3].new_drive);
  CHECK(stand.first_codes() == std::vector{0, 0, 1, 0, 0, 1});
}

TEST_CASE("without a show nothing plays, and going dark and back leaves it empty") {
  Stand stand;
  CHECK(stand.player.play().fault().where == "show");
  stand.player.blackout(0.5);
  CHECK(stand.player.state() == PlayState::dark);
  REQUIRE(stand.player.go());
  CHECK(stand.player.state() == PlayState::empty);
}

TEST_CASE("another show takes over as one step at a sweep boundary") {
  Stand stand;
  stand.player.activate(sample::counted(2));
  REQUIRE(stand.player.play());
  stand.sweeps(3);
  stand.player.activate(sample::counted(2, 100));
  const auto asked = stand.sweeps(3);
  // Lens and shutters go on as they are: not one sweep is dark, and each belongs to one show alone.
  CHECK(stand.first_codes() == std::vector{0, 0, 1, 101, 117, 101});
  for (const AskedSweep& sweep : asked) CHECK(sweep.show->sha256 == "b");
  CHECK(stand.rig.sweeps[3].codes == std::vector{101, 102, 103, 104});
}

TEST_CASE("where another show moves lens or shutters otherwise, they settle in darkness") {
  ShowHeader header = sample::header(1);
  header.schedule.lens_drive_a.left[3] = 0.026;
  Stand stand;
  stand.player.activate(sample::counted(1));
  REQUIRE(stand.player.play());
  stand.sweeps(3);
  stand.player.activate(sample::loaded(header, std::make_unique<sample::CountedFrames>(4, 100), "b"));
  stand.sweeps(3);
  CHECK(stand.first_codes() == std::vector{0, 0, 1, 0, 0, 101});
}

/// Gives no frame until told to.
class LateFrames : public sample::CountedFrames {
 public:
  struct Gate {
    std::mutex mutex;
    std::condition_variable opened;
    bool open = false;

    void let_pass() {
      const std::lock_guard lock(mutex);
      open = true;
      opened.notify_all();
    }
  };

  explicit LateFrames(std::shared_ptr<Gate> gate) : CountedFrames(4, 100), gate_(std::move(gate)) {}

  Result<FrameImages> frame(int frame) override {
    std::unique_lock lock(gate_->mutex);
    gate_->opened.wait(lock, [&] { return gate_->open; });
    return CountedFrames::frame(frame);
  }

 private:
  std::shared_ptr<Gate> gate_;
};

TEST_CASE("a frame that is not there in time leaves its sweep dark and is counted; never another frame") {
  const auto gate = std::make_shared<LateFrames::Gate>();
  Stand stand(AtEnd::loop, false);
  const auto show = sample::loaded(sample::header(1), std::make_unique<LateFrames>(gate));
  stand.player.activate(show);
  REQUIRE(stand.player.play());
  const auto dark = stand.sweeps(4);
  CHECK_FALSE(dark[1].missed);  // settling: nothing was due
  CHECK(dark[2].missed);
  CHECK(dark[3].missed);
  CHECK(stand.rig.sweeps[3].trigger_s.empty());
  CHECK(stand.rig.sweeps[3].codes.empty());
  gate->let_pass();
  REQUIRE(show->frames->wait_for(0));
  const auto lit = stand.sweeps(1);
  CHECK(lit[0].lit);
  CHECK_FALSE(lit[0].missed);
}

TEST_CASE("a show whose first frame is still being read does not interrupt the one that plays") {
  const auto gate = std::make_shared<LateFrames::Gate>();
  Stand stand(AtEnd::loop, false);
  const auto first = sample::counted(1);
  REQUIRE(first->frames->wait_for(0));
  stand.player.activate(first);
  REQUIRE(stand.player.play());
  stand.sweeps(3);
  const auto second = sample::loaded(sample::header(1), std::make_unique<LateFrames>(gate), "b");
  stand.player.activate(second);
  stand.sweeps(2);
  CHECK(stand.first_codes() == std::vector{0, 0, 1, 1, 1});
  gate->let_pass();
  REQUIRE(second->frames->wait_for(0));
  stand.sweeps(1);
  CHECK(stand.first_codes().back() == 101);
}

class DamagedFrames : public sample::CountedFrames {
 public:
  DamagedFrames() : CountedFrames(4) {}
  Result<FrameImages> frame(int frame) override {
    if (frame == 1) return Fault{"show.damaged", "frame 1", "it cannot be read", ""};
    return CountedFrames::frame(frame);
  }
};

TEST_CASE("a frame that cannot be read ends in latched darkness") {
  Stand stand;
  stand.player.activate(sample::loaded(sample::header(3), std::make_unique<DamagedFrames>()));
  REQUIRE(stand.player.play());
  const auto asked = stand.sweeps(4);
  CHECK(asked[2].lit);
  CHECK(asked[3].missed);
  CHECK(stand.player.state() == PlayState::dark);
  REQUIRE(stand.player.fault());
  CHECK(stand.player.fault()->code == "show.damaged");
  CHECK(stand.rig.dark_s.size() == 1);
}

TEST_CASE("a show beyond a limit goes dark before it is seen") {
  ShowHeader header = sample::header(1);
  header.schedule.lens_drive_a.right[7] = -0.31;
  Stand stand;
  stand.player.activate(sample::loaded(header, std::make_unique<sample::CountedFrames>(4)));
  REQUIRE(stand.player.play());
  stand.sweeps(1);
  CHECK(stand.player.state() == PlayState::dark);
  CHECK(stand.player.fault()->code == "limit.lens-current");
  CHECK(stand.rig.sweeps.empty());
  CHECK(stand.rig.dark_s.size() == 1);
}

}  // namespace
}  // namespace focalstage
