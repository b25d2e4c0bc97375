#include "core/stripes/pattern_set.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>

using namespace focalstage;

namespace {

const PatternSet small{100, 60, 2.2, 4, 16, 8};

}  // namespace

TEST_CASE("white, black, both axes' codes with inverses, sines, and white and black again") {
  const auto patterns = patterns_of(small);
  CHECK(code_bits(small, PatternAxis::columns) == 5);  // 25 stripes
  CHECK(code_bits(small, PatternAxis::rows) == 4);     // 15
  CHECK(patterns.size() == 2 + 10 + 8 + 8 + 8 + 2);
  CHECK(name_of(patterns.front()) == "white");
  CHECK(name_of(patterns[2]) == "columns-code-0");
  CHECK(name_of(patterns[3]) == "columns-code-0-inverse");
  CHECK(name_of(patterns[12]) == "columns-sine-0");
  CHECK(name_of(patterns[20]) == "rows-code-0");
  CHECK(name_of(patterns.back()) == "black-again");
  std::set<std::string> names;
  for (const Pattern& pattern : patterns) names.insert(name_of(pattern));
  CHECK(names.size() == patterns.size());
}

TEST_CASE("the bits of every column and row are a Gray code of its stripe: one bit changes from stripe to stripe") {
  for (const int stripe_px : {1, 3, 4}) {
    const PatternSet set{100, 60, 1.0, stripe_px, 16, 8};
    for (const PatternAxis axis : {PatternAxis::columns, PatternAxis::rows}) {
      const bool columns = axis == PatternAxis::columns;
      const int length = columns ? 100 : 60;
      std::vector<int> words(static_cast<std::size_t>(length), 0);
      for (int bit = 0; bit < code_bits(set, axis); ++bit) {
        const auto code = picture_of(set, {PatternKind::code, axis, bit, false});
        const auto inverse = picture_of(set, {PatternKind::code, axis, bit, true});
        for (int i = 0; i < length; ++i) {
          // Along a line across the picture, off its rim.
          const auto at = static_cast<std::size_t>(columns ? 37 * 100 + i : i * 100 + 53);
          CHECK(code[at] + inverse[at] == 255);
          words[static_cast<std::size_t>(i)] = 2 * words[static_cast<std::size_t>(i)] + (code[at] == 255 ? 1 : 0);
        }
      }
      std::set<int> seen{words[0]};
      for (int i = 1; i < length; ++i) {
        const int changed = words[static_cast<std::size_t>(i)] ^ words[static_cast<std::size_t>(i - 1)];
        if (i % stripe_px != 0) {
          CHECK(changed == 0);
        } else {
          CHECK(changed != 0);
          CHECK((changed & (changed - 1)) == 0);
          CHECK(seen.insert(words[static_cast<std::size_t>(i)]).second);
        }
      }
    }
  }
}

TEST_CASE("the sine's light is a sine once the projector has made light of it") {
  for (int step = 0; step < 8; ++step) {
    const auto codes = picture_of(small, {PatternKind::sine, PatternAxis::rows, step, false});
    for (int y = 0; y < 60; ++y) {
      const double light = std::pow(codes[static_cast<std::size_t>(y) * 100 + 20] / 255.0, 2.2);
      const double angle = 2.0 * std::numbers::pi * ((y + 0.5) / 16.0 - step / 8.0);
      CHECK(light == doctest::Approx(0.5 + 0.4 * std::cos(angle)).epsilon(0.012));
    }
  }
}

TEST_CASE("a set that cannot be is refused") {
  CHECK(check_set(small).ok());
  const auto refused = [](PatternSet set) {
    return !check_set(set).ok() && check_set(set).fault().code == "stripes.set";
  };
  CHECK(refused({8, 60, 1.0, 4, 16, 8}));
  CHECK(refused({100, 20000, 1.0, 4, 16, 8}));
  CHECK(refused({100, 60, 0.0, 4, 16, 8}));
  CHECK(refused({100, 60, std::numeric_limits<double>::quiet_NaN(), 4, 16, 8}));
  CHECK(refused({100, 60, 1.0, 0, 16, 8}));
  CHECK(refused({100, 60, 1.0, 8, 16, 8}));
  CHECK(refused({100, 60, 1.0, 4, 16, 3}));
}
