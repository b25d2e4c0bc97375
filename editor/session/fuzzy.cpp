#include "editor/session/fuzzy.h"

#include <algorithm>
#include <string>

namespace focalstage {
namespace {

struct Letter {
  char32_t code = 0;  ///< in lower case
  std::size_t byte = 0;
  bool begins = false;  ///< a word, by what stands before it
};

/// The scripts whose capitals stand at a fixed distance from their small letters.
char32_t lower(char32_t code) {
  if (code >= U'A' && code <= U'Z') return code + 32;
  if (code >= 0xC0 && code <= 0xDE && code != 0xD7) return code + 32;
  if (code >= 0x391 && code <= 0x3A9) return code + 32;
  if (code >= 0x410 && code <= 0x42F) return code + 32;
  if (code >= 0x400 && code <= 0x40F) return code + 80;
  return code;
}

bool separates(char32_t code) { return code == U' ' || code == U'-' || code == U'_' || code == U'.' || code == U'/'; }

/// The letters of UTF-8 text; a byte that is none stands for itself.
std::vector<Letter> letters_of(std::string_view text) {
  std::vector<Letter> letters;
  bool begins = true;
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const std::size_t length = byte < 0x80 ? 1 : byte < 0xC0 ? 1 : byte < 0xE0 ? 2 : byte < 0xF0 ? 3 : 4;
    char32_t code = length == 1 ? byte : byte & (0x7Fu >> length);
    for (std::size_t k = 1; k < length && i + k < text.size(); ++k) {
      code = (code << 6) | (static_cast<unsigned char>(text[i + k]) & 0x3Fu);
    }
    letters.push_back({lower(code), i, begins});
    begins = separates(code);
    i += length;
  }
  return letters;
}

constexpr int first_letter = 12;  ///< of the whole text
constexpr int first_of_word = 8;
constexpr int in_a_run = 8;
constexpr int anywhere = 1;
constexpr int none = -1000000;

int worth(const Letter& letter, bool follows) {
  int points = anywhere;
  if (letter.begins) points += letter.byte == 0 ? first_letter : first_of_word;
  if (follows) points += in_a_run;
  return points;
}

}  // namespace

std::optional<FuzzyMatch> fuzzy_match(std::string_view query, std::string_view text) {
  std::vector<Letter> wanted = letters_of(query);
  std::erase_if(wanted, [](const Letter& letter) { return letter.code == U' '; });
  if (wanted.empty()) return FuzzyMatch{};
  const std::vector<Letter> letters = letters_of(text);
  const std::size_t n = letters.size(), m = wanted.size();
  if (m > n) return std::nullopt;
  // best[q * n + i]: of the first q + 1 letters of the query with the last of them on letter i.
  std::vector<int> best(m * n, none);
  std::vector<std::size_t> from(m * n, 0);
  for (std::size_t q = 0; q < m; ++q) {
    int before = none;  // the best of the query's letters before q on letters before i
    std::size_t before_at = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if (wanted[q].code == letters[i].code) {
        if (q == 0) {
          best[i] = worth(letters[i], false);
        } else {
          const int run = i > 0 ? best[(q - 1) * n + i - 1] + worth(letters[i], true) : none;
          const int jump = before + worth(letters[i], false);
          best[q * n + i] = std::max(run, jump);
          from[q * n + i] = run >= jump ? i - 1 : before_at;
        }
      }
      if (q > 0 && best[(q - 1) * n + i] > before) {
        before = best[(q - 1) * n + i];
        before_at = i;
      }
    }
  }
  const auto last = best.end() - static_cast<std::ptrdiff_t>(n);
  const auto top = std::max_element(last, best.end());
  if (*top <= 0) return std::nullopt;
  FuzzyMatch match{*top * 4 - static_cast<int>(std::min<std::size_t>(n, 100)), std::vector<std::size_t>(m)};
  auto at = static_cast<std::size_t>(top - last);
  for (std::size_t q = m; q-- > 0; at = from[q * n + at]) match.bytes[q] = letters[at].byte;
  return match;
}

}  // namespace focalstage
