#include <doctest/doctest.h>

#include "core/compile/compile.h"
#include "tests/exact/random_scene.h"

using namespace focalstage;
using namespace focalstage::exact;

TEST_CASE("threads, instruction sets and repetition do not change a byte") {
  for (std::uint64_t seed = 500; seed < 540; ++seed) {
    const RandomScene scene = random_scene(seed);
    INFO(scene.story);
    Compiler one(scene.settings, 1, VectorPath::best);
    Compiler two(scene.settings, 2, VectorPath::best);
    Compiler portable(scene.settings, 2, VectorPath::portable);
    for (const Stage& stage : scene.frames) {
      const auto first = one.frame(stage);
      REQUIRE(first);
      CHECK(two.frame(stage)->images.codes == first->images.codes);
      CHECK(portable.frame(stage)->images.codes == first->images.codes);
      CHECK(one.frame(stage)->images.codes == first->images.codes);
    }
  }
}

TEST_CASE("on a diamond lattice neither, whose optimal slices are the linear ones") {
  int changed = 0;
  for (std::uint64_t seed = 560; seed < 580; ++seed) {
    RandomScene scene = random_scene(seed);
    INFO(scene.story);
    const auto first_frame = [&](int threads, VectorPath path) {
      const auto frame = Compiler(scene.settings, threads, path).frame(scene.frames[0]);
      REQUIRE(frame);
      return frame->images.codes;
    };
    scene.settings.slices.assignment = Assignment::linear;
    const auto square = first_frame(2, VectorPath::best);
    scene.settings.projector.layout = PixelLayout::diamond;
    const auto diamond = first_frame(1, VectorPath::best);
    changed += diamond != square ? 1 : 0;
    CHECK(first_frame(2, VectorPath::best) == diamond);
    CHECK(first_frame(2, VectorPath::portable) == diamond);
    scene.settings.slices.assignment = Assignment::optimal;
    CHECK(first_frame(2, VectorPath::best) == diamond);
  }
  CHECK(changed >= 18);  // in a dark room nothing shows
}

TEST_CASE("with the optimal assignment too, which is never worse than linear and changes little") {
  int solved = 0;
  for (std::uint64_t seed = 700; seed < 720; ++seed) {
    RandomScene scene = random_scene(seed);
    INFO(scene.story);
    scene.settings.slices.assignment = Assignment::optimal;
    Compiler one(scene.settings, 1, VectorPath::best);
    Compiler two(scene.settings, 2, VectorPath::best);
    Compiler portable(scene.settings, 2, VectorPath::portable);
    for (const Stage& stage : scene.frames) {
      const auto first = one.frame(stage);
      REQUIRE(first);
      const auto second = two.frame(stage);
      CHECK(second->images.codes == first->images.codes);
      CHECK(second->measure.optimal == first->measure.optimal);
      CHECK(portable.frame(stage)->images.codes == first->images.codes);
      for (const Side side : both_sides) {
        const OptimalMeasure& measure = first->measure.optimal[side];
        CHECK(measure.optimal_error <= measure.linear_error);
        CHECK(measure.accepted_tiles <= measure.tiles);
        solved += measure.accepted_tiles > 0 ? 1 : 0;
      }
    }
  }
  CHECK(solved > 5);
}

TEST_CASE("a frame does not depend on the frames before it") {
  int several = 0;
  for (std::uint64_t seed = 600; seed < 640; ++seed) {
    const RandomScene scene = random_scene(seed);
    if (scene.frames.size() < 2) continue;
    ++several;
    INFO(scene.story);
    Compiler warm(scene.settings), cold(scene.settings);
    REQUIRE(warm.frame(scene.frames[0]));
    const auto after = warm.frame(scene.frames[1]);
    const auto alone = cold.frame(scene.frames[1]);
    REQUIRE(after);
    REQUIRE(alone);
    CHECK(after->images.codes == alone->images.codes);
    CHECK(warm.frame(scene.frames[0])->images.codes == cold.frame(scene.frames[0])->images.codes);
  }
  CHECK(several > 5);
}
