#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "a_study.h"
#include "core/study/analysis.h"

using namespace focalstage;
using doctest::Approx;

namespace {

// NIST StRD, "Norris": calibration of ozone monitors, with certified values. y, x.
constexpr double norris[36][2] = {
    {0.1, 0.2},     {338.8, 337.4}, {118.1, 118.2}, {888.0, 884.6}, {9.2, 10.1},    {228.1, 226.5},
    {668.5, 666.3}, {998.5, 996.3}, {449.1, 448.6}, {778.9, 777.0}, {559.2, 558.2}, {0.3, 0.4},
    {0.1, 0.6},     {778.1, 775.5}, {668.8, 666.9}, {339.3, 338.0}, {448.9, 447.5}, {10.8, 11.6},
    {557.7, 556.0}, {228.3, 228.1}, {998.0, 995.8}, {888.8, 887.6}, {119.6, 120.2}, {0.3, 0.3},
    {0.6, 0.3},     {557.6, 556.8}, {339.3, 339.1}, {888.0, 887.2}, {998.5, 999.0}, {778.9, 779.0},
    {10.2, 11.1},   {117.6, 118.3}, {228.9, 229.2}, {668.4, 669.1}, {449.2, 448.9}, {0.2, 0.5}};

// Motor Trend 1974 (R's mtcars): miles per gallon, weight, manual gear.
constexpr double cars[32][3] = {
    {21.0, 2.620, 1}, {21.0, 2.875, 1}, {22.8, 2.320, 1}, {21.4, 3.215, 0}, {18.7, 3.440, 0}, {18.1, 3.460, 0},
    {14.3, 3.570, 0}, {24.4, 3.190, 0}, {22.8, 3.150, 0}, {19.2, 3.440, 0}, {17.8, 3.440, 0}, {16.4, 4.070, 0},
    {17.3, 3.730, 0}, {15.2, 3.780, 0}, {10.4, 5.250, 0}, {10.4, 5.424, 0}, {14.7, 5.345, 0}, {32.4, 2.200, 1},
    {30.4, 1.615, 1}, {33.9, 1.835, 1}, {21.5, 2.465, 0}, {15.5, 3.520, 0}, {15.2, 3.435, 0}, {13.3, 3.840, 0},
    {19.2, 3.845, 0}, {27.3, 1.935, 1}, {26.0, 2.140, 1}, {30.4, 1.513, 1}, {15.8, 3.170, 1}, {19.7, 2.770, 1},
    {15.0, 3.570, 1}, {21.4, 2.780, 1}};

// Crampton 1947 (R's ToothGrowth): orange juice and ascorbic acid, three doses, ten animals each.
constexpr double teeth[2][3][10] = {{{15.2, 21.5, 17.6, 9.7, 14.5, 10.0, 8.2, 9.4, 16.5, 9.7},
                                     {19.7, 23.3, 23.6, 26.4, 20.0, 25.2, 25.8, 21.2, 14.5, 27.3},
                                     {25.5, 26.4, 22.4, 24.5, 24.8, 30.9, 26.4, 27.3, 29.4, 23.0}},
                                    {{4.2, 11.5, 7.3, 5.8, 6.4, 10.0, 11.2, 11.2, 5.2, 7.0},
                                     {16.5, 16.5, 15.2, 17.3, 22.5, 17.3, 13.6, 14.5, 18.8, 15.5},
                                     {23.6, 18.5, 33.9, 25.5, 26.4, 32.5, 26.7, 21.5, 23.3, 29.5}}};

CellMeans teeth_cells() {
  CellMeans cells;
  for (int condition = 0; condition < 2; ++condition) {
    for (int target = 0; target < 3; ++target) {
      for (int animal = 0; animal < 10; ++animal) {
        const double actual_m = 10.0 * target;
        cells.means.push_back({animal, condition, target, actual_m, actual_m + teeth[condition][target][animal], 1});
      }
    }
  }
  return cells;
}

Study study_with(int conditions, int targets) {
  Study study = paper_study();
  study.conditions.resize(static_cast<std::size_t>(conditions), study.conditions[1]);
  study.targets.resize(static_cast<std::size_t>(targets));
  return study;
}

/// Every trial of every participant, answered by `answer_m(participant, condition, target, repetition)`.
template <class TrialAnswer>
std::vector<Response> responses_of(const Study& study, TrialAnswer answer_m) {
  std::vector<Response> responses;
  for (int p = 0; p < static_cast<int>(study.participants.size()); ++p) {
    for (int c = 0; c < static_cast<int>(study.conditions.size()); ++c) {
      for (int t = 0; t < static_cast<int>(study.targets.size()); ++t) {
        for (int r = 1; r <= study.repetitions; ++r) {
          Response response;
          response.participant = study.participants[static_cast<std::size_t>(p)];
          response.condition = c;
          response.target = t;
          response.repetition = r;
          response.response_m = answer_m(p, c, t, r);
          responses.push_back(response);
        }
      }
    }
  }
  return responses;
}

}  // namespace

