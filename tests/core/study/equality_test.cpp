#include "core/study/equality.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/study/seeded.h"

using namespace focalstage;

namespace {

std::vector<double> levels() {
  std::vector<double> all;
  for (int k = 0; k <= 70; ++k) all.push_back(5.0 + 0.5 * k);
  return all;
}

/// Somebody for whom two things look alike at `point`, with noise, and a hand that slips.
struct Person {
  double point;
  double noise;
  double slips = 0.0;
};

EqualityEstimate asked(const Person& person, int answers, std::uint64_t seed) {
  EqualitySearch search(levels());
  Seeded chance(seed, "answers");
  for (int i = 0; i < answers; ++i) {
    const std::size_t level = search.next();
    bool above = levels()[level] + person.noise * chance.gaussian() > person.point;
    if (chance.share() < person.slips) above = chance.share() < 0.5;
    search.take(level, above);
  }
  return search.estimate();
}

}  // namespace

TEST_CASE("the point is found within what is said of it, whoever answers") {
  for (const Person& person : {Person{15.0, 0.5}, Person{22.3, 1.5}, Person{9.1, 0.2}, Person{31.0, 3.0, 0.04}}) {
    constexpr int people = 100;
    int within_one = 0, within_two = 0;
    double bias = 0.0, uncertainty = 0.0;
    for (int seed = 0; seed < people; ++seed) {
      const EqualityEstimate found = asked(person, 40, static_cast<std::uint64_t>(seed));
      CHECK(found.answers == 40);
      const double off = found.value - person.point;
      within_one += std::abs(off) <= found.uncertainty ? 1 : 0;
      within_two += std::abs(off) <= 2.0 * found.uncertainty ? 1 : 0;
      bias += off / people;
      uncertainty += found.uncertainty / people;
    }
    CAPTURE(person.point);
    CAPTURE(uncertainty);
    CHECK(within_one > people * 58 / 100);  // 68 % are to be expected
    CHECK(within_two > people * 90 / 100);  // 95 %
    CHECK(std::abs(bias) < 0.2 * uncertainty + 0.05);
    CHECK(uncertainty < 0.55 * person.noise + 0.1);  // about 1.4 times what the mean of 40 readings would have
  }
}

TEST_CASE("more answers say more, and the same answers the same") {
  const Person person{18.0, 1.0};
  double few = 0.0, many = 0.0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    few += asked(person, 15, seed).uncertainty;
    many += asked(person, 60, seed).uncertainty;
    CHECK(asked(person, 15, seed).value == asked(person, 15, seed).value);
  }
  CHECK(many < 0.7 * few);
}

TEST_CASE("whoever only says one thing is told that the point lies outside") {
  for (const bool above : {false, true}) {
    EqualitySearch search(levels());
    for (int i = 0; i < 30; ++i) search.take(search.next(), above);
    CHECK_FALSE(search.estimate().inside);
  }
  CHECK_FALSE(EqualitySearch(levels()).estimate().inside);  // nothing is known yet
  CHECK(asked({15.0, 0.5}, 30, 1).inside);
}
