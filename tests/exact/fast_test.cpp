#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "core/compile/compile.h"
#include "core/reference/reference.h"
#include "tests/exact/compare.h"
#include "tests/exact/random_scene.h"

using namespace focalstage;
using namespace focalstage::exact;

namespace {

constexpr std::uint64_t scenes_per_run = 200;

/// Seeds that once failed, one a line; what follows a # says why.
std::vector<std::uint64_t> kept_seeds() {
  std::ifstream file(FOCALSTAGE_SOURCE_DIR "/tests/exact/kept_seeds.txt");
  std::vector<std::uint64_t> seeds;
  for (std::string line; std::getline(file, line);) {
    if (!line.empty() && line[0] != '#') seeds.push_back(std::stoull(line));
  }
  return seeds;
}

/// A fresh one each run; FOCALSTAGE_SEED repeats a run.
std::uint64_t first_seed() {
  if (const char* given = std::getenv("FOCALSTAGE_SEED")) return std::stoull(given);
  return std::random_device{}();
}

bool about_equal(std::uint64_t fast, std::uint64_t reference) {
  const std::uint64_t gap = fast > reference ? fast - reference : reference - fast;
  return gap <= 20 + reference / 500;
}

/// `same_sights`: no ray along an edge hit another thing in the one than in the other. One that does may carry a worst
/// value; counts bear it.
void check_measures(const FrameMeasure& fast, const FrameMeasure& reference, bool same_sights) {
  CHECK(about_equal(fast.lit_pixels, reference.lit_pixels));
  CHECK(about_equal(fast.clipped_pixels, reference.clipped_pixels));
  CHECK(about_equal(fast.surface_pixels, reference.surface_pixels));
  CHECK(about_equal(fast.defocused_pixels, reference.defocused_pixels));
  CHECK(fast.worst_defocus_d == doctest::Approx(reference.worst_defocus_d).epsilon(1e-3));
  REQUIRE(fast.objects.size() == reference.objects.size());
  for (std::size_t i = 0; i < fast.objects.size(); ++i) {
    CHECK(fast.objects[i].index == reference.objects[i].index);
    CHECK(about_equal(fast.objects[i].samples, reference.objects[i].samples));
    CHECK(about_equal(fast.objects[i].beyond, reference.objects[i].beyond));
    if (!same_sights) continue;
    CHECK(fast.objects[i].worst_below_d == doctest::Approx(reference.objects[i].worst_below_d).epsilon(0.02));
    CHECK(fast.objects[i].worst_above_d == doctest::Approx(reference.objects[i].worst_above_d).epsilon(0.02));
  }
}

/// Compiles all frames of a scene by both and adds up how they differ.
Difference compared(const RandomScene& scene) {
  Compiler compiler(scene.settings);
  Difference all;
  for (const Stage& stage : scene.frames) {
    const auto fast = compiler.frame(stage);
    const auto reference = compile_reference(stage, scene.settings);
    REQUIRE(fast);
    REQUIRE(reference);
    const Difference here = difference(fast->images.codes, reference->images.codes);
    check_measures(fast->measure, reference->measure, here.off == 0);
    all += here;
  }
  return all;
}

}  // namespace

TEST_CASE("random scenes: the engine shows what the reference shows") {
  const std::uint64_t first = first_seed();
  MESSAGE("FOCALSTAGE_SEED=" << first);
  Difference all;
  for (std::uint64_t i = 0; i < scenes_per_run; ++i) {
    const RandomScene scene = random_scene(first + i);
    INFO(scene.story);
    const Difference here = compared(scene);
    all += here;
    if (here.off > 0) {
      MESSAGE(here.off << " of " << here.bytes << " bytes off by more than one code, worst " << here.worst << ": "
                       << scene.story);
    }
    CHECK(here.off <= 3 + here.bytes / 100'000);  // no scene is wrong as a whole
  }
  MESSAGE(all.off << " of " << all.bytes << " bytes are off by more than one code: "
                  << 1e6 * static_cast<double>(all.off) / static_cast<double>(all.bytes) << " per million");
  CHECK(all.off * 1'000'000 <= all.bytes);
}

TEST_CASE("random scenes from a diamond lattice, too") {
  const std::uint64_t first = first_seed();
  MESSAGE("FOCALSTAGE_SEED=" << first);
  Difference all;
  for (std::uint64_t i = 0; i < scenes_per_run / 4; ++i) {
    RandomScene scene = random_scene(first + i);
    scene.settings.projector.layout = PixelLayout::diamond;
    INFO(scene.story);
    const Difference here = compared(scene);
    all += here;
    CHECK(here.off <= 3 + here.bytes / 100'000);
  }
  MESSAGE(all.off << " of " << all.bytes << " bytes are off by more than one code");
  CHECK(all.off * 1'000'000 <= all.bytes + 1'000'000 * 3);
}

TEST_CASE("seeds that once failed") {
  for (const std::uint64_t seed : kept_seeds()) {
    const RandomScene scene = random_scene(seed);
    INFO(scene.story);
    const Difference here = compared(scene);
    CHECK(here.off <= 1 + here.bytes / 500'000);
  }
}
