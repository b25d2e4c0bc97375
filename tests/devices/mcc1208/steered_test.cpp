#include "devices/mcc1208/steered.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

namespace focalstage {
namespace {

constexpr int samples = 400;
constexpr double turn = 2.0 * std::numbers::pi;

int sine_code(double phase) { return 2048 + static_cast<int>(std::lround(1000.0 * std::sin(turn * phase))); }

std::vector<int> sine() {
  std::vector<int> codes;
  for (int i = 0; i < samples; ++i) codes.push_back(sine_code(static_cast<double>(i) / samples));
  return codes;
}

struct Scan {
  int lens;
  bool high;
};

std::vector<Scan> played(Mcc1208Steered& steered, int scans) {
  std::vector<std::uint8_t> bytes;
  steered.play(scans, bytes);
  REQUIRE(bytes.size() == 4 * static_cast<std::size_t>(scans));
  std::vector<Scan> found;
  for (std::size_t i = 0; i < bytes.size(); i += 4) {
    found.push_back({bytes[i] | bytes[i + 1] << 8, (bytes[i + 2] | bytes[i + 3] << 8) == 4095});
  }
  return found;
}

std::vector<std::size_t> edges(const std::vector<Scan>& scans) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    if (scans[i].high && (i == 0 || !scans[i - 1].high)) found.push_back(i);
  }
  return found;
}

TEST_CASE("unsteered it plays the samples as they are, edge and all, for ever") {
  Mcc1208Steered steered(sine(), 24);
  const auto scans = played(steered, 1000 * samples);
  int wrong = 0;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    wrong += scans[i].lens != sine()[i % samples] || scans[i].high != (i % samples < 24) ? 1 : 0;
  }
  CHECK(wrong == 0);
  CHECK(steered.periods() == doctest::Approx(1000.0));
  CHECK(steered.edges_late() == doctest::Approx(0.0));
}

TEST_CASE("59.94 Hz on scans of 60 Hz: the wave is where it should be at each scan, edges less than one late") {
  constexpr double period = samples * 60.0 / 59.94;
  Mcc1208Steered steered(sine(), 24);
  steered.steer(period, 0.0);
  const auto scans = played(steered, 600 * samples);
  int worst = 0;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const double phase = static_cast<double>(i) / period;
    worst = std::max(worst, std::abs(scans[i].lens - sine_code(phase - std::floor(phase))));
  }
  CHECK(worst <= 1);
  double late = 0.0;
  double most = 0.0;
  const auto found = edges(scans);
  CHECK(found.size() == 600);  // and 599.4 periods were played
  for (std::size_t k = 0; k < found.size(); ++k) {
    const double off = static_cast<double>(found[k]) - static_cast<double>(k) * period;
    CHECK(off > -1e-6);
    most = std::max(most, off);
    if (k + 64 >= found.size()) late += off / 64.0;
  }
  CHECK(most < 1.0);
  CHECK(steered.edges_late() == doctest::Approx(late).epsilon(0.05));
}

TEST_CASE("a shift comes whole, no faster than a hundredth, and the next one on top of it") {
  Mcc1208Steered steered(sine(), 24);
  played(steered, samples);
  steered.steer(samples, 37.5);
  steered.steer(samples, 2.5);
  const auto moving = played(steered, 4000);
  int steepest = 0;
  for (std::size_t i = 1; i < moving.size(); ++i) {
    steepest = std::max(steepest, std::abs(moving[i].lens - moving[i - 1].lens));
  }
  CHECK(steepest <= 17);  // 1000 * 2 pi / 400 is 15.7, and rounding
  const auto after = edges(played(steered, 10 * samples));
  REQUIRE(after.size() >= 9);
  for (const std::size_t edge : after) CHECK(edge % samples == 40);
  steered.steer(samples, -140.0);
  played(steered, 20000);
  for (const std::size_t edge : edges(played(steered, 10 * samples))) CHECK(edge % samples == 300);
}

TEST_CASE("another wave comes with the next period, whole") {
  Mcc1208Steered steered(sine(), 24);
  played(steered, 100);
  steered.replace(std::vector<int>(samples, 7));
  const auto scans = played(steered, samples);
  for (std::size_t i = 0; i < scans.size(); ++i) CHECK((scans[i].lens == 7) == (i >= 300));
}

}  // namespace
}  // namespace focalstage
