#include "core/schedule/sweep_shape.h"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>
#include <numbers>

#include "core/schedule/shape_rules.h"

using namespace focalstage;

namespace {

constexpr double pi = std::numbers::pi;

/// A lens of first order: gain g, lag in seconds, listed up to `harmonics` of 60 Hz.
LensResponse lens(double gain, double lag_s, int harmonics = most_shaped_harmonics) {
  LensResponse response;
  for (int n = 0; n <= harmonics; ++n) {
    const double x = 2.0 * pi * 60.0 * n * lag_s;
    response.push_back({n, gain / std::hypot(1.0, x), -std::atan(x) * 180.0 / pi, {}});
  }
  return response;
}

Project rig(double min_d, double max_d, std::vector<double> powers_d) {
  Project project;
  project.projectors.emplace_back();
  project.sweep.min_power_d = min_d;
  project.sweep.max_power_d = max_d;
  project.slices.powers_d = std::move(powers_d);
  project.glasses.lens_response = {lens(38.0, 6e-4), lens(37.5, 6.5e-4)};
  return project;
}

/// The slices and sweeps of the samples.
std::vector<Project> sample_rigs() {
  return {rig(-1.5, 1.5, {-1.0, -0.5, 0.0, 0.5, 1.0}),        rig(-1.5, 1.5, {-1.0, 0.0, 1.0}),
          rig(-2.95, 0.35, {-2.6, -2.1, -1.6, 0.0}),          rig(-1.0, 2.0, {-0.5, 0.0, 0.5, 1.0, 1.5}),
          rig(-1.34, 1.84, {-1.0, -0.5, 0.0, 0.5, 1.0, 1.5}), rig(-1.75, 1.25, {-1.0, -0.5, 0.0, 0.5})};
}

Result<SweepShape> shaped(const Project& project, const ShapeOptions& options = {}) {
  return shape_sweep(project, image_plan(project), options);
}

std::complex<double> coefficient(const std::vector<double>& samples, int harmonic) {
  std::complex<double> sum = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double turn = static_cast<double>(i) * harmonic / static_cast<double>(samples.size());
    sum += samples[i] * std::polar(1.0, -2.0 * pi * turn);
  }
  return sum / static_cast<double>(samples.size());
}

const ShapeBound* bound(const SweepShape& shape, ShapeLimit limit) {
  for (const ShapeBound& entry : shape.bounds) {
    if (entry.limit == limit) return &entry;
  }
  return nullptr;
}

std::string code_of(const Result<SweepShape>& result) { return result ? "" : result.fault().code; }

}  // namespace

TEST_CASE("the samples' slices smear at most half as much as on the sine, without new trouble") {
  for (const Project& project : sample_rigs()) {
    const Result<SweepShape> shape = shaped(project);
    REQUIRE(shape.ok());
    CHECK(shape->better);
    CHECK(shape->shaped.slots.size() == 2 * project.slices.powers_d.size());
    CHECK(shape->shaped.troubles.empty());
    CHECK(2.0 * worst_smear_d(shape->shaped) <= worst_smear_d(shape->sine));
    // What the project that carries the waveform is timed as is what was promised.
    Project with = project;
    for (const Side eye : both_sides) with.sweep.waveform[eye] = shape->waveform[eye];
    CHECK(time_slots(with, image_plan(with)).slots == shape->shaped.slots);
  }
}

TEST_CASE("the smear is what the curve's own Fourier series says, not its samples") {
  for (const Project& project : sample_rigs()) {
    const Result<SweepShape> shape = shaped(project);
    REQUIRE(shape.ok());
    const auto power_d = [&](Side eye, double time_s) {
      const std::vector<double>& samples = shape->waveform[eye].power_d;
      double sum = coefficient(samples, 0).real();
      for (int n = 1; n <= shape->highest_harmonic; ++n) {
        sum += 2.0 * (coefficient(samples, n) * std::polar(1.0, 2.0 * pi * n * 60.0 * time_s)).real();
      }
      return sum;
    };
    for (const Slot& slot : shape->shaped.slots) {
      const double change_d = power_d(slot.eye, slot.start_s + slot.exposure_s) - power_d(slot.eye, slot.start_s);
      CHECK(std::abs(std::abs(change_d) - slot.smear_d) < 2e-3);
      CHECK((change_d > 0.0) == (slot.eye == Side::left));
      CHECK(std::abs(power_d(slot.eye, slot.start_s + slot.exposure_s / 2.0) - slot.power_d) < 2e-3);
    }
  }
}

