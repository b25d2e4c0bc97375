// What a linear, time-invariant lens makes of the drive samples: a converter joins them by straight lines, the lens
// takes each harmonic through its gain and lag. Nothing here uses the inverse that made the drive.

#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "core/schedule/schedule.h"

using namespace focalstage;

namespace {

constexpr double pi = std::numbers::pi;

Project rig(double min_d, double max_d, std::vector<double> powers_d) {
  Project project;
  Projector projector;
  projector.frames_per_second = 2840.0;
  project.projectors = {projector};
  project.sweep.min_power_d = min_d;
  project.sweep.max_power_d = max_d;
  project.slices.powers_d = std::move(powers_d);
  const LensResponse left{{0, 41.5, 0.0, {}}, {1, 38.0, -14.0, {}}, {2, 33.0, -31.0, {}}, {3, 27.0, -50.0, {}}};
  const LensResponse right{{1, 36.5, -18.0, {}}, {0, 39.0, 0.0, {}}};
  project.glasses.lens_response = {left, right};
  return project;
}

/// Lens power at `time_s`. The straight lines between K samples have the Fourier coefficients of the samples, times
/// sinc^2(n / K); every harmonic that the response does not list passes at 40 D/A.
double delivered_d(const std::vector<double>& drive_a, const LensResponse& response, double period_s, double time_s) {
  const auto count = static_cast<double>(drive_a.size());
  const double place = time_s / period_s * count;
  const auto before = static_cast<std::size_t>(std::floor(place));
  const double share = place - std::floor(place);
  const double straight_a =
      drive_a[before % drive_a.size()] * (1.0 - share) + drive_a[(before + 1) % drive_a.size()] * share;
  double power_d = 40.0 * straight_a;
  for (const LensHarmonic& entry : response) {
    std::complex<double> coefficient = 0.0;
    for (std::size_t i = 0; i < drive_a.size(); ++i) {
      coefficient += drive_a[i] * std::polar(1.0, -2.0 * pi * entry.harmonic * static_cast<double>(i) / count) / count;
    }
    const double x = pi * entry.harmonic / count;
    if (entry.harmonic > 0) coefficient *= 2.0 * std::pow(std::sin(x) / x, 2.0);
    const std::complex<double> factor = std::polar(entry.gain_d_per_a, entry.phase_deg * pi / 180.0) - 40.0;
    power_d += (coefficient * factor * std::polar(1.0, 2.0 * pi * entry.harmonic * time_s / period_s)).real();
  }
  return power_d;
}

/// Every slot: the lens has the asked power at mid-exposure within 1e-4 D, and passes it within 1 us.
void check_delivery(const Project& project) {
  const ScheduleResult result = make_schedule(project, image_plan(project));
  const Schedule& schedule = result.schedule;
  REQUIRE(schedule.slots.size() == 2 * project.slices.powers_d.size());
  for (const Slot& slot : schedule.slots) {
    const double middle_s = slot.start_s + slot.exposure_s / 2.0;
    const auto delivered = [&](double time_s) {
      return delivered_d(schedule.lens_drive_a[slot.eye], project.glasses.lens_response[slot.eye], schedule.period_s,
                         time_s);
    };
    const double asked_d =
        project.slices.powers_d[static_cast<std::size_t>(slot.image) % project.slices.powers_d.size()];
    const double off_d = delivered(middle_s) - asked_d;
    const double slope_d_per_s = (delivered(middle_s + 5e-5) - delivered(middle_s - 5e-5)) / 1e-4;
    CHECK(std::abs(off_d) < 1e-4);
    CHECK(std::abs(off_d / slope_d_per_s) < 1e-6);
    CHECK((slope_d_per_s > 0.0) == (slot.eye == Side::left));
  }
}

}  // namespace

TEST_CASE("a lagging lens delivers a sine at every slot") {
  check_delivery(rig(-1.5, 1.5, {-1.15, -1.0, -0.5, 0.0, 0.5, 1.0, 1.15}));
  check_delivery(rig(-10.0, 10.0, {-8.0, -3.0, 0.0, 4.0, 8.0}));
  check_delivery(rig(-3.1, 0.4, {-2.6, -2.1, -1.6}));
}

TEST_CASE("a lagging lens delivers a measured waveform at every slot") {
  Project project = rig(0.0, 0.0, {-1.0, -0.5, 0.0, 0.5, 1.0});
  MeasuredWaveform waveform;
  for (int i = 0; i < 500; ++i) {
    const double turn = 2.0 * pi * i / 500.0;
    waveform.power_d.push_back(-1.5 * std::cos(turn) + 0.12 * std::cos(2.0 * turn));
  }
  project.sweep.waveform = {waveform, waveform};
  check_delivery(project);
}

TEST_CASE("a drive measured with the power is used as it is") {
  Project project = rig(0.0, 0.0, {0.0});
  MeasuredWaveform waveform;
  for (int i = 0; i < 256; ++i) {
    waveform.power_d.push_back(-1.5 * std::cos(2.0 * pi * i / 256.0));
    waveform.drive_a.push_back(0.01 * i);
  }
  project.sweep.waveform.left = waveform;
  const Schedule schedule = make_schedule(project, image_plan(project)).schedule;
  REQUIRE(schedule.lens_drive_a.left.size() == 1024);
  for (std::size_t i = 0; i < 256; ++i) CHECK(schedule.lens_drive_a.left[4 * i] == waveform.drive_a[i]);
}