TEST_CASE("least squares: the certified values of NIST's Norris") {
  std::vector<double> y;
  std::vector<double> x;
  for (const auto& row : norris) {
    y.push_back(row[0]);
    x.push_back(row[1]);
  }
  const auto fit = least_squares({std::vector<double>(36, 1.0), x}, y);
  REQUIRE(fit);
  CHECK(fit->coefficients[0] == Approx(-0.262323073774029).epsilon(1e-11));
  CHECK(fit->coefficients[1] == Approx(1.00211681802045).epsilon(1e-13));
  CHECK(std::sqrt(fit->residual_ss / fit->residual_df) == Approx(0.884796396144373).epsilon(1e-11));
  CHECK(fit->residual_df == 34.0);
}

TEST_CASE("least squares refuse columns that are sums of others, and more columns than rows") {
  const std::vector<double> one(4, 1.0);
  const std::vector<double> y{1, 2, 4, 8};
  CHECK_FALSE(least_squares({one, {1, 2, 3, 4}, {2, 3, 4, 5}}, y));
  CHECK_FALSE(least_squares({one, {0, 0, 0, 0}}, y));
  CHECK_FALSE(least_squares({{1.0}, {2.0}}, {1.0}));
  CHECK(least_squares({}, y)->residual_ss == Approx(85.0));
}

TEST_CASE("slopes and intercepts: the cars of 1974, as R's lm(mpg ~ wt * am) and lm(mpg ~ wt + am) have them") {
  CellMeans cells;
  for (int k = 0; k < 32; ++k) {
    cells.means.push_back({k, static_cast<int>(cars[k][2]), k, cars[k][1], cars[k][0], 1});
  }
  const auto regression = regression_of(study_with(2, 2), cells);
  REQUIRE(regression);
  CHECK(regression->lines[0].intercept_m == Approx(31.4161).epsilon(1e-5));
  CHECK(regression->lines[0].slope == Approx(-3.7859).epsilon(1e-5));
  CHECK(regression->lines[1].intercept_m == Approx(46.2945).epsilon(1e-5));
  CHECK(regression->lines[1].slope == Approx(-9.0843).epsilon(1e-5));
  REQUIRE(regression->slopes);
  CHECK(regression->slopes->df1 == 1.0);
  CHECK(regression->slopes->df2 == 28.0);
  CHECK(std::sqrt(regression->slopes->f) == Approx(3.667).epsilon(2e-4));
  CHECK(regression->slopes->p == Approx(0.00102).epsilon(0.005));
  REQUIRE(regression->intercepts);
  CHECK(regression->intercepts->df2 == 29.0);
  CHECK(std::sqrt(regression->intercepts->f) == Approx(0.015).epsilon(0.05));
  CHECK(regression->intercepts->p == Approx(0.988).epsilon(0.001));
  CHECK(regression->common_slope == Approx(-5.35281).epsilon(1e-5));
  CHECK(regression->parallel_m[1] - regression->parallel_m[0] == Approx(-0.02362).epsilon(1e-3));
}

TEST_CASE("analysis of variance: Crampton's teeth, as R's aov and TukeyHSD have them") {
  const auto anova = anova_of(study_with(2, 3), teeth_cells());
  REQUIRE(anova);
  REQUIRE(anova->condition);
  CHECK(anova->condition->f == Approx(15.572).epsilon(1e-4));
  CHECK(anova->condition->ss == Approx(205.35).epsilon(1e-4));
  CHECK(anova->condition->p == Approx(0.0002312).epsilon(1e-3));
  CHECK(anova->target->f == Approx(92.000).epsilon(1e-4));
  CHECK(anova->target->ss == Approx(2426.43).epsilon(1e-5));
  CHECK(anova->interaction->f == Approx(4.107).epsilon(1e-4));
  CHECK(anova->interaction->p == Approx(0.02186).epsilon(1e-3));
  CHECK(anova->residual_df == 54.0);
  CHECK(anova->residual_ss == Approx(712.11).epsilon(1e-4));
  REQUIRE(anova->pairs.size() == 1);
  CHECK(anova->pairs[0].difference_m == Approx(3.7).epsilon(1e-4));
  CHECK(anova->pairs[0].p == Approx(0.0002312).epsilon(1e-3));
  // Of two conditions, Tukey's q is |t| times the root of 2, and its p that of t: here that of the main effect.
  CHECK(anova->pairs[0].t * anova->pairs[0].t == Approx(anova->condition->f).epsilon(1e-10));
  CHECK(anova->pairs[0].p == Approx(anova->condition->p).epsilon(1e-9));
}