TEST_CASE("the waveform is a curve as files want it, and no harmonic beyond the highest is in it") {
  const Project project = sample_rigs().front();
  for (const int highest : {1, 2, 5, 12, 24}) {
    ShapeOptions options;
    options.max_harmonic = highest;
    const Result<SweepShape> shape = shaped(project, options);
    REQUIRE(shape.ok());
    REQUIRE(shape->better);
    CHECK(shape->highest_harmonic == highest);
    Project with = project;
    for (const Side eye : both_sides) {
      with.sweep.waveform[eye] = shape->waveform[eye];
      const Result<PowerCurve> curve = PowerCurve::make(with.sweep, eye);
      REQUIRE(curve.ok());
      CHECK(curve->peak_s() == doctest::Approx(1.0 / 120.0));
      CHECK(curve->min_d() >= -1.5 - 1e-6);
      CHECK(curve->max_d() <= 1.5 + 1e-6);
      for (int n = highest + 1; n < 60; ++n) {
        CHECK(std::abs(coefficient(shape->waveform[eye].power_d, n)) < 1e-8);
        CHECK(std::abs(coefficient(shape->waveform[eye].drive_a, n)) < 1e-8);
      }
    }
  }
}

TEST_CASE("each lens makes the wanted power of its own drive") {
  const Project project = sample_rigs().front();
  const Result<SweepShape> shape = shaped(project);
  REQUIRE(shape.ok());
  for (const Side eye : both_sides) {
    const double gain = eye == Side::left ? 38.0 : 37.5;
    const double lag_s = eye == Side::left ? 6e-4 : 6.5e-4;
    for (int n = 0; n <= shape->highest_harmonic; ++n) {
      // First order, written down here anew: 1 / (1 + i omega lag).
      const std::complex<double> lens = gain / std::complex<double>(1.0, 2.0 * pi * 60.0 * n * lag_s);
      const std::complex<double> power_d = lens * coefficient(shape->waveform[eye].drive_a, n);
      CHECK(std::abs(power_d - coefficient(shape->waveform[eye].power_d, n)) < 1e-6);
    }
  }
  CHECK(shape->waveform.left.drive_a != shape->waveform.right.drive_a);
  const std::size_t count = shape->waveform.left.power_d.size();
  for (std::size_t i = 1; i < count; ++i) {
    CHECK(shape->waveform.right.power_d[i] == shape->waveform.left.power_d[count - i]);
  }
}

TEST_CASE("more harmonics never smear more; one is the sine of the right size") {
  const Project project = sample_rigs().front();
  double before_d = worst_smear_d(shaped(project)->sine);
  for (const int highest : {1, 3, 8, 14, 20}) {
    const Result<SweepShape> shape = shaped(project, {highest});
    REQUIRE(shape.ok());
    CHECK(worst_smear_d(shape->shaped) <= before_d * 1.02);
    before_d = worst_smear_d(shape->shaped);
  }
  // The least sine that shows +-1 D: the first exposure begins as the shutters rest, 1.5 ms in, so 1.75 ms after the
  // minimum: amplitude 1 / cos(2 pi 60 0.00175) = 1.2660 D; its worst smear, about 0 D, is 2 A sin(2 pi 60 0.00025).
  const double least_d = 2.0 / std::cos(2.0 * pi * 60.0 * 0.00175) * std::sin(2.0 * pi * 60.0 * 0.00025);
  CHECK(worst_smear_d(shaped(project, {1})->shaped) == doctest::Approx(least_d).epsilon(0.005));
}

TEST_CASE("the harmonics end where the response does, at the highest frequency, or as asked") {
  Project project = sample_rigs().front();
  CHECK(shaped(project)->highest_harmonic == most_shaped_harmonics);
  CHECK(bound(*shaped(project), ShapeLimit::harmonics));
  project.glasses.lens_limits.emplace().max_frequency_hz = 500.0;
  CHECK(shaped(project)->highest_harmonic == 8);
  CHECK(bound(*shaped(project), ShapeLimit::frequency)->allowed == 8.0);
  project.glasses.lens_response.right = lens(37.5, 6.5e-4, 5);
  CHECK(shaped(project)->highest_harmonic == 5);
  CHECK(bound(*shaped(project), ShapeLimit::response)->allowed == 5.0);
  CHECK(bound(*shaped(project, {3}), ShapeLimit::asked)->allowed == 3.0);
  project.glasses.lens_response.left.erase(project.glasses.lens_response.left.begin() + 2);  // a gap ends them too
  CHECK(shaped(project)->highest_harmonic == 1);
  project.glasses.lens_response = {};
  CHECK(shaped(project)->highest_harmonic == 1);
}

