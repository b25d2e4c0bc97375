#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/study/response.h"
#include "core/study/study.h"

namespace focalstage {

/// The first line of a file of responses, and of one of answers to the study's questions.
inline constexpr std::string_view response_header =
    "study,participant,kind,block,condition,trial,training,target,repetition,actual_m,pointer_start_m,response_m,"
    "gave_up,spoiled,sitting,started_s,duration_s,show_sha256,interpupillary_mm,rig";
inline constexpr std::string_view answer_header = "study,participant,kind,question,answer";

/// What a participant said to a question.
struct QuestionAnswer {
  std::string participant;
  std::string kind = human_kind;
  int question = 0;  ///< of the study's
  bool yes = false;

  bool operator==(const QuestionAnswer&) const = default;
};

/// A row without its line end. Numbers as the shortest text that reads back the same; a response that was not given
/// is empty.
std::string row_of(const Study& study, const Response& response);
std::string row_of(const Study& study, const QuestionAnswer& answer);

/// Faults "study.rows" (damaged) and "study.other" (another study's) say which column; `source` is "file: line 3".
Result<Response> response_from(const Study& study, std::string_view row, const std::string& source);
Result<QuestionAnswer> question_answer_from(const Study& study, std::string_view row, const std::string& source);

}  // namespace focalstage
