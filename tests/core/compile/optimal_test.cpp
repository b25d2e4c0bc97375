#include "core/compile/optimal.h"

#include <doctest/doctest.h>

#include <chrono>
#include <numeric>
#include <stop_token>
#include <thread>

#include "core/compile/compile.h"
#include "core/optics/vergence.h"
#include "tests/core/compile/cards.h"
#include "tests/core/compile/wide_pupil.h"

using namespace focalstage;

namespace {

const std::vector<double> five{-1.0, -0.5, 0.0, 0.5, 1.0};

CompiledFrame compiled(const Stage& stage, const CompileSettings& settings, int threads = 0,
                       VectorPath path = VectorPath::best) {
  auto frame = Compiler(settings, threads, path).frame(stage);
  REQUIRE(frame);
  return *std::move(frame);
}

CompileSettings with(CompileSettings settings, Assignment assignment) {
  settings.slices.assignment = assignment;
  return settings;
}

/// At the slices' pictures on the screen of the cards and half-way between.
std::vector<double> focuses_d(const CompileSettings& settings) {
  std::vector<double> foci;
  for (const double power_d : settings.slices.powers_d) {
    if (!foci.empty()) foci.push_back(0.0);
    foci.push_back(vergence_at_pupil_d(image_vergence_d(0.5, power_d), settings.lens_to_pupil_m));
  }
  for (std::size_t i = 1; i < foci.size(); i += 2) foci[i] = 0.5 * (foci[i - 1] + foci[i + 1]);
  return foci;
}

std::size_t differing(const FrameImages& a, const FrameImages& b) {
  REQUIRE(a.codes.size() == b.codes.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.codes.size(); ++i) count += a.codes[i] != b.codes[i] ? 1 : 0;
  return count;
}

}  // namespace

TEST_CASE("rays through a wide pupil see the objects better than by linear filtering, about as measured") {
  const Stage stage = cards::room();
  const CompileSettings settings = cards::settings(five, Assignment::optimal);
  const CompiledFrame optimal = compiled(stage, settings);
  const CompiledFrame linear = compiled(stage, with(settings, Assignment::linear));
  support::Chance chance(7);
  for (const Side side : both_sides) {
    const wide_pupil::WideEye eye(stage, settings, side);
    const auto errors =
        wide_pupil::errors_near_edges(eye, stage, {&linear.images, &optimal.images}, {-0.15, -0.12}, {0.15, 0.12},
                                      0.004, 1.0 / 700.0, 150, focuses_d(settings), usual_pupil_m, chance);
    const double gain = errors.psnr_db(1) - errors.psnr_db(0);
    const OptimalMeasure& measure = optimal.measure.optimal[side];
    MESSAGE("linear " << errors.psnr_db(0) << " dB, optimal " << errors.psnr_db(1) << " dB, gain " << gain
                      << " dB; measured " << gain_db(measure) << " dB over " << measure.tiles << " tiles");
    // The engine asks at the pixels' own places, where it can fit best; the rays ask anywhere.
    CHECK(gain > 8.0);
    CHECK(gain > 0.6 * gain_db(measure));
    CHECK(gain < gain_db(measure) + 1.0);
    CHECK(measure.accepted_tiles == measure.tiles);
    CHECK(measure.left_tiles == 0);
  }
}

TEST_CASE("away from depth edges every byte is linear's") {
  const CompileSettings settings = cards::settings(five, Assignment::optimal);
  const CompiledFrame optimal = compiled(cards::room(), settings);
  const CompiledFrame linear = compiled(cards::room(), with(settings, Assignment::linear));
  CHECK(differing(optimal.images, linear.images) > 1000);
  // The near card covers rows 37 to 170 and, in both eyes' pictures, the columns about the middle.
  std::size_t changed = 0;
  for (std::size_t i = 0; i < optimal.images.codes.size(); ++i) {
    const auto at = i % optimal.images.bytes_per_image();
    const auto x = static_cast<int>(at % 256), y = static_cast<int>(at / 256);
    const bool far_off = y < 22 || y >= 185;
    const bool amid = std::abs(x - 128) < 4 && std::abs(y - 96) < 4;
    if (far_off || amid) changed += optimal.images.codes[i] != linear.images.codes[i] ? 1 : 0;
  }
  CHECK(changed == 0);
}

TEST_CASE("without a depth edge nothing is solved and nothing changes") {
  const CompileSettings settings = cards::settings(five, Assignment::optimal);
  Stage slanted = cards::room(false);
  slanted.objects[0].drawables[0].world_from_mesh =
      Rigid{{0.0, 0.0, -0.7}, {std::cos(0.4), 0.0, std::sin(0.4), 0.0}}.matrix();
  for (const Stage& stage : {cards::room(false), slanted}) {
    const CompiledFrame optimal = compiled(stage, settings);
    CHECK(optimal.images.codes == compiled(stage, with(settings, Assignment::linear)).images.codes);
    CHECK(optimal.measure.optimal.left == OptimalMeasure{});
    CHECK(gain_db(optimal.measure.optimal.left) == 0.0);
  }
}

