#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/study/equality.h"
#include "editor/trials/trial_rig.h"
#include "editor/viewer/observer.h"
#include "io/study/row_file.h"

namespace focalstage {

/// A pattern at one level.
struct Stimulus {
  std::size_t show = 0;  ///< of the test's
  ShownTarget target;
};

/// Two things are compared at one level after another, to find the level at which they are equal.
struct TwoChoiceTest {
  std::vector<double> levels;  ///< rising, three at least
  std::vector<ReadyCondition> shows;
  std::vector<Stimulus> stimuli;  ///< of each level
  Choice above = Choice::second;  ///< what is said of a level above that point
};

/// The answers of a test in a file, a row each: a test that was killed goes on where it was.
class ChoiceLog {
 public:
  /// Opens or makes `path` for the answers of `kind` ("human", "scripted") to `test`. Fault "viewer.answers" where it
  /// holds those to another test.
  static Result<ChoiceLog> open(const std::filesystem::path& path, const TwoChoiceTest& test, const std::string& kind);

  struct Row {
    std::size_t level = 0;
    bool above = false;
  };
  const std::filesystem::path& path() const { return path_; }
  const std::vector<Row>& rows() const { return rows_; }
  Status add(const Row& row);

 private:
  ChoiceLog(std::filesystem::path path, RowFile file) : path_(std::move(path)), file_(std::move(file)) {}

  std::filesystem::path path_;
  RowFile file_;
  std::vector<Row> rows_;
};

struct TwoChoiceRun {
  int questions = 40;
  ChoiceLog* log = nullptr;  ///< none: answers are kept nowhere
  std::function<void(int answered, int of)> progress = [](int, int) {};
  std::stop_token stop{};
};

/// Shows level after level and asks; in the end the rig is dark. Nothing: the observer gave up.
Result<std::optional<EqualityEstimate>> run_two_choice(TrialRig& rig, const TwoChoiceTest& test, Observer& observer,
                                                       const TwoChoiceRun& run);

}  // namespace focalstage