TEST_CASE("a current that is too large is shaped away, at the price of smear") {
  Project project = sample_rigs().front();
  const Result<SweepShape> free = shaped(project);
  LensLimits& limits = project.glasses.lens_limits.emplace();
  limits.max_current_a = 0.9 * std::max(free->shaped_load.left.peak_a, free->shaped_load.right.peak_a);
  const Result<SweepShape> held = shaped(project);
  REQUIRE(held.ok());
  REQUIRE(held->better);
  CHECK(worst_smear_d(held->shaped) >= worst_smear_d(free->shaped) - 1e-6);
  for (const Side eye : both_sides) {
    for (const double current_a : held->waveform[eye].drive_a) CHECK(std::abs(current_a) <= limits.max_current_a);
  }
  CHECK(bound(*held, ShapeLimit::current));

  limits.max_current_a = 0.29;
  limits.max_rms_current_a = 0.985 * std::min(free->shaped_load.left.rms_a, free->shaped_load.right.rms_a);
  const Result<SweepShape> cool = shaped(project);
  REQUIRE(cool.ok());
  REQUIRE(cool->better);
  CHECK(cool->shaped_load.left.rms_a <= limits.max_rms_current_a);
  CHECK(cool->shaped_load.right.rms_a <= limits.max_rms_current_a);
  CHECK(bound(*cool, ShapeLimit::rms_current));
}

TEST_CASE("limits that allow nothing better say which, and by how much") {
  Project project = sample_rigs().front();
  // Slices at +-1 D take 1 / 38 = 26 mA however slowly they are reached.
  project.glasses.lens_limits.emplace().max_current_a = 0.02;
  const Result<SweepShape> shape = shaped(project);
  REQUIRE(shape.ok());
  CHECK_FALSE(shape->better);
  CHECK(shape->waveform.left.power_d.empty());
  const ShapeBound* current = bound(*shape, ShapeLimit::current);
  REQUIRE(current);
  CHECK(current->needed > 0.026);
  CHECK(current->allowed == 0.02);

  project.glasses.lens_limits.emplace().max_rms_current_a = 0.005;
  const Result<SweepShape> hot = shaped(project);
  REQUIRE(hot.ok());
  CHECK_FALSE(hot->better);
  CHECK(bound(*hot, ShapeLimit::rms_current)->needed > 0.005);
}

TEST_CASE("the order of slices does not matter, and one slice is enough") {
  const Result<SweepShape> risen = shaped(rig(-1.5, 1.5, {-1.0, -0.5, 0.0, 0.5, 1.0}));
  const Result<SweepShape> mixed = shaped(rig(-1.5, 1.5, {0.5, -1.0, 1.0, 0.0, -0.5}));
  REQUIRE(risen.ok());
  REQUIRE(mixed.ok());
  CHECK(risen->waveform == mixed->waveform);
  const Result<SweepShape> one = shaped(rig(-1.5, 1.5, {0.2}));
  REQUIRE(one.ok());
  CHECK(one->better);
  CHECK(worst_smear_d(one->shaped) < 0.02);
}

TEST_CASE("light for surfaces is dwelt at too") {
  Project project = rig(-1.5, 1.5, {-1.0, 0.8});
  project.surfaces.emplace_back().illumination = 1.0;
  const Result<SweepShape> shape = shaped(project);
  REQUIRE(shape.ok());
  REQUIRE(shape->shaped.slots.size() == 6);
  CHECK(2.0 * worst_smear_d(shape->shaped) < worst_smear_d(shape->sine));
}

