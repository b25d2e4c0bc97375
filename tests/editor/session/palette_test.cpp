#include "editor/session/palette.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "editor/samples/samples.h"
#include "editor/session/session.h"
#include "tests/support/temporary_folder.h"

using namespace focalstage;

namespace {

struct Home : TemporaryFolder {
  Home() { setenv("XDG_STATE_HOME", (path() / "state").c_str(), 1); }
};

}  // namespace

TEST_CASE("the palette finds commands, things and samples, those that can be done first") {
  const Home home;
  Session session([] {});
  const auto all = palette_entries(session, "");
  CHECK(all.size() > 50);
  CHECK(std::ranges::none_of(all, [](const PaletteEntry& entry) { return entry.command == "app.palette"; }));
  const auto teapot = palette_entries(session, "teapot");
  REQUIRE(!teapot.empty());
  CHECK(teapot[0].command == "file.new");  // "Add a teapot" needs a project and stands behind
  CHECK(std::ranges::any_of(teapot, [](const PaletteEntry& entry) {
    return entry.command == "add.teapot" && entry.unavailable == "open a project first";
  }));

  Value from;
  from.set("from", "three-rabbits");
  REQUIRE(session.run("file.new", from).ok());
  CHECK(palette_entries(session, "undo")[0].unavailable == "nothing to undo");
  Value add;
  add.set("kind", "box");
  add.set("name", "Кролик дальний");
  REQUIRE(session.run("add.object", add).ok());
  const auto hare = palette_entries(session, "кролик");
  REQUIRE(!hare.empty());
  CHECK(hare[0].title == "Select Кролик дальний");
  CHECK(hare[0].matched.size() == 6);
  session.select({});
  REQUIRE(session.run(hare[0].command, hare[0].args).ok());
  CHECK(session.selection().things == std::vector<Thing>{{"objects", "Кролик дальний"}});
  CHECK(palette_entries(session, "zzzz").empty());
}

TEST_CASE("every sample has a card that says what it shows, and its picture is drawn only when wanted") {
  const Home home;
  Session session([] {});
  REQUIRE(session.sample_cards().size() == samples().size());
  CHECK(session.sample_cards()[0].name == "first-light");
  for (const SampleCard& card : session.sample_cards()) {
    CAPTURE(card.name);
    CHECK_FALSE(card.says.empty());
    CHECK(card.picture == nullptr);
  }
  CHECK(session.tasks().empty());
}
