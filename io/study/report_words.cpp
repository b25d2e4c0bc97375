#include "io/study/report_words.h"

#include "core/base/number_words.h"

namespace focalstage {

std::string mm_text(double length_m, int decimals) { return fixed_text(length_m * 1e3, decimals); }

std::string p_text(double p) { return p < 0.001 ? "p < 0.001" : "p = " + fixed_text(p, p < 0.1 ? 3 : 2); }

std::string test_text(const std::optional<FTest>& test) {
  if (!test) return "no test: the answers do not vary beyond it, or are too few";
  return "F(" + fixed_text(test->df1, 0) + "," + fixed_text(test->df2, 0) + ") = " + fixed_text(test->f, 3) + ", " +
         p_text(test->p);
}

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '&':
        safe += "&amp;";
        break;
      case '|':
        safe += "&#124;";
        break;
      case '\n':
      case '\r':
        safe += ' ';
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

const std::string& condition_name(const Study& study, int condition) {
  return study.conditions[static_cast<std::size_t>(condition)].name;
}

const std::string& target_name(const Study& study, int target) {
  return study.targets[static_cast<std::size_t>(target)].name;
}

const std::string& participant_name(const Study& study, int participant) {
  return study.participants[static_cast<std::size_t>(participant)];
}

}  // namespace focalstage