TEST_CASE("more conditions: Holm's correction raises p and keeps its order") {
  CellMeans cells = teeth_cells();
  for (int target = 0; target < 3; ++target) {
    for (int animal = 0; animal < 10; ++animal) {
      cells.means.push_back({animal, 2, target, 10.0 * target, 10.0 * target + teeth[0][target][animal] + 0.5, 1});
    }
  }
  const auto anova = anova_of(study_with(3, 3), cells);
  REQUIRE(anova);
  REQUIRE(anova->pairs.size() == 3);
  const double p01 =
      f_test({{}, anova->pairs[0].t * anova->pairs[0].t + 1.0, 2.0}, {{}, 1.0, 1.0}, {{}, 81.0, 81.0})->p;
  const double p02 = anova->pairs[1].p;
  const double p12 = anova->pairs[2].p;
  CHECK(p12 <= anova->pairs[0].p);
  CHECK(anova->pairs[0].p <= p02);
  CHECK(anova->pairs[0].p == Approx(2.0 * p01).epsilon(1e-9));
}

TEST_CASE("the paper's degrees of freedom: 1,96 and 1,97; 1,90, 4,90 and 4,90") {
  const Study study = paper_study();
  const auto responses = responses_of(study, [&](int p, int c, int t, int r) {
    const double wobble = std::sin(1.0 + 7 * p + 3 * c + 11 * t + 5 * r);
    return study.targets[static_cast<std::size_t>(t)].actual_m + 0.02 * c + 0.01 * wobble;
  });
  CHECK(responses.size() == 400);
  const StudyAnalysis analysis = analyse(study, responses);
  CHECK(analysis.cells.means.size() == 100);
  REQUIRE(analysis.regression);
  CHECK(analysis.regression->slopes->df1 == 1.0);
  CHECK(analysis.regression->slopes->df2 == 96.0);
  CHECK(analysis.regression->intercepts->df1 == 1.0);
  CHECK(analysis.regression->intercepts->df2 == 97.0);
  REQUIRE(analysis.anova);
  CHECK(analysis.anova->condition->df1 == 1.0);
  CHECK(analysis.anova->condition->df2 == 90.0);
  CHECK(analysis.anova->target->df1 == 4.0);
  CHECK(analysis.anova->interaction->df1 == 4.0);
  CHECK(analysis.anova->interaction->df2 == 90.0);
  REQUIRE(analysis.within.size() == 1);
  CHECK(analysis.within[0].df == 9.0);
  CHECK(analysis.within[0].difference_m == Approx(-0.02).epsilon(0.3));
  CHECK(analysis.within[0].low_m < analysis.within[0].difference_m);
}

TEST_CASE("within participants: a difference that wobbles by known amounts") {
  Study study = paper_study();
  study.participants = {"a", "b", "c"};
  const double add_m[3] = {0.010, 0.020, 0.030};
  const auto responses = responses_of(study, [&](int p, int c, int t, int) {
    return study.targets[static_cast<std::size_t>(t)].actual_m + (c == 1 ? add_m[p] : 0.0);
  });
  const StudyAnalysis analysis = analyse(study, responses);
  REQUIRE(analysis.within.size() == 1);
  // Mean -20 mm, standard deviation 10 mm, so t = -20 / (10 / sqrt 3); 4.302653 is t(0.975; 2).
  CHECK(analysis.within[0].t == Approx(-2.0 * std::sqrt(3.0)));
  CHECK(analysis.within[0].low_m == Approx(-0.020 - 4.302653 * 0.010 / std::sqrt(3.0)).epsilon(1e-6));
  CHECK(analysis.within[0].p == Approx(0.07418).epsilon(1e-3));
}

