#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "core/compile/compile.h"
#include "core/percept/seen_frame.h"
#include "core/reference/seen.h"
#include "core/retina/retina.h"
#include "core/stage/stage.h"
#include "io/assets/assets.h"
#include "io/project/project_file.h"
#include "tests/exact/sample_projects.h"

// The fast retina, which cuts exposures into powers and spreads light in layers, against rays that know nothing but the
// lens: every sample, both eyes, through the whole range of focus.

using namespace focalstage;
using namespace focalstage::exact;

namespace {

/// One frame of a sample as it would be shown.
struct Shown {
  Stage stage;
  CompileSettings settings;
  CompiledFrame frame;
  Schedule schedule;
  WornGlasses glasses;

  RetinaInput input(Side side) const { return seen_frame(stage, settings, frame.images, schedule, glasses, side); }
};

Shown shown_frame(const Opened& opened, int frame) {
  Shown shown;
  shown.stage = staged(opened.project, opened.loaded.assets, frame);
  shown.settings = compile_settings(opened.project);
  auto compiled = Compiler(shown.settings).frame(shown.stage);
  REQUIRE(compiled);
  shown.frame = *std::move(compiled);
  shown.schedule = make_schedule(opened.project, shown.settings.images).schedule;
  shown.glasses = worn_glasses(opened.project.glasses);
  return shown;
}

struct Apart {
  double rms = 0.0;  ///< of the peak
  double sum = 0.0;  ///< of the light, relative
};

Apart apart(const RetinaImage& fast, const RetinaImage& exact) {
  double squares = 0.0, peak = 0.0, fast_sum = 0.0, exact_sum = 0.0;
  for (std::size_t i = 0; i < exact.rgb.size(); ++i) {
    const double off = double{fast.rgb[i]} - exact.rgb[i];
    squares += off * off;
    peak = std::max(peak, double{exact.rgb[i]});
    fast_sum += fast.rgb[i];
    exact_sum += exact.rgb[i];
  }
  return {std::sqrt(squares / static_cast<double>(exact.rgb.size())) / peak, fast_sum / exact_sum - 1.0};
}

}  // namespace

TEST_CASE("the fast retina is within 2 % of the rays on every sample") {
  for (const std::filesystem::path& folder : projects()) {
    const Opened sample = opened(folder);
    const Shown shown = shown_frame(sample, 0);
    for (const Side side : both_sides) {
      const RetinaInput input = shown.input(side);
      Retina retina;
      for (const double focus_d : side == Side::left ? std::vector<double>{0.5, 2.0, 3.5} : std::vector<double>{1.5}) {
        RetinaView view;
        view.eye = side;
        view.width_px = 200;
        view.height_px = 150;
        view.fov_deg = 45.0;
        view.focus_d = focus_d;
        const auto fast = retina.view(input, view);
        const auto exact = see_by_rays(input, view, {96});
        REQUIRE(fast);
        REQUIRE(exact);
        const Apart off = apart(*fast, *exact);
        INFO(folder.filename().string() << ", eye " << index_of(side) << ", focus " << focus_d << " D");
        MESSAGE(folder.filename().string()
                << ", eye " << index_of(side) << ", focus " << focus_d << " D: RMS " << 100.0 * off.rms
                << " % of the peak, light off by " << 100.0 * off.sum << " %");
        CHECK(off.rms <= 0.02);
        // Depth matching's only light is a pointer whose sides are thinner than a pixel.
        CHECK(std::abs(off.sum) <= (sample.project.name == "Depth matching" ? 0.02 : 0.004));
      }
    }
  }
}

TEST_CASE(
    "what is asked for beside the lens agrees, too: the eye's colours, diffraction, the projector's focus, the rim") {
  const Shown shown = shown_frame(opened(FOCALSTAGE_SOURCE_DIR "/projects/slanted-checker"), 0);
  RetinaInput input = shown.input(Side::left);
  RetinaView view;
  view.width_px = 200;
  view.height_px = 150;
  view.fov_deg = 10.0;
  view.focus_d = 1.5;
  const auto compared = [&](const std::string& what) {
    const auto exact = see_by_rays(input, view, {160});
    const auto fast = Retina().view(input, view);
    REQUIRE(exact);
    REQUIRE(fast);
    const Apart off = apart(*fast, *exact);
    MESSAGE(what << ": RMS " << 100.0 * off.rms << " % of the peak, light off by " << 100.0 * off.sum << " %");
    CHECK(off.rms <= 0.02);
    CHECK(std::abs(off.sum) <= 0.004);
    return *fast;
  };
  const RetinaImage plain = compared("plain");
  view.chromatic = true;
  const RetinaImage coloured = compared("chromatic");
  CHECK(apart(coloured, plain).rms > 0.02);
  view.chromatic = false;
  view.pupil_m = 0.0005;
  view.diffraction = true;
  const RetinaImage narrow = compared("diffraction at a pupil of 0.5 mm");
  view.diffraction = false;
  CHECK(apart(*Retina().view(input, view), narrow).rms > 0.005);
  view.pupil_m = 0.004;
  input.projector_focus = {1.0 / 1.6, 0.12};  // the screen, about 0.9 m away, lies 0.5 D off
  const RetinaImage defocused = compared("projector out of focus");
  CHECK(apart(defocused, plain).rms > 0.02);
  input.projector_focus = {};
  input.lens_aperture_m = 0.004;
  view.fov_deg = 30.0;
  view.focus_d = 2.0;
  const RetinaImage rim = compared("a lens of 4 mm");
  CHECK(apart(rim, plain).sum < -0.2);
}

