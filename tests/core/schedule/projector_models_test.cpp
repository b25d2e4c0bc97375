#include "core/schedule/projector_models.h"

#include <doctest/doctest.h>

#include "tests/support/models.h"

using namespace focalstage;

TEST_CASE("the dynaflash shows 2840 images a second at 8 bits and 22,000 at 1") {
  const ProjectorModelData* model = find_model(support::models(), "dynaflash");
  REQUIRE(model);
  CHECK(model->clock == ProjectorClock::triggered);
  CHECK(model->layout == PixelLayout::square);
  CHECK(*fastest_rate(*model, 1, ColorMode::gray) == 22000.0);
  CHECK(*fastest_rate(*model, 8, ColorMode::gray) == 2840.0);
  CHECK(*fastest_rate(*model, 4, ColorMode::gray) == 2840.0);  // no depth between is given
  CHECK(*fastest_rate(*model, 8, ColorMode::rgb) == doctest::Approx(946.67).epsilon(1e-5));
  CHECK_FALSE(fastest_rate(*model, 9, ColorMode::gray));
  CHECK(*least_exposure_ms(*model, 8, ColorMode::gray) == doctest::Approx(1.0 / 2.84));
  CHECK_FALSE(model->planes_per_frame);
}

TEST_CASE("the LightCrafter 4500 has a shortest exposure per depth") {
  const ProjectorModelData* model = find_model(support::models(), "lightcrafter4500");
  REQUIRE(model);
  CHECK(model->clock == ProjectorClock::master);
  CHECK(model->layout == PixelLayout::diamond);
  CHECK(*fastest_rate(*model, 1, ColorMode::gray) == doctest::Approx(1.0 / 235e-6));
  CHECK(*fastest_rate(*model, 8, ColorMode::gray) == doctest::Approx(120.0).epsilon(1e-4));
  CHECK(*least_exposure_ms(*model, 1, ColorMode::gray) == 0.235);
  CHECK(*least_exposure_ms(*model, 1, ColorMode::rgb) == doctest::Approx(0.705));  // TI: 705 us for a colour triple
  CHECK(*model->planes_per_frame == 24);
}

TEST_CASE("rates fall with depth in every model") {
  for (const ProjectorModelData& model : support::models()) {
    for (std::size_t i = 1; i < model.rates.size(); ++i) {
      CHECK(model.rates[i].bits > model.rates[i - 1].bits);
      CHECK(model.rates[i].frames_per_second < model.rates[i - 1].frames_per_second);
    }
  }
}

TEST_CASE("an unknown model is unknown") { CHECK(find_model(support::models(), "abacus") == nullptr); }
