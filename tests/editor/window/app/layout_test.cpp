#include "editor/window/app/layout.h"

#include <doctest/doctest.h>

#include <random>
#include <vector>

using namespace focalstage;

namespace {

std::vector<PaneRect> parts_of(const Layout& layout) {
  std::vector<PaneRect> parts{layout.bar};
  for (const auto* part : {&layout.outline, &layout.properties, &layout.timeline, &layout.bottom}) {
    if (*part) parts.push_back(**part);
  }
  for (const auto& view : layout.views) {
    if (view) parts.push_back(*view);
  }
  return parts;
}

bool overlap(const PaneRect& a, const PaneRect& b) {
  return a.min.x < b.min.x + b.size.x && b.min.x < a.min.x + a.size.x && a.min.y < b.min.y + b.size.y &&
         b.min.y < a.min.y + a.size.y;
}

}  // namespace

TEST_CASE("at 1600 x 900 everything is there, three pixels apart") {
  const Layout layout = lay_out({1600, 900}, 1.0, Splits{}, std::nullopt, true);
  REQUIRE(layout.outline.has_value());
  REQUIRE(layout.properties.has_value());
  REQUIRE(layout.timeline.has_value());
  REQUIRE(layout.bottom.has_value());
  for (const auto& view : layout.views) REQUIRE(view.has_value());
  CHECK(layout.splitters.size() == 5);
  CHECK(layout.outline->size.x == 220.0f);
  CHECK(layout.properties->min.x == 1600.0f - 290.0f);
  CHECK(layout.bottom->min.y == 900.0f - 150.0f);
  // The views fill what lies between but for the gap in the middle.
  const PaneRect& room = *layout.views[0];
  const PaneRect& projector = *layout.views[1];
  CHECK(room.min.x == 223.0f);
  CHECK(projector.min.x == room.min.x + room.size.x + 3.0f);
  CHECK(projector.min.x + projector.size.x == 1600.0f - 293.0f);
}

TEST_CASE("parts never overlap, never leave the window and are never empty, whatever the size, scale and splits") {
  std::mt19937_64 chance(11);
  const auto upto = [&](int n) { return static_cast<int>(chance() % static_cast<std::uint64_t>(n)); };
  for (int i = 0; i < 5000; ++i) {
    const glm::ivec2 size(320 + upto(4000), 200 + upto(2200));
    const double scale = 1.0 + 0.25 * upto(9);
    Splits splits;
    splits.outline = upto(2000);
    splits.properties = upto(2000);
    splits.bottom = upto(2000);
    splits.across = upto(101) / 100.0;
    splits.down = upto(101) / 100.0;
    const auto filled = upto(2) == 0 ? std::optional<int>(upto(4)) : std::nullopt;
    const Layout layout = lay_out(size, scale, splits, filled, upto(2) == 0);
    const std::vector<PaneRect> parts = parts_of(layout);
    CAPTURE(size.x);
    CAPTURE(size.y);
    CAPTURE(scale);
    for (std::size_t a = 0; a < parts.size(); ++a) {
      CHECK(parts[a].size.x >= 1.0f);
      CHECK(parts[a].size.y >= 1.0f);
      CHECK(parts[a].min.x >= 0.0f);
      CHECK(parts[a].min.x + parts[a].size.x <= static_cast<float>(size.x));
      CHECK(parts[a].min.y + parts[a].size.y <= static_cast<float>(size.y));
      for (std::size_t b = a + 1; b < parts.size(); ++b) CHECK_FALSE(overlap(parts[a], parts[b]));
    }
    // There is always something to look at.
    CHECK((layout.views[0] || filled));
  }
}

TEST_CASE("a view that fills the centre is alone there") {
  const Layout layout = lay_out({1600, 900}, 1.0, Splits{}, 2, false);
  CHECK_FALSE(layout.views[0].has_value());
  REQUIRE(layout.views[2].has_value());
  CHECK(layout.views[2]->size == layout.centre.size);
  CHECK_FALSE(layout.timeline.has_value());
}

TEST_CASE("in a small window parts go rather than being squeezed, the views last") {
  const Layout tiny = lay_out({330, 210}, 1.0, Splits{}, std::nullopt, true);
  CHECK_FALSE(tiny.outline.has_value());
  CHECK_FALSE(tiny.properties.has_value());
  CHECK_FALSE(tiny.bottom.has_value());
  REQUIRE(tiny.views[0].has_value());
  const Layout narrow = lay_out({560, 900}, 1.0, Splits{}, std::nullopt, true);
  CHECK(narrow.outline.has_value());
  CHECK_FALSE(narrow.properties.has_value());
}

TEST_CASE("a splitter dragged to a pointer stands there in the next layout") {
  const glm::ivec2 size(1600, 900);
  const Layout layout = lay_out(size, 1.0, Splits{}, std::nullopt, true);
  const Splits wider = dragged(layout, Splits{}, Splitter::Kind::outline, {300.0f, 400.0f}, 1.0);
  CHECK(lay_out(size, 1.0, wider, std::nullopt, true).outline->size.x == 300.0f);
  const Splits higher = dragged(layout, Splits{}, Splitter::Kind::bottom, {800.0f, 650.0f}, 1.0);
  CHECK(lay_out(size, 1.0, higher, std::nullopt, true).bottom->min.y == 650.0f);
  const Splits across = dragged(layout, Splits{}, Splitter::Kind::across, {600.0f, 300.0f}, 1.0);
  CHECK(lay_out(size, 1.0, across, std::nullopt, true).views[0]->size.x + 223.0f ==
        doctest::Approx(600.0).epsilon(0.002));
}

TEST_CASE("dragging far beyond an edge leaves every part its least size") {
  const glm::ivec2 size(1600, 900);
  for (const auto kind : {Splitter::Kind::outline, Splitter::Kind::properties, Splitter::Kind::bottom,
                          Splitter::Kind::across, Splitter::Kind::down}) {
    for (const glm::vec2& pointer : {glm::vec2(-5000.0f), glm::vec2(5000.0f)}) {
      const Layout before = lay_out(size, 1.0, Splits{}, std::nullopt, true);
      const Layout after = lay_out(size, 1.0, dragged(before, Splits{}, kind, pointer, 1.0), std::nullopt, true);
      REQUIRE(after.outline.has_value());
      REQUIRE(after.properties.has_value());
      REQUIRE(after.bottom.has_value());
      CHECK(after.outline->size.x >= 120.0f);
      CHECK(after.properties->size.x >= 200.0f);
      CHECK(after.bottom->size.y >= 70.0f);
      for (const auto& view : after.views) {
        REQUIRE(view.has_value());
        CHECK(view->size.x >= 100.0f);
        CHECK(view->size.y >= 100.0f);
      }
    }
  }
}
