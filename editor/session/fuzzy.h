#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace focalstage {

struct FuzzyMatch {
  int score = 0;                   ///< the larger the better
  std::vector<std::size_t> bytes;  ///< where in the text each letter of the query begins
};

/// Whether all letters of `query` stand in `text` in their order, and how well: beginnings of words and runs count
/// most. Letters match in either case, also Latin-1's, Greek and Cyrillic ones; blanks of the query are skipped. An
/// empty query matches everything with 0.
std::optional<FuzzyMatch> fuzzy_match(std::string_view query, std::string_view text);

}  // namespace focalstage
