#include "devices/runtime/live_thread.h"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <thread>

#include <doctest/doctest.h>

#include "devices/roles/clock.h"
#include "devices/runtime/rig_thread.h"
#include "io/files/files.h"
#include "io/project/project_file.h"
#include "tests/devices/runtime/fake_tracker.h"
#include "tests/devices/runtime/live_project.h"

namespace focalstage {
namespace {

/// A live thread with a tracker, without a rig: what it makes is counted.
struct Stand {
  sample::Folder folder;
  std::unique_ptr<AssetStore> assets;
  std::shared_ptr<sample::FakeTracker> tracker = std::make_shared<sample::FakeTracker>();
  std::unique_ptr<LiveTracking> tracking;
  RigThreadSettings rig;
  std::mutex mutex;
  std::vector<LiveMade> made;
  std::vector<std::uint64_t> revisions;
  std::vector<Fault> refused;
  std::unique_ptr<LiveThread> thread;

  explicit Stand(TrackerSetup setup = {}) {
    rig.rig = simulated_rig(sample::sim());
    assets = std::move(*AssetStore::open(folder.path()));
    setup.tracker = tracker;
    tracking = std::make_unique<LiveTracking>(std::move(setup), 0.1, [](const Fault&) {});
    REQUIRE(tracking->start().ok());
    thread = std::make_unique<LiveThread>(
        *assets, RigTerms{[this](double hz) { return rig.rig.describe(rig.limits, hz); }, rig.limits}, tracking.get(),
        LiveResults{[this](const LiveSnapshot& snapshot, LiveMade one) {
                      const std::lock_guard lock(mutex);
                      revisions.push_back(snapshot.revision);
                      made.push_back(std::move(one));
                    },
                    [this](std::uint64_t, const Fault& fault) {
                      const std::lock_guard lock(mutex);
                      refused.push_back(fault);
                    }});
  }

  void send(std::uint64_t revision, const Project& project) {
    const std::string text = project_text(project);
    thread->add(ProjectChange{revision, monotonic_s(), sha256_hex(text), 0, {}});
    thread->add(LiveBlob{sha256_hex(text), text});
  }
  std::size_t count() {
    const std::lock_guard lock(mutex);
    return made.size();
  }
  bool wait_made() {
    for (int n = 0; n < 5000 && count() == 0; ++n) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    return count() > 0;
  }
};

Project tracked_project() {
  Project project = sample::live_project();
  project.objects[0].placement.track = "Card";
  return project;
}

TrackedBody card(double z_m = -0.8) { return {7, "Card", true, {{0.0, 0.0, z_m}, {}}, 0.0}; }

TEST_CASE("as bodies move it is compiled again, at most once per sweep, and only the first says so") {
  Stand stand;
  stand.tracker->see({card()});
  stand.send(1, tracked_project());
  REQUIRE(stand.wait_made());
  const double begun_s = monotonic_s();
  const std::size_t before = stand.count();
  std::this_thread::sleep_for(std::chrono::milliseconds(1000));
  const auto compiled = static_cast<double>(stand.count() - before);
  const double passed_s = monotonic_s() - begun_s;
  CHECK(compiled <= 60.0 * passed_s + 2.0);
  CHECK(compiled >= 5.0);  // a crowded machine may not come to sixty
  const std::lock_guard lock(stand.mutex);
  for (std::size_t i = 0; i < stand.made.size(); ++i) {
    CHECK(stand.made[i].first == (i == 0));
    REQUIRE(stand.made[i].posed);
    CHECK(stand.made[i].posed->bodies == std::set<std::string>{"Card"});
    if (i > 0) CHECK(stand.made[i].posed->frame > stand.made[i - 1].posed->frame);
  }
}

TEST_CASE("a tracker that says nothing new, or a project without tracked things, is compiled once") {
  for (const bool tracked : {true, false}) {
    Stand stand;
    stand.tracker->see({card()});
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    if (tracked) stand.tracker->stream(false);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    stand.send(1, tracked ? tracked_project() : sample::live_project());
    REQUIRE(stand.wait_made());
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    CHECK(stand.count() == 1);
  }
}

TEST_CASE("the newest edit wins while poses come") {
  Stand stand;
  stand.tracker->see({card()});
  stand.send(1, tracked_project());
  REQUIRE(stand.wait_made());
  stand.send(2, sample::live_project());
  for (int n = 0; n < 5000; ++n) {
    {
      const std::lock_guard lock(stand.mutex);
      if (stand.revisions.back() == 2) break;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  const std::lock_guard lock(stand.mutex);
  CHECK(stand.revisions.back() == 2);
  CHECK(std::ranges::is_sorted(stand.revisions));
  CHECK_FALSE(stand.made.back().posed);
}

}  // namespace
}  // namespace focalstage
