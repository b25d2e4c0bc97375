#include "io/study/report.h"

namespace focalstage {

Report report_of(Answers answers) {
  Report report;
  report.tallies = tally_of(answers.study, answers.responses);
  report.analysis = analyse(answers.study, answers.responses);
  report.answers = std::move(answers);
  return report;
}

}  // namespace focalstage
