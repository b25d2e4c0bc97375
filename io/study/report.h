#pragma once

#include <string>
#include <vector>

#include "core/scene/value.h"
#include "core/study/analysis.h"
#include "core/study/tally.h"
#include "io/study/answers.h"

namespace focalstage {

/// A study's answers and what the paper's statistics make of them.
struct StudyReport {
  Answers answers;
  std::vector<Tally> tallies;
  StudyAnalysis analysis;

  /// Scripted participants answered: no human result, and the report says so first.
  bool scripted() const { return !tallies.empty() && is_scripted(tallies.front().kind); }
};

StudyReport report_of(Answers answers);

/// For people. `plot`: the file of the picture to refer to; empty: none.
std::string report_markdown(const StudyReport& report, const std::string& plot);

/// For programs: docs/formats/study.md. Lengths in metres.
Value report_value(const StudyReport& report);

/// Estimated over actual distance, every answer, the lines of both conditions and the line of no error.
std::string report_svg(const StudyReport& report);

}  // namespace focalstage
