#include "io/study/response_rows.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

#include "core/scene/number_text.h"
#include "io/study/study_file.h"

namespace focalstage {
namespace {

std::string joined(const std::vector<std::string>& cells) {
  std::string row;
  for (const std::string& cell : cells) row += (row.empty() ? "" : ",") + cell;
  return row;
}

std::vector<std::string_view> split(std::string_view row) {
  std::vector<std::string_view> cells;
  for (;;) {
    const std::size_t comma = row.find(',');
    cells.push_back(row.substr(0, comma));
    if (comma == std::string_view::npos) return cells;
    row.remove_prefix(comma + 1);
  }
}

/// Takes a row apart, column by column in the header's order; keeps the first fault.
class RowReader {
 public:
  RowReader(const Study& study, std::string_view header, std::string_view row, std::string source)
      : study_(study), names_(split(header)), cells_(split(row)), source_(std::move(source)) {
    if (cells_.size() == names_.size()) return;
    fault_ = Fault{"study.rows", source_,
                   "has " + std::to_string(cells_.size()) + " columns in place of " + std::to_string(names_.size()),
                   remedy_};
  }

  const std::optional<Fault>& fault() const { return fault_; }

  std::string text() { return std::string(next()); }

  std::string known_text(bool (*known)(const std::string&), const char* what) {
    std::string cell = text();
    if (!known(cell)) fail(what);
    return cell;
  }

  int whole() {
    const std::string_view cell = next();
    int number = 0;
    const auto [end, problem] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
    if (problem != std::errc{} || end != cell.data() + cell.size() || number < 0) fail("is no count");
    return number;
  }

  bool flag() {
    const std::string_view cell = next();
    if (cell != "0" && cell != "1") fail("is neither 0 nor 1");
    return cell == "1";
  }

  double number(bool may_be_empty = false) {
    const std::string_view cell = next();
    if (cell.empty() && may_be_empty) return 0.0;
    double value = 0.0;
    const auto [end, problem] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (problem != std::errc{} || end != cell.data() + cell.size() || !std::isfinite(value) || value < 0.0) {
      fail("is no distance or time");
    }
    return value;
  }

  /// The place in a list of the one with this name.
  template <class Things>
  int named(const Things& things) {
    const std::string_view cell = next();
    const auto found = std::ranges::find_if(things, [&](const auto& thing) { return thing.name == cell; });
    if (found == things.end()) fail("is not of this study");
    return static_cast<int>(found - things.begin());
  }

  void of_this_study() {
    if (next() == study_fingerprint(study_) || fault_) return;
    fault_ = Fault{"study.other", source_, "is of another study than this one",
                   "use another folder for its answers (--out), or the study file that they were given for"};
  }

  void fail(const std::string& what) {
    if (fault_) return;
    const std::size_t column = at_ > 0 ? at_ - 1 : 0;
    fault_ = Fault{"study.rows", source_,
                   std::string(names_[column]) + " \"" + std::string(cells_[column]) + "\" " + what, remedy_};
  }

 private:
  std::string_view next() {
    if (at_ >= cells_.size()) return {};
    return cells_[at_++];
  }

  static constexpr const char* remedy_ = "put the file back as it was written, or move it away";

  const Study& study_;
  std::vector<std::string_view> names_;
  std::vector<std::string_view> cells_;
  std::string source_;
  std::size_t at_ = 0;
  std::optional<Fault> fault_;
};

bool is_kind(const std::string& kind) { return kind == human_kind || is_scripted(kind); }

bool is_sha256(const std::string& text) {
  return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

}  // namespace

std::string row_of(const Study& study, const Response& response) {
  const Condition& condition = study.conditions[static_cast<std::size_t>(response.condition)];
  const StudyTarget& target = study.targets[static_cast<std::size_t>(response.target)];
  return joined({study_fingerprint(study),
                 response.participant,
                 response.kind,
                 std::to_string(response.block),
                 condition.name,
                 std::to_string(response.trial),
                 response.training ? "1" : "0",
                 target.name,
                 std::to_string(response.repetition),
                 number_text(response.actual_m),
                 number_text(response.pointer_start_m),
                 response.answered() ? number_text(response.response_m) : std::string(),
                 response.gave_up ? "1" : "0",
                 response.spoiled,
                 std::to_string(response.sitting),
                 number_text(response.started_s),
                 number_text(response.duration_s),
                 response.show_sha256,
                 number_text(response.interpupillary_mm),
                 response.rig});
}

std::string row_of(const Study& study, const QuestionAnswer& answer) {
  return joined({study_fingerprint(study), answer.participant, answer.kind,
                 study.questions[static_cast<std::size_t>(answer.question)].name, answer.yes ? "yes" : "no"});
}

Result<Response> response_from(const Study& study, std::string_view row, const std::string& source) {
  RowReader reader(study, response_header, row, source);
  Response response;
  reader.of_this_study();
  response.participant = reader.text();
  response.kind = reader.known_text(is_kind, "is no kind of participant");
  response.block = reader.whole();
  response.condition = reader.named(study.conditions);
  response.trial = reader.whole();
  response.training = reader.flag();
  response.target = reader.named(study.targets);
  response.repetition = reader.whole();
  response.actual_m = reader.number();
  response.pointer_start_m = reader.number();
  response.response_m = reader.number(true);
  const bool beyond = response.response_m > study.pointer.to_m;
  if (beyond) reader.fail("lies beyond the pointer's range");
  response.gave_up = reader.flag();
  response.spoiled = reader.text();
  response.sitting = reader.whole();
  response.started_s = reader.number();
  response.duration_s = reader.number();
  response.show_sha256 = reader.known_text(is_sha256, "is no SHA-256");
  response.interpupillary_mm = reader.number();
  response.rig = reader.text();
  if (response.answered() && !(response.response_m >= study.pointer.from_m) && !reader.fault()) {
    return Fault{"study.rows", source, "has an answer that lies outside the pointer's range, or none",
                 "put the file back as it was written, or move it away"};
  }
  if (reader.fault()) return *reader.fault();
  return response;
}

Result<QuestionAnswer> question_answer_from(const Study& study, std::string_view row, const std::string& source) {
  RowReader reader(study, answer_header, row, source);
  QuestionAnswer answer;
  reader.of_this_study();
  answer.participant = reader.text();
  answer.kind = reader.known_text(is_kind, "is no kind of participant");
  answer.question = reader.named(study.questions);
  const std::string said =
      reader.known_text([](const std::string& text) { return text == "yes" || text == "no"; }, "is neither yes nor no");
  answer.yes = said == "yes";
  if (reader.fault()) return *reader.fault();
  return answer;
}

}  // namespace focalstage
