#include "editor/session/outline_rows.h"

#include <doctest/doctest.h>

using namespace focalstage;

namespace {

using Kind = OutlineRow::Kind;

Project room() {
  Project project;
  project.projectors.resize(1);
  project.projectors[0].name = "main";
  project.slices.powers_d = {0.0};
  project.surfaces.resize(1);
  project.surfaces[0].name = "screen";
  for (const char* name : {"a", "b", "c", "d", "e"}) {
    project.objects.emplace_back();
    project.objects.back().name = name;
  }
  project.objects[1].group = project.objects[3].group = "pair";
  project.objects[1].hidden = project.objects[3].hidden = true;
  return project;
}

/// "Objects a [pair] .b .d c e"
std::string told(const std::vector<OutlineRow>& rows) {
  std::string text;
  for (const OutlineRow& row : rows) {
    text += text.empty() ? "" : " ";
    text += row.kind == Kind::group ? "[" + row.label + "]" : (row.inside ? "." : "") + row.label;
  }
  return text;
}

std::string order(const Project& project) {
  std::string text;
  for (const Object& object : project.objects) text += object.name;
  return text;
}

}  // namespace

TEST_CASE("the outline lists sections, groups where their first stands, and the rig") {
  const auto rows = outline_rows(room(), {});
  CHECK(told(rows) ==
        "Surfaces screen Objects a [pair] .b .d c e Projectors main Viewer & rig Viewer Glasses Sweep Slices Frames");
  CHECK(rows[2].count == 5);
  CHECK(rows[4].count == 2);
  CHECK(rows[4].hidden);
  CHECK_FALSE(rows[4].locked);
}

TEST_CASE("what is folded hides what is in it and still tells how many") {
  CHECK(told(outline_rows(room(), {"objects/pair"})) ==
        "Surfaces screen Objects a [pair] c e Projectors main Viewer & rig Viewer Glasses Sweep Slices Frames");
  const auto rows = outline_rows(room(), {"objects/", "/"});
  CHECK(told(rows) == "Surfaces screen Objects Projectors main Viewer & rig");
  CHECK(rows[2].count == 5);
  CHECK_FALSE(rows[2].open);
}

TEST_CASE("a filter finds names in any case, also in what is folded") {
  Project project = room();
  project.objects[3].name = "Большой Rabbit";
  CHECK(told(outline_rows(project, {"objects/pair", "objects/"}, "rABB")) == "Objects Большой Rabbit");
  CHECK(told(outline_rows(project, {}, "Бол")) == "Objects Большой Rabbit");
  CHECK(told(outline_rows(project, {}, "sl")) == "Viewer & rig Slices");
  CHECK(outline_rows(project, {}, "no such").empty());
}

TEST_CASE("a thing dropped beside another stands there, in its group") {
  const Project project = room();
  const auto dropped = [&](const char* what, const char* beside, bool after) {
    const auto done = apply_all(project, reorder_edits(project, {"objects", what}, {"objects", beside}, after));
    REQUIRE(done.ok());
    return *done;
  };
  CHECK(order(dropped("a", "c", false)) == "bacde");
  CHECK(order(dropped("a", "e", true)) == "bcdea");
  CHECK(order(dropped("e", "a", false)) == "eabcd");
  const Project joined = dropped("e", "b", true);
  CHECK(order(joined) == "abecd");
  CHECK(joined.objects[2].group == "pair");
  CHECK(dropped("b", "a", false).objects[0].group.empty());
  CHECK(reorder_edits(project, {"objects", "a"}, {"objects", "a"}, true).empty());
  CHECK(reorder_edits(project, {"objects", "a"}, {"objects", "c"}, false).size() == 1);
  CHECK(reorder_edits(project, {"objects", "c"}, {"objects", "e"}, false).size() == 1);
  CHECK(reorder_edits(project, {"objects", "a"}, {"surfaces", "screen"}, false).empty());
  CHECK(members_of(project, {"objects", "pair"}) == std::vector<Thing>{{"objects", "b"}, {"objects", "d"}});
}