TEST_CASE("answers without any variation: lines, but no tests") {
  const Study study = paper_study();
  const auto exact =
      responses_of(study, [&](int, int, int t, int) { return study.targets[static_cast<std::size_t>(t)].actual_m; });
  const StudyAnalysis analysis = analyse(study, exact);
  REQUIRE(analysis.regression);
  CHECK(analysis.regression->lines[0].slope == Approx(1.0));
  CHECK(analysis.regression->lines[0].intercept_m == Approx(0.0));
  CHECK_FALSE(analysis.regression->slopes);
  CHECK_FALSE(analysis.regression->intercepts);
  REQUIRE(analysis.anova);
  CHECK_FALSE(analysis.anova->condition);
  CHECK(analysis.anova->pairs.empty());
  CHECK(analysis.within.empty());
}

TEST_CASE("no answers, or one participant's: nothing is invented") {
  const Study study = paper_study();
  const StudyAnalysis none = analyse(study, {});
  CHECK_FALSE(none.regression);
  CHECK_FALSE(none.anova);
  CHECK(none.by_condition[0].error.count == 0);
  Study alone = study;
  alone.participants = {"P01"};
  const auto one =
      responses_of(alone, [](int, int c, int t, int r) { return 0.3 + 0.05 * t + 0.01 * c + 0.002 * r * t; });
  const StudyAnalysis analysis = analyse(alone, one);
  CHECK(analysis.regression);
  CHECK_FALSE(analysis.anova);  // one mean per cell leaves no residual
}

TEST_CASE("what was given up: means of the rest, or the participant left out, but never silently") {
  Study study = paper_study();
  const double actual_m = study.targets[4].actual_m;
  auto responses = responses_of(study, [&](int p, int, int t, int r) {
    return study.targets[static_cast<std::size_t>(t)].actual_m + 0.001 * r + 0.001 * std::sin(p + 3 * t);
  });
  for (Response& response : responses) {
    const bool once = response.participant == "P02" && response.condition == 0 && response.target == 4;
    const bool wholly = response.participant == "P03" && response.condition == 1 && response.target == 2;
    response.gave_up = (once && response.repetition == 4) || wholly;
  }
  CellMeans cells = cells_of(study, responses);
  CHECK(cells.means.size() == 99);
  REQUIRE(cells.empty.size() == 1);
  CHECK(cells.empty[0].participant == 2);
  CHECK(cells.left_out.empty());
  for (const CellMean& mean : cells.means) {
    if (mean.participant != 1 || mean.condition != 0 || mean.target != 4) continue;
    CHECK(mean.answered == 3);
    CHECK(mean.estimated_m == Approx(actual_m + 0.002 + 0.001 * std::sin(1 + 12)));
  }
  const auto anova = anova_of(study, cells);
  REQUIRE(anova);
  CHECK(anova->residual_df == 89.0);

  study.missing = MissingRule::complete_participants;
  cells = cells_of(study, responses);
  CHECK(cells.means.size() == 90);
  CHECK(cells.left_out == std::vector<int>{2});
}

TEST_CASE("who has not finished is left out; training and spoiled trials are no data") {
  const Study study = paper_study();
  auto responses = responses_of(study, [](int p, int, int, int r) { return 0.4 + 0.01 * p + 0.001 * r; });
  std::erase_if(responses, [](const Response& r) { return r.participant == "P10" && r.repetition == 4; });
  Response training = responses[0];
  training.training = true;
  training.response_m = 99.0;
  Response spoiled = responses[0];
  spoiled.spoiled = "rig.unreachable";
  spoiled.response_m = 99.0;
  responses.push_back(training);
  responses.push_back(spoiled);
  const CellMeans cells = cells_of(study, responses);
  CHECK(cells.unfinished == std::vector<int>{9});
  CHECK(cells.used.size() == 9);
  CHECK(cells.means[0].estimated_m == Approx(0.4025));
}

TEST_CASE("a condition without any answer for a target: no analysis of variance") {
  const Study study = paper_study();
  auto responses =
      responses_of(study, [](int p, int c, int t, int r) { return 0.3 + 0.01 * p + 0.02 * c + 0.04 * t + 0.001 * r; });
  for (Response& response : responses) response.gave_up = response.condition == 1 && response.target == 0;
  const StudyAnalysis analysis = analyse(study, responses);
  CHECK(analysis.cells.empty.size() == 10);
  CHECK_FALSE(analysis.anova);
  CHECK(analysis.regression);
}
