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