TEST_CASE("colours, samples, breathing, gamma and depth modes: better than linear, the same bytes on any machine") {
  for (const Breathing breathing : {Breathing::exact, Breathing::planar, Breathing::off}) {
    for (const DepthMode mode : {DepthMode::placed, DepthMode::fixed, DepthMode::offset, DepthMode::slice}) {
      if (breathing != Breathing::exact && mode != DepthMode::fixed) continue;
      CompileSettings settings = cards::settings({-1.0, 0.0, 1.0}, Assignment::optimal);
      settings.slices.breathing = breathing;
      settings.channels = mode == DepthMode::fixed ? 3 : 1;
      settings.slices.samples_per_pixel = mode == DepthMode::fixed ? 4 : 1;
      settings.gamma = 2.2;
      Stage stage = cards::room();
      stage.objects[1].depth.mode = mode;
      stage.objects[1].depth.vergence_d = mode == DepthMode::fixed ? 2.6 : 0.15;
      stage.objects[1].depth.index = 0;
      stage.objects[1].drawables[0].finish.a = {0.7, 0.5, 0.2};
      INFO("breathing " << static_cast<int>(breathing) << " depth mode " << static_cast<int>(mode));
      const CompiledFrame one = compiled(stage, settings, 1);
      CHECK(differing(one.images, compiled(stage, settings, 2).images) == 0);
      CHECK(differing(one.images, compiled(stage, settings, 2, VectorPath::portable).images) == 0);
      CHECK(differing(one.images, compiled(stage, with(settings, Assignment::linear)).images) > 1000);
      for (const Side side : both_sides) {
        CHECK(one.measure.optimal[side].tiles > 20);
        CHECK(gain_db(one.measure.optimal[side]) > 4.0);
      }
    }
  }
}

TEST_CASE("random cards: never worse than linear, with any number of threads") {
  support::Chance chance(11);
  int solved = 0;
  for (int scene = 0; scene < 6; ++scene) {
    Stage stage = cards::room(false);
    const int count = chance.whole(1, 6);
    for (int i = 0; i < count; ++i) {
      const Rigid pose{{chance.between(-0.06, 0.06), chance.between(-0.05, 0.05), -chance.between(0.37, 0.7)},
                       glm::angleAxis(chance.between(-0.8, 0.8), chance.direction())};
      StagedObject card = support::object_of(cards::checkered({chance.between(0.01, 0.08), chance.between(0.01, 0.08)},
                                                              pose, {chance.whole(1, 6), chance.whole(1, 6)},
                                                              chance.between(0.0, 1.0), chance.between(0.0, 1.0)));
      card.index = stage.objects.size();
      stage.objects.push_back(card);
    }
    const CompileSettings settings = cards::settings({chance.between(-1.5, -0.5), 0.0, 1.0}, Assignment::optimal);
    const CompiledFrame one = compiled(stage, settings, 1);
    CHECK(differing(one.images, compiled(stage, settings, 2).images) == 0);
    for (const Side side : both_sides) {
      const OptimalMeasure& measure = one.measure.optimal[side];
      CHECK(measure.optimal_error <= measure.linear_error);
      CHECK(measure.accepted_tiles <= measure.tiles);
    }
    if (one.measure.optimal.left.tiles == 0) continue;
    ++solved;
    const CompiledFrame linear = compiled(stage, with(settings, Assignment::linear));
    const wide_pupil::WideEye eye(stage, settings, Side::left);
    const auto errors =
        wide_pupil::errors_near_edges(eye, stage, {&linear.images, &one.images}, {-0.15, -0.12}, {0.15, 0.12}, 0.003,
                                      1.0 / 700.0, 30, focuses_d(settings), usual_pupil_m, chance);
    MESSAGE("scene " << scene << ": linear " << errors.psnr_db(0) << " dB, optimal " << errors.psnr_db(1) << " dB");
    CHECK(errors.psnr_db(1) > errors.psnr_db(0));
  }
  CHECK(solved >= 4);
}

TEST_CASE("a frame does not depend on the frames before it, nor a moved viewer on what was kept") {
  const CompileSettings settings = cards::settings(five, Assignment::optimal);
  Compiler warm(settings);
  Stage moved = cards::room();
  moved.world_from_viewer.position_m = {0.004, 0.0, 0.01};
  const CompiledFrame first = compiled(cards::room(), settings);
  const CompiledFrame second = compiled(moved, settings);
  CHECK(differing(first.images, second.images) > 1000);
  for (int i = 0; i < 2; ++i) {
    CHECK(warm.frame(cards::room())->images.codes == first.images.codes);
    CHECK(warm.frame(cards::room(false))->measure.optimal.left == OptimalMeasure{});
    CHECK(warm.frame(moved)->images.codes == second.images.codes);
  }
}

