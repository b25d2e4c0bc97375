#include "io/study/answers.h"

#include <algorithm>
#include <set>
#include <system_error>

#include "io/files/files.h"
#include "io/study/study_file.h"

namespace focalstage {
namespace {

namespace fs = std::filesystem;

fs::path response_path(const fs::path& folder, const std::string& participant) {
  return folder / (participant + ".csv");
}

fs::path question_path(const fs::path& folder, const std::string& participant) {
  return folder / (participant + ".answers.csv");
}

/// All rows of a file, each made by `make` and of `participant`.
template <class Row, class Make>
Result<std::vector<Row>> made_of(const RowList& rows, const Study& study, const std::string& participant,
                                 const fs::path& path, Make make) {
  std::vector<Row> made;
  for (std::size_t k = 0; k < rows.lines.size(); ++k) {
    const std::string source = path.string() + ": line " + std::to_string(k + 2);
    const auto row = make(study, rows.lines[k], source);
    if (!row) return row.fault();
    if (row->participant != participant) {
      return Fault{"study.rows", source, "is of participant \"" + row->participant + "\"",
                   "each participant's rows lie in a file of their own name"};
    }
    made.push_back(*row);
  }
  return made;
}

/// The rows against the plan, with the file's line in the fault.
Result<TrialProgress> checked_progress(const Study& study, const std::string& participant,
                                       const std::vector<Response>& responses, const fs::path& path) {
  const auto index = participant_index(study, participant);
  if (!index) return index.fault();
  auto progress = progress_of(study, plan_of(study, *index), responses);
  if (progress) return progress;
  Fault fault = progress.fault();
  const int row = std::stoi(fault.where.substr(fault.where.find(' ') + 1));
  fault.where = path.string() + ": line " + std::to_string(row + 1);
  return fault;
}

Status read_participant(const fs::path& folder, const std::string& participant, Answers& answers) {
  const fs::path path = response_path(folder, participant);
  const auto rows = read_rows(path, response_header);
  if (!rows) return rows.fault();
  const auto responses = made_of<Response>(*rows, answers.study, participant, path, response_from);
  if (!responses) return responses.fault();
  const auto progress = checked_progress(answers.study, participant, *responses, path);
  if (!progress) return progress.fault();
  answers.responses.insert(answers.responses.end(), responses->begin(), responses->end());
  if (rows->torn) answers.notes.push_back(path.filename().string() + ": its last line was cut off and is left out");

  const fs::path asked = question_path(folder, participant);
  std::error_code problem;
  if (!fs::exists(asked, problem)) return {};
  const auto said = read_rows(asked, answer_header);
  if (!said) return said.fault();
  const auto questions = made_of<QuestionAnswer>(*said, answers.study, participant, asked, question_answer_from);
  if (!questions) return questions.fault();
  answers.questions.insert(answers.questions.end(), questions->begin(), questions->end());
  return {};
}

Status check_kinds(const fs::path& folder, const std::vector<Response>& responses) {
  std::set<bool> scripted;
  for (const Response& response : responses) scripted.insert(is_scripted(response.kind));
  if (scripted.size() < 2) return {};
  return Fault{"study.mixed", folder.string(), "holds answers of people beside those of scripted participants",
               "move either kind's files to a folder of their own, with a copy of study.json"};
}

Status check_same_study(const fs::path& file, const Study& study, const Study& kept) {
  const bool begins_so = study.participants.size() >= kept.participants.size() &&
                         std::equal(kept.participants.begin(), kept.participants.end(), study.participants.begin());
  if (study_fingerprint(study) != study_fingerprint(kept)) {
    return Fault{"study.other", file.string(), "is another study than the one to be run",
                 "choose another folder with --out; a study is not changed once somebody has answered"};
  }
  if (begins_so) return {};
  return Fault{"study.other", file.string(), "has other participants at the start of its list",
               "put the list back; new participants go to its end"};
}

Status keep_study(const fs::path& folder, const Study& study) {
  std::error_code problem;
  fs::create_directories(folder, problem);
  if (problem) return Fault{"file.unwritable", folder.string(), problem.message(), "choose another folder with --out"};
  const fs::path file = folder / study_file_name;
  if (fs::exists(file, problem)) {
    const auto kept = load_study(file);
    if (!kept) return kept.fault();
    if (Status same = check_same_study(file, study, kept->study); !same) return same;
    if (kept->study == study) return {};
  }
  return write_file_atomically(file, study_text(study));
}

/// Files of rows that belong to nobody of the study.
void note_strays(const fs::path& folder, Answers& answers) {
  std::set<std::string> strays;
  std::error_code problem;
  for (fs::directory_iterator at(folder, problem), end; !problem && at != end; at.increment(problem)) {
    if (at->path().extension() != ".csv") continue;
    const std::string stem = at->path().stem().stem().string();
    if (!participant_index(answers.study, stem)) strays.insert(at->path().filename().string());
  }
  for (const std::string& name : strays) {
    answers.notes.push_back(name + ": is of no participant of this study and is left out");
  }
}

}  // namespace

Result<Answers> load_answers(const fs::path& folder) {
  auto study = load_study(folder / study_file_name);
  if (!study) return study.fault();
  Answers answers;
  answers.study = std::move(study->study);
  for (const std::string& participant : answers.study.participants) {
    std::error_code problem;
    if (!fs::exists(response_path(folder, participant), problem)) continue;
    if (Status read = read_participant(folder, participant, answers); !read) return read.fault();
  }
  if (Status kinds = check_kinds(folder, answers.responses); !kinds) return kinds.fault();
  note_strays(folder, answers);
  return answers;
}

Result<AnswerLog> AnswerLog::open(const fs::path& folder, const Study& study, const std::string& participant) {
  if (const auto index = participant_index(study, participant); !index) return index.fault();
  if (Status kept = keep_study(folder, study); !kept) return kept.fault();
  auto responses = RowFile::open(response_path(folder, participant), response_header);
  if (!responses) return responses.fault();
  auto questions = RowFile::open(question_path(folder, participant), answer_header);
  if (!questions) return questions.fault();
  AnswerLog log(study, std::move(*responses), std::move(*questions));
  auto rows = made_of<Response>(log.response_file_.rows(), study, participant, response_path(folder, participant),
                                response_from);
  if (!rows) return rows.fault();
  const auto progress = checked_progress(study, participant, *rows, response_path(folder, participant));
  if (!progress) return progress.fault();
  auto said = made_of<QuestionAnswer>(log.question_file_.rows(), study, participant, question_path(folder, participant),
                                      question_answer_from);
  if (!said) return said.fault();
  log.responses_ = std::move(*rows);
  log.questions_ = std::move(*said);
  return log;
}

Status AnswerLog::add(const Response& response) {
  if (Status written = response_file_.append(row_of(study_, response)); !written) return written;
  responses_.push_back(response);
  return {};
}

Status AnswerLog::add(const QuestionAnswer& answer) {
  if (Status written = question_file_.append(row_of(study_, answer)); !written) return written;
  questions_.push_back(answer);
  return {};
}

}  // namespace focalstage
