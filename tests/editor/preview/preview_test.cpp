#include "editor/preview/preview.h"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <thread>

#include "core/compile/compile.h"
#include "core/reference/samples.h"
#include "editor/preview/false_colour.h"
#include "editor/preview/pixel_reader.h"
#include "editor/preview/slice_maker.h"
#include "tests/editor/preview/scene.h"

using namespace focalstage;

namespace {

bool wait(const std::function<bool()>& until, double patience_s = 20.0) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(patience_s);
  while (std::chrono::steady_clock::now() < end) {
    if (until()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return false;
}

PreviewWish wish_for(std::uint64_t revision, const std::shared_ptr<const Project>& project, double x_m = 0.0) {
  PreviewWish wish;
  wish.revision = revision;
  wish.project = project;
  wish.stage = staged(*project, x_m);
  wish.eye.width_px = 64;
  wish.eye.height_px = 48;
  return wish;
}

}  // namespace

TEST_CASE("a whole preview is what the show would hold, code for code") {
  const auto project = a_project();
  Preview preview([] {});
  preview.want(wish_for(7, project));
  REQUIRE(wait([&] { return preview.checked() && preview.checked()->measured && !preview.busy(); }));
  const auto slices = preview.slices();
  REQUIRE(slices);
  CHECK(slices->revision == 7);
  CHECK(slices->divisor == 1);
  Compiler compiler(compile_settings(*project), 1);
  const auto frame = compiler.frame(*slices->stage);
  REQUIRE(frame.ok());
  CHECK(frame->images.codes == slices->images.codes);
  REQUIRE(preview.eye_picture());
  CHECK(preview.eye_picture()->width_px == 64);
}

TEST_CASE("of a hundred wishes the last one is fulfilled, and nothing older comes after something newer") {
  const auto project = a_project();
  std::atomic<std::uint64_t> newest_seen{0};
  std::atomic<bool> backwards{false};
  Preview* at = nullptr;
  const auto look = [&] {
    const auto slices = at ? at->slices() : nullptr;
    if (!slices) return;
    if (slices->revision < newest_seen) backwards = true;
    newest_seen = slices->revision;
  };
  Preview preview(look);
  at = &preview;
  for (std::uint64_t i = 1; i <= 100; ++i) {
    PreviewWish wish = wish_for(i, project, 0.0005 * static_cast<double>(i));
    wish.moving = i < 100;
    preview.want(std::move(wish));
    std::this_thread::sleep_for(std::chrono::milliseconds(3));
  }
  REQUIRE(
      wait([&] { return preview.slices() && preview.slices()->revision == 100 && preview.slices()->divisor == 1; }));
  CHECK_FALSE(backwards);
}

TEST_CASE("smaller sizes show the same room") {
  const auto project = a_project();
  const auto stage = staged(*project, 0.0);
  SliceMaker maker(1);
  const auto whole = maker.make(*project, *stage, SliceMaker::Variant::shown, 1, {});
  const auto quarter = maker.make(*project, *stage, SliceMaker::Variant::shown, 4, {});
  REQUIRE((whole.ok() && quarter.ok()));
  CHECK(quarter->images.width_px == whole->images.width_px / 4);
  const auto light = [](const FrameImages& images) {
    double sum = 0.0;
    for (const std::uint8_t code : images.codes) sum += code;
    return sum / static_cast<double>(images.codes.size());
  };
  CHECK(light(quarter->images) == doctest::Approx(light(whole->images)).epsilon(0.03));
  const auto plain = maker.make(*project, *stage, SliceMaker::Variant::conventional, 1, {});
  REQUIRE(plain.ok());
  CHECK(plain->images.count == 2);
}

TEST_CASE("the optimal assignment is solved at full size alone") {
  auto project = std::make_shared<Project>(*a_project());
  project->slices.assignment = Assignment::optimal;
  using Variant = SliceMaker::Variant;
  CHECK(SliceMaker::settings_of(*project, Variant::shown, 1).slices.assignment == Assignment::optimal);
  CHECK(SliceMaker::settings_of(*project, Variant::shown, 2).slices.assignment == Assignment::linear);
  project->slices.assignment = Assignment::nearest;
  CHECK(SliceMaker::settings_of(*project, Variant::shown, 4).slices.assignment == Assignment::nearest);
  project->slices.assignment = Assignment::optimal;
  Preview preview([] {});
  preview.want(wish_for(1, project));
  REQUIRE(wait([&] { return preview.slices() && preview.slices()->divisor == 1 && !preview.busy(); }));
  CHECK(preview.slices()->settings.slices.assignment == Assignment::optimal);
}

TEST_CASE("a pixel read is the reference's answer, weight by weight") {
  const auto project = a_project();
  Preview preview([] {});
  preview.want(wish_for(1, project));
  REQUIRE(wait([&] { return preview.slices() && preview.slices()->divisor == 1 && !preview.busy(); }));
  const auto slices = preview.slices();
  std::atomic<int> woken{0};
  PixelReader reader([&] { ++woken; });
  const glm::ivec2 pixel(slices->images.width_px / 2, slices->images.height_px / 2);
  reader.ask(slices, Side::left, pixel);
  REQUIRE(wait([&] { return reader.answer() != nullptr; }));
  const auto reading = reader.answer();
  CHECK(reading->surface == "screen");
  REQUIRE(reading->slices.size() == project->slices.powers_d.size());
  double weights = 0.0;
  for (const SliceReading& slice : reading->slices) {
    weights += slice.weight;
    if (slice.weight > 0.0) CHECK(slice.object == "card");
    if (slice.weight > 0.0) CHECK(std::abs(slice.code - 255.0 * slice.weight) <= 1.0);
  }
  // A card square to the gaze before a screen square to it: every slice looks at it through the same plane.
  CHECK(weights == doctest::Approx(1.0).epsilon(1e-6));
  // The screen at 0.6 m before the pupils, the card at 0.45 m; distances from lenses 15 mm before them.
  CHECK(reading->surface_m == doctest::Approx(0.585).epsilon(1e-6));
  for (const SliceReading& slice : reading->slices) {
    if (slice.weight > 0.0) CHECK(slice.wanted_d == doctest::Approx(1.0 / 0.585 - 1.0 / 0.435).epsilon(1e-4));
  }
  reader.ask(slices, Side::left, {-5, 1});
  CHECK(reader.answer() == nullptr);
}

TEST_CASE("false colours: the slice that gives the light gives the hue") {
  CompiledSlices compiled;
  compiled.images = {2, 2, 1, 1, {255, 0, 0, 100}};
  compiled.settings.bits = 8;
  compiled.settings.images = {{ImageEye::left, ImageKind::content, 0.0, 0},
                              {ImageEye::left, ImageKind::content, 1.0, 1}};
  const std::vector<glm::dvec3> colours{{1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
  // Code 100 of 255 is a light of 0.392; its square root, 0.626, is code 160.
  CHECK(assignment_picture(compiled, Side::left, colours) == std::vector<std::uint8_t>{255, 0, 0, 0, 0, 160});
  CHECK(assignment_picture(compiled, Side::right, colours) == std::vector<std::uint8_t>(6, 0));
  const std::vector<std::uint8_t> with{200, 0, 9}, without{0, 100, 9};
  CHECK(difference_picture(with, without, 1) == std::vector<std::uint8_t>{200, 140, 50, 30, 60, 100, 0, 0, 0});
}
