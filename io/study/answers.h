#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/study/progress.h"
#include "io/study/response_rows.h"
#include "io/study/row_file.h"

namespace focalstage {

/// Everything that was answered in one folder: beside its study.json, PARTICIPANT.csv and PARTICIPANT.answers.csv.
struct Answers {
  Study study;
  std::vector<Response> responses;  ///< participant by participant, each in order
  std::vector<QuestionAnswer> questions;
  std::vector<std::string> notes;  ///< torn lines that were left out
};

/// Reads a folder of answers and holds each participant's rows against the plan. Nothing is changed. Faults: those of
/// studies and rows, with file and line; "study.mixed" where scripted participants lie beside people.
Result<Answers> load_answers(const std::filesystem::path& folder);

/// One participant's files, open to be added to.
class AnswerLog {
 public:
  /// Makes the folder and, the first time, keeps the study in it. A folder of another study is a fault "study.other";
  /// so is one whose participants are not the first ones of this study.
  static Result<AnswerLog> open(const std::filesystem::path& folder, const Study& study,
                                const std::string& participant);

  const std::vector<Response>& responses() const { return responses_; }
  const std::vector<QuestionAnswer>& questions() const { return questions_; }
  bool was_torn() const { return response_file_.rows().torn || question_file_.rows().torn; }

  Status add(const Response& response);
  Status add(const QuestionAnswer& answer);

 private:
  AnswerLog(Study study, RowFile responses, RowFile questions)
      : study_(std::move(study)), response_file_(std::move(responses)), question_file_(std::move(questions)) {}

  Study study_;
  RowFile response_file_;
  RowFile question_file_;
  std::vector<Response> responses_;
  std::vector<QuestionAnswer> questions_;
};

}  // namespace focalstage