TEST_CASE("what cannot be shaped says why") {
  const double nan = std::nan("");
  const Project sound = rig(-1.5, 1.5, {-1.0, 0.0, 1.0});
  const auto with = [&](auto change) {
    Project project = sound;
    change(project);
    const Result<SweepShape> result = shaped(project);
    if (!result) {
      CHECK_FALSE(result.fault().message.empty());
      CHECK_FALSE(result.fault().remedy.empty());
      CHECK_FALSE(result.fault().where.empty());
    }
    return code_of(result);
  };
  CHECK(with([](Project& p) { p.slices.powers_d = {}; }) == "shape.slices");
  CHECK(with([](Project& p) { p.slices.powers_d = {0.5, 0.0, 0.5}; }) == "shape.slices");
  CHECK(with([&](Project& p) { p.slices.powers_d = {0.5, nan}; }) == "shape.slices");
  CHECK(with([](Project& p) { p.slices.powers_d = {0.0, 1.6}; }) == "shape.slices");
  CHECK(with([](Project& p) { p.projectors = {}; }) == "shape.projector");
  CHECK(with([&](Project& p) { p.projectors[0].exposure_ms = nan; }) == "shape.projector");
  CHECK(with([](Project& p) { p.projectors[0].frames_per_second = 0.0; }) == "shape.projector");
  CHECK(with([](Project& p) { p.projectors[0].exposure_ms = 4.0; }) == "shape.room");
  CHECK(with([](Project& p) { p.glasses.shutter_open_ms = 9.0; }) == "shape.room");
  CHECK(with([&](Project& p) { p.glasses.shutter_open_ms = nan; }) == "shape.room");
  CHECK(with([](Project& p) { p.glasses.lens_limits.emplace().max_current_a = -0.1; }) == "shape.limits");
  CHECK(with([&](Project& p) { p.glasses.lens_limits.emplace().max_rms_current_a = nan; }) == "shape.limits");
  CHECK(with([](Project& p) { p.glasses.lens_limits.emplace().max_frequency_hz = 0.0; }) == "shape.limits");
  CHECK(with([](Project& p) { p.glasses.lens_response.left[1].gain_d_per_a = 0.0; }) == "shape.limits");
  CHECK(with([&](Project& p) { p.glasses.lens_response.left[7].phase_deg = nan; }) == "shape.limits");
  CHECK(with([](Project& p) { p.glasses.lens_range_d = {1.0, -1.0}; }) == "shape.limits");
  CHECK(with([](Project& p) { p.sweep.frequency_hz = 0.0; }) == "shape.sweep");
  CHECK(with([](Project& p) { p.sweep.max_power_d = -2.0; }) == "shape.sweep");
  CHECK(code_of(shaped(sound, {0})) == "shape.limits");
  CHECK(code_of(shaped(sound, {-3})) == "shape.limits");
  // A harmonic that does not answer ends the others; it is no fault.
  CHECK(with([](Project& p) { p.glasses.lens_response.left[7].gain_d_per_a = 0.0; }).empty());
}

TEST_CASE("whatever the rig, it ends in time, alike each time, and brings no trouble") {
  std::uint64_t state = 11;
  const auto noise = [&](double low, double high) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * static_cast<double>(state >> 11) / 9007199254740992.0;
  };
  int better = 0;
  for (int round = 0; round < 30; ++round) {
    Project project = rig(noise(-4.0, -1.0), noise(0.5, 4.0), {});
    const int slices = 1 + static_cast<int>(noise(0.0, 7.0));
    for (int k = 0; k < slices; ++k) {
      project.slices.powers_d.push_back(noise(project.sweep.min_power_d, project.sweep.max_power_d));
    }
    project.sweep.frequency_hz = noise(40.0, 90.0);
    project.projectors[0].exposure_ms = noise(0.1, 0.9);
    project.glasses.lens_limits.emplace().max_current_a = noise(0.02, 0.2);
    const ShapeOptions options{1 + static_cast<int>(noise(0.0, 24.0))};
    const auto begun = std::chrono::steady_clock::now();
    const Result<SweepShape> shape = shaped(project, options);
    CHECK(std::chrono::steady_clock::now() - begun < std::chrono::seconds(20));
    if (!shape || !shape->better) continue;
    ++better;
    CHECK(worst_smear_d(shape->shaped) > 0.0);
    CHECK(shape->shaped.troubles.size() <= shape->sine.troubles.size());
    CHECK(shape->shaped_load.left.peak_a <= project.glasses.lens_limits->max_current_a + 1e-7);
    CHECK(shape->shaped_load.right.peak_a <= project.glasses.lens_limits->max_current_a + 1e-7);
    if (round % 10 == 0) CHECK(shaped(project, options)->waveform == shape->waveform);
  }
  CHECK(better > 10);
}
