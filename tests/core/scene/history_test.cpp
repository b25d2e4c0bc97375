#include "core/scene/history.h"

#include <doctest/doctest.h>

using namespace focalstage;

namespace {

Project start() {
  Project project;
  project.projectors.push_back({});
  project.projectors[0].name = "main";
  project.slices.powers_d = {0.0};
  return project;
}

Edit pupils_edit(double mm) { return {Edit::Kind::set, "viewer", "", "interpupillary_mm", Value(mm)}; }
Edit aperture_edit(double mm) { return {Edit::Kind::set, "glasses", "", "lens_aperture_mm", Value(mm)}; }
Step pupils(double mm) { return {"Set pupils", {pupils_edit(mm)}}; }
Step aperture(double mm) { return {"Set aperture", {aperture_edit(mm)}}; }

double pupils_of(const History& history) { return history.now()->viewer.interpupillary_mm; }

}  // namespace

TEST_CASE("undo and redo walk through every state, however long the history") {
  History history(start());
  for (int i = 1; i <= 50; ++i) REQUIRE(history.apply(pupils(i)).ok());
  for (int i = 49; i >= 1; --i) {
    history.undo();
    CHECK(pupils_of(history) == i);
  }
  history.undo();
  CHECK(*history.now() == start());
  CHECK_FALSE(history.can_undo());
  history.undo();
  CHECK(*history.now() == start());
  for (int i = 1; i <= 50; ++i) {
    history.redo();
    CHECK(pupils_of(history) == i);
  }
  CHECK_FALSE(history.can_redo());
  for (const std::size_t place : {17u, 3u, 33u, 48u, 16u}) {
    history.jump(place);
    CHECK(history.place() == place);
    CHECK(pupils_of(history) == static_cast<double>(place));
  }
  history.jump(1000);
  CHECK(pupils_of(history) == 50);
}

TEST_CASE("an edit after undo forgets what was undone, also its snapshots") {
  History history(start());
  for (int i = 1; i <= 40; ++i) REQUIRE(history.apply(pupils(i)).ok());
  history.jump(10);
  for (int i = 1; i <= 30; ++i) REQUIRE(history.apply(pupils(100 + i)).ok());
  CHECK(history.steps().size() == 40);
  CHECK_FALSE(history.can_redo());
  for (std::size_t place = 40; place > 10; --place) {
    history.jump(place);
    CHECK(pupils_of(history) == 100.0 + static_cast<double>(place - 10));
  }
  history.undo();
  CHECK(pupils_of(history) == 10);
}

TEST_CASE("a fault changes nothing") {
  History history(start());
  REQUIRE(history.apply(pupils(60)).ok());
  history.undo();
  const auto before = history.now();
  const auto revision = history.revision();
  CHECK_FALSE(history.apply(pupils(-1)).ok());
  CHECK_FALSE(history.apply(pupils(-1), Joining::continues_last).ok());
  CHECK(history.now() == before);
  CHECK(history.revision() == revision);
  CHECK(history.can_redo());
}

TEST_CASE("a drag is one step of undo, but only on the same key and at the end") {
  History history(start());
  REQUIRE(history.apply(pupils(60)).ok());
  REQUIRE(history.apply(pupils(61), Joining::continues_last).ok());
  REQUIRE(history.apply(pupils(62), Joining::continues_last).ok());
  CHECK(history.steps() == std::vector<Step>{pupils(62)});
  REQUIRE(history.apply(aperture(20), Joining::continues_last).ok());
  CHECK(history.steps().size() == 2);
  history.undo();
  CHECK(pupils_of(history) == 62);
  // A step undone and gone on from elsewhere is no drag.
  REQUIRE(history.apply(pupils(63), Joining::continues_last).ok());
  CHECK(history.steps() == std::vector<Step>{pupils(62), pupils(63)});
  history.undo();
  history.undo();
  CHECK(*history.now() == start());
}

TEST_CASE("a drag over many snapshots replays to what was shown") {
  History history(start());
  for (int i = 1; i <= 16; ++i) REQUIRE(history.apply(pupils(i)).ok());  // a snapshot is kept at 16
  REQUIRE(history.apply(pupils(99), Joining::continues_last).ok());
  CHECK(pupils_of(history) == 99);
  REQUIRE(history.apply(aperture(5)).ok());
  history.undo();
  CHECK(pupils_of(history) == 99);
  history.undo();
  CHECK(pupils_of(history) == 15);
}

TEST_CASE("revisions grow with every change, and snapshots stay what they were") {
  History history(start());
  const auto first = history.now();
  std::uint64_t last = history.revision();
  const auto grew = [&] { return std::exchange(last, history.revision()) < history.revision(); };
  REQUIRE(history.apply(pupils(60)).ok());
  CHECK(grew());
  history.undo();
  CHECK(grew());
  history.undo();
  CHECK_FALSE(grew());
  history.redo();
  CHECK(grew());
  CHECK(*first == start());
}

TEST_CASE("a step of several edits is undone as one, and applied whole or not at all") {
  History history(start());
  REQUIRE(history.apply({"Fit", {pupils_edit(60), aperture_edit(20)}}).ok());
  CHECK(history.place() == 1);
  CHECK(history.now()->glasses.lens_aperture_mm == 20);
  CHECK_FALSE(history.apply({"Fit", {pupils_edit(61), aperture_edit(-1)}}).ok());
  CHECK(pupils_of(history) == 60);
  REQUIRE(history.apply({"Fit", {pupils_edit(62), aperture_edit(21)}}, Joining::continues_last).ok());
  CHECK(history.place() == 1);
  REQUIRE(history.apply({"Fit", {pupils_edit(63)}}, Joining::continues_last).ok());  // other keys: a step of its own
  CHECK(history.place() == 2);
  history.jump(0);
  CHECK(*history.now() == start());
}
