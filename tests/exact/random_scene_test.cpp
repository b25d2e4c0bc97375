#include "tests/exact/random_scene.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "core/reference/reference.h"
#include "tests/exact/compare.h"

using namespace focalstage;
using namespace focalstage::exact;

TEST_CASE("a seed draws one scene") {
  const RandomScene a = random_scene(11), b = random_scene(11), c = random_scene(12);
  CHECK(a.story == b.story);
  CHECK(a.settings == b.settings);
  CHECK(a.story != c.story);
}

TEST_CASE("the scenes show something, of every kind") {
  int lit = 0, all = 0, both_threads_alike = 0;
  std::set<std::string> words;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const RandomScene scene = random_scene(seed);
    std::string word;
    for (const char c : scene.story + " ") {
      if (c != ' ' && c != ':') {
        word += c;
      } else {
        words.insert(word);
        word.clear();
      }
    }
    const auto one = compile_reference(scene.frames[0], scene.settings, 1);
    const auto two = compile_reference(scene.frames[0], scene.settings, 2);
    REQUIRE(one);
    REQUIRE(two);
    ++all;
    if (one->measure.lit_pixels * 200 > one->images.codes.size()) ++lit;
    if (one->images.codes == two->images.codes) ++both_threads_alike;
  }
  MESSAGE(lit << " of " << all << " scenes light more than half a percent of their bytes");
  CHECK(lit * 3 > all * 2);
  CHECK(both_threads_alike == all);
  for (const char* kind :
       {"plane",    "bumpy", "step",      "corner", "bowl",  "ball",   "box",   "blob",    "soup",   "checker",
        "textured", "lit",   "flat",      "placed", "fixed", "offset", "slice", "nearest", "linear", "exact",
        "planar",   "off",   "distorted", "rgb",    "gray",  "4",      "9",     "deep",    "cut"}) {
    CHECK_MESSAGE(words.count(kind) == 1, kind);
  }
}