TEST_CASE("what leaves nothing to solve is linear: one slice, equal powers, no surface, no object") {
  const auto same = [](const Stage& stage, const std::vector<double>& powers_d) {
    const CompileSettings settings = cards::settings(powers_d, Assignment::optimal);
    const CompiledFrame optimal = compiled(stage, settings);
    CHECK(optimal.images.codes == compiled(stage, with(settings, Assignment::linear)).images.codes);
    CHECK(optimal.measure.optimal == PerEye<OptimalMeasure>{});
  };
  same(cards::room(), {0.0});
  same(cards::room(), {0.5, 0.5, 0.5});
  same(cards::room(), {});
  Stage bare = cards::room();
  bare.surfaces.clear();
  same(bare, five);
  Stage empty = cards::room();
  empty.objects.clear();
  same(empty, five);
  same(Stage{}, five);
}

TEST_CASE("repeated powers are solved as if they stood once") {
  const CompiledFrame twice =
      compiled(cards::room(), cards::settings({0.5, -1.0, 0.5, 1.0, -1.0}, Assignment::optimal));
  const CompiledFrame once = compiled(cards::room(), cards::settings({0.5, -1.0, 1.0}, Assignment::optimal));
  CHECK(twice.measure.optimal == once.measure.optimal);
  for (const std::size_t eye : {0u, 1u}) {
    const auto same = [&](std::size_t a, std::size_t b) {
      return std::ranges::equal(twice.images.image(eye * 5 + a), once.images.image(eye * 3 + b));
    };
    CHECK((same(0, 0) && same(1, 1) && same(3, 2)));
    for (const std::size_t repeat : {2u, 4u}) {
      const auto image = twice.images.image(eye * 5 + repeat);
      CHECK(std::accumulate(image.begin(), image.end(), 0) == 0);
    }
  }
}

TEST_CASE("light that the image carries for the surface is left room") {
  CompileSettings settings = cards::settings(five, Assignment::optimal);
  for (ImageSpec& image : settings.images) {
    if (image.power_d == 0.0) image.kind = ImageKind::content_and_light;
  }
  Stage stage = cards::room();
  stage.surfaces[0].illumination = 0.3;
  const CompiledFrame optimal = compiled(stage, settings);
  const CompiledFrame linear = compiled(stage, with(settings, Assignment::linear));
  CHECK(gain_db(optimal.measure.optimal.left) > 4.0);
  CHECK(optimal.measure.clipped_pixels <= linear.measure.clipped_pixels);
}

TEST_CASE("a step of the surface and its neighbourhood stay linear") {
  Stage stage = cards::room();
  stage.surfaces[0] = support::surface_of(support::standing(support::step({0.5, 0.4}, 0.2), {{0.0, 0.0, -0.515}}));
  const CompileSettings settings = cards::settings(five, Assignment::optimal);
  const CompiledFrame optimal = compiled(stage, settings);
  const CompiledFrame linear = compiled(stage, with(settings, Assignment::linear));
  CHECK(differing(optimal.images, linear.images) > 500);
  for (const Side side : both_sides) CHECK(gain_db(optimal.measure.optimal[side]) > 4.0);
}

TEST_CASE("a stop request ends solving at once") {
  CompileSettings settings = cards::settings(five, Assignment::optimal);
  settings.projector = resized(settings.projector, 1024, 768);
  Compiler compiler(settings);
  std::stop_source asked;
  asked.request_stop();
  CHECK(compiler.frame(cards::room(), asked.get_token()).fault().code == "compile.cancelled");
  const auto begun = std::chrono::steady_clock::now();
  REQUIRE(compiler.frame(cards::room()));
  REQUIRE(compiler.frame(cards::room()));
  const auto whole = (std::chrono::steady_clock::now() - begun) / 2;
  for (const double share : {0.2, 0.5, 0.8}) {
    std::stop_source stop;
    std::chrono::steady_clock::time_point asked_at;
    std::jthread later([&] {
      std::this_thread::sleep_for(whole * share);
      asked_at = std::chrono::steady_clock::now();
      stop.request_stop();
    });
    const auto frame = compiler.frame(cards::room(), stop.get_token());
    const auto ended_at = std::chrono::steady_clock::now();
    later.join();
    if (frame) continue;  // done before it was asked
    CHECK(frame.fault().code == "compile.cancelled");
    // Others may want the processors too: what is allowed grows with what the whole takes.
    CHECK(ended_at - asked_at < std::max<std::chrono::nanoseconds>(std::chrono::milliseconds(100), whole / 4));
  }
  const auto after = compiler.frame(cards::room());
  REQUIRE(after);
  CHECK(after->images.codes == compiled(cards::room(), settings).images.codes);
}