TEST_CASE("the light of a diamond lattice, sharp and out of focus") {
  const Opened sample = opened(FOCALSTAGE_SOURCE_DIR "/projects/slanted-checker");
  Shown shown;
  shown.stage = staged(sample.project, sample.loaded.assets, 0);
  shown.settings = compile_settings(sample.project);
  ProjectorModel& projector = shown.settings.projector;
  projector.layout = PixelLayout::diamond;
  projector.width_px /= 2;  // mirrors twice as wide as the sample's, and rows as high
  projector.focal_px.x /= 2.0;
  projector.centre_px.x /= 2.0;
  auto compiled = Compiler(shown.settings).frame(shown.stage);
  REQUIRE(compiled);
  shown.frame = *std::move(compiled);
  shown.schedule = make_schedule(sample.project, shown.settings.images).schedule;
  shown.glasses = worn_glasses(sample.project.glasses);
  RetinaInput input = shown.input(Side::left);
  RetinaView view;
  view.width_px = 200;
  view.height_px = 150;
  view.fov_deg = 12.0;
  view.focus_d = 1.5;
  for (const double depth_of_field_d : {0.0, 0.24}) {
    input.projector_focus = {1.0 / 1.6, depth_of_field_d};
    const auto exact = see_by_rays(input, view, {160});
    const auto fast = Retina().view(input, view);
    RetinaInput mistaken = input;
    mistaken.projector.layout = PixelLayout::square;
    const auto square = Retina().view(mistaken, view);
    REQUIRE(exact);
    REQUIRE(fast);
    REQUIRE(square);
    const Apart off = apart(*fast, *exact);
    MESSAGE("depth of field " << depth_of_field_d << " D: RMS " << 100.0 * off.rms << " % of the peak, light off by "
                              << 100.0 * off.sum << " %; taken for a square lattice "
                              << 100.0 * apart(*square, *exact).rms << " %");
    CHECK(off.rms <= 0.02);
    CHECK(std::abs(off.sum) <= 0.004);
    CHECK(apart(*square, *exact).rms > 2.0 * off.rms);
  }
}

TEST_CASE("off the axis the powers that pass in one exposure are told apart") {
  const Shown shown = shown_frame(opened(FOCALSTAGE_SOURCE_DIR "/projects/slanted-checker"), 0);
  RetinaInput input = shown.input(Side::left);
  RetinaView view;
  view.width_px = 240;
  view.height_px = 120;
  view.fov_deg = 3.0;
  view.gaze = {0.22, 0.02};
  view.focus_d = 1.0;
  const auto exact = see_by_rays(input, view, {128});
  const auto fast = Retina().view(input, view);
  for (RetinaExposure& exposure : input.exposures) {  // each as if the lens stood still meanwhile
    double mean_d = 0.0;
    for (const PowerShare& part : exposure.powers) mean_d += part.share * part.power_d;
    exposure.powers = {{mean_d, 1.0}};
  }
  const auto frozen = Retina().view(input, view);
  REQUIRE(exact);
  REQUIRE(fast);
  REQUIRE(frozen);
  MESSAGE("RMS " << 100.0 * apart(*fast, *exact).rms << " %, " << 100.0 * apart(*frozen, *exact).rms
                 << " % were the lens to stand still");
  CHECK(apart(*fast, *exact).rms <= 0.02);
  CHECK(apart(*frozen, *exact).rms > 1.5 * apart(*fast, *exact).rms);
}

namespace {

/// A project of one bright board before the left lens' shutter that is slow to close.
Project slow_shutters() {
  Project project = opened(FOCALSTAGE_SOURCE_DIR "/projects/three-rabbits").project;
  project.glasses.shutter_close_ms = 3.0;
  return project;
}

double leaked_share(const RetinaInput& input, Side side) {
  RetinaView view;
  view.eye = side;
  view.width_px = 100;
  view.height_px = 75;
  RetinaInput others = input;
  std::erase_if(others.exposures, [](const RetinaExposure& exposure) { return exposure.own; });
  const auto sum = [&](const RetinaInput& seen) {
    const auto image = Retina().view(seen, view);
    REQUIRE(image);
    double all = 0.0;
    for (const float light : image->rgb) all += light;
    return all;
  };
  return sum(others) / sum(input);
}

}  // namespace

TEST_CASE("shutters twice as slow as the show believes let the other eye's light in") {
  Opened sample = opened(FOCALSTAGE_SOURCE_DIR "/projects/three-rabbits");
  sample.project = slow_shutters();
  Shown shown = shown_frame(sample, 0);
  for (const Side side : both_sides) CHECK(leaked_share(shown.input(side), side) == 0.0);
  shown.glasses.shutter.open_s *= 2.0;
  shown.glasses.shutter.close_s *= 2.0;
  for (const Side side : both_sides) {
    const double leaked = leaked_share(shown.input(side), side);
    MESSAGE("eye " << index_of(side) << ": " << 100.0 * leaked << " % of the light is the other eye's");
    CHECK(leaked > 0.01);
    CHECK(leaked < 0.5);
  }
}
