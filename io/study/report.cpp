#include "io/study/report.h"

namespace focalstage {

StudyReport report_of(Answers answers) {
  StudyReport report;
  report.tallies = tally_of(answers.study, answers.responses);
  report.analysis = analyse(answers.study, answers.responses);
  report.answers = std::move(answers);
  return report;
}

}  // namespace focalstage
