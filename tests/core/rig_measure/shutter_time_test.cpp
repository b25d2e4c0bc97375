#include "core/rig_measure/shutter_time.h"

#include <doctest/doctest.h>

#include "tests/core/rig_measure/bench.h"

using namespace focalstage;

namespace {

constexpr double open_told_s = 0.001;
constexpr double close_told_s = 0.0075;

struct Bench {
  bench::Sensor sensor;
  std::function<double(double)> transmission;
  double leak = 0.0;

  std::vector<LightPoint> shares() const {
    const auto train = [](double t) { return 0.5 * bench::exposures(t, 0.0002, 0.0092, 0.00035, 0.00002); };
    bench::Sensor now = sensor;
    const auto dark = dark_light(bench::record(
        now, [](double) { return 0.0; }, 0.0, 360));
    REQUIRE(dark);
    ++now.seed;
    const auto full = FullLight::make(bench::record(now, train, 0.0, 360), *dark, "left eye");
    REQUIRE(full);
    ++now.seed;
    return full->shares(bench::record(
        now, [&](double t) { return train(t) * (leak + (1.0 - leak) * transmission(t)); }, 0.0, 360));
  }
  Result<Estimate> opens() const {
    return shutter_time_ms(shares(), {true, open_told_s, close_told_s}, {sensor.step_s, 0.0, 0.0}, "left shutter");
  }
  Result<Estimate> closes() const {
    return shutter_time_ms(shares(), {false, close_told_s, 0.0091}, {sensor.step_s, 0.0, 0.0}, "left shutter");
  }
};

/// Straight from closed to open and back.
std::function<double(double)> straight(double open_s, double close_s) {
  return [=](double t) {
    const double up = std::clamp((t - open_told_s) / open_s, 0.0, 1.0);
    const double down = std::clamp((t - close_told_s) / close_s, 0.0, 1.0);
    return up * (1.0 - down);
  };
}

TEST_CASE("a shutter that runs straight takes its whole run, opening and closing apart") {
  Bench bench;
  for (const int bits : {8, 10, 12}) {
    for (const auto& [open_s, close_s] : {std::pair{0.0030, 0.0001}, std::pair{0.0021, 0.0003}}) {
      bench.sensor.bits = bits;
      bench.sensor.seed += 10;
      bench.transmission = straight(open_s, close_s);
      const auto opens = bench.opens();
      const auto closes = bench.closes();
      REQUIRE(opens);
      REQUIRE(closes);
      CAPTURE(bits);
      CHECK(std::abs(opens->value - 1e3 * open_s) < 4.0 * opens->spread);
      CHECK(std::abs(closes->value - 1e3 * close_s) < 4.0 * closes->spread);
      CHECK(opens->spread < 0.06);
      CHECK(closes->spread < 0.03);  // the light has a gap there
    }
  }
}

TEST_CASE("hum that makes each trace another does not move a slow shutter") {
  Bench bench;
  bench.transmission = straight(0.0024, 0.0003);
  bench.sensor.hum = 0.005;
  double worst_ms = 0.0;
  double squares = 0.0;
  for (int n = 0; n < 40; ++n) {
    // Not every third sweep: nothing says how hum and traces fall together.
    bench.sensor.seed = 100 + static_cast<std::uint32_t>(n);
    bench.sensor.hum_hz = 97.0 + 0.17 * n;
    const auto opens = bench.opens();
    REQUIRE(opens);
    worst_ms = std::max(worst_ms, std::abs(opens->value - 2.4));
    squares += std::pow((opens->value - 2.4) / opens->spread, 2) / 40.0;
  }
  CHECK(worst_ms < 0.02);
  CHECK(std::sqrt(squares) < 1.5);
}

TEST_CASE("a dead time before it moves counts, and a slow tail is waited for") {
  Bench bench;
  bench.sensor.noise = 0.001;
  bench.sensor.hum = 0.0;
  bench.transmission = [](double t) { return t < open_told_s + 0.0005 ? 0.0 : t < close_told_s ? 1.0 : 0.0; };
  REQUIRE(bench.opens());
  CHECK(bench.opens()->value == doctest::Approx(0.5).epsilon(0.05));
  // A crystal that relaxes: within 2 % after 3.9 time constants.
  bench.transmission = [](double t) {
    return t < open_told_s ? 0.0 : t > close_told_s ? 0.0 : 1.0 - std::exp(-(t - open_told_s) / 0.001);
  };
  REQUIRE(bench.opens());
  CHECK(bench.opens()->value == doctest::Approx(3.9).epsilon(0.1));
}

TEST_CASE("a shutter that does not close, does not open, or is too slow is refused, and why") {
  Bench bench;
  bench.transmission = straight(0.003, 0.0001);
  bench.leak = 0.4;
  CHECK(bench.opens().fault().code == "measure.shutter");
  CHECK(bench.opens().fault().message.find("closed") != std::string::npos);
  bench.leak = 0.0;
  bench.transmission = [](double t) { return t > open_told_s ? 0.5 : 0.0; };
  CHECK(bench.opens().fault().code == "measure.shutter");
  bench.transmission = [](double t) { return std::clamp((t - open_told_s) / 0.0066, 0.0, 1.0); };
  CHECK(bench.opens().fault().remedy.find("lower sweep frequency") != std::string::npos);
}

TEST_CASE("the other eye's sensor that answers is told from light that leaks") {
  CHECK(own_side(0.5, 0.02, "left shutter"));
  CHECK(own_side(0.01, 0.5, "left shutter").fault().code == "measure.swapped");
  CHECK(own_side(0.5, 0.4, "left shutter").fault().code == "measure.leak");
}

}  // namespace
