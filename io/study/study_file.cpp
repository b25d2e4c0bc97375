#include "io/study/study_file.h"

#include "io/files/files.h"
#include "io/json/checked_value.h"
#include "io/json/json.h"
#include "io/project/validate.h"

namespace focalstage {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t size_limit = 1u << 20;
constexpr int version = 1;

Condition condition_from(const Value& value) {
  const bool conventional = text_of(value, "variant") == name_of(ConditionVariant::conventional);
  return {text_of(value, "name"), text_of(value, "project"), text_of(value, "show"),
          conventional ? ConditionVariant::conventional : ConditionVariant::multifocal};
}

StudyTarget target_from(const Value& value) {
  return {text_of(value, "name"), text_of(value, "cue"), static_cast<int>(number_of(value, "frame", -1)),
          number_of(value, "actual_m", 0.0)};
}

/// Of a value that the schema took: what is there has the right type.
Study study_from(const Value& value) {
  Study study;
  study.name = text_of(value, "name");
  study.seed = static_cast<std::uint64_t>(number_of(value, "seed", 0.0));
  study.participants = texts_of(value, "participants");
  study.conditions = list_of<Condition>(value, "conditions", condition_from);
  study.targets = list_of<StudyTarget>(value, "targets", target_from);
  study.repetitions = static_cast<int>(number_of(value, "repetitions", 0.0));
  study.training_trials = static_cast<int>(number_of(value, "training_trials", study.training_trials));
  const Value& pointer = *value.find("pointer");
  study.pointer = {number_of(pointer, "from_m", 0.0), number_of(pointer, "to_m", 0.0),
                   number_of(pointer, "step_m", study.pointer.step_m)};
  const bool complete = text_of(value, "missing") == name_of(MissingRule::complete_participants);
  study.missing = complete ? MissingRule::complete_participants : MissingRule::answered_repetitions;
  study.questions = list_of<StudyQuestion>(value, "questions", [](const Value& item) {
    return StudyQuestion{text_of(item, "name"), text_of(item, "text")};
  });
  return study;
}

Value value_from(const Condition& condition) {
  Value value;
  value.set("name", condition.name);
  if (!condition.show.empty()) {
    value.set("show", condition.show);
    return value;
  }
  value.set("project", condition.project);
  value.set("variant", name_of(condition.variant));
  return value;
}

Value value_from(const StudyTarget& target) {
  Value value;
  value.set("name", target.name);
  target.cue.empty() ? value.set("frame", target.frame) : value.set("cue", target.cue);
  value.set("actual_m", target.actual_m);
  return value;
}

Value value_from(const StudyQuestion& question) {
  Value value;
  value.set("name", question.name);
  value.set("text", question.text);
  return value;
}

template <class Items>
Value list_from(const Items& items) {
  Value::Array list;
  for (const auto& item : items) list.push_back(value_from(item));
  return Value(std::move(list));
}

Value value_from(const Study& study) {
  Value value;
  value.set("focalstage_study", version);
  value.set("name", study.name);
  value.set("seed", static_cast<double>(study.seed));
  value.set("participants", Value::Array(study.participants.begin(), study.participants.end()));
  value.set("conditions", list_from(study.conditions));
  value.set("targets", list_from(study.targets));
  value.set("repetitions", study.repetitions);
  value.set("training_trials", study.training_trials);
  Value pointer;
  pointer.set("from_m", study.pointer.from_m);
  pointer.set("to_m", study.pointer.to_m);
  pointer.set("step_m", study.pointer.step_m);
  value.set("pointer", std::move(pointer));
  value.set("missing", name_of(study.missing));
  value.set("questions", list_from(study.questions));
  return value;
}

}  // namespace

Result<Study> parse_study(std::string_view text, const std::string& source) {
  const auto value = parse_checked(text, source, size_limit, study_schema(), "study");
  if (!value) return value.fault();
  Study study = study_from(*value);
  if (const Status usable = check(study); !usable) return in_file(usable.fault(), source);
  return study;
}

Result<LoadedStudy> load_study(const fs::path& path) {
  std::error_code problem;
  const fs::path file = fs::is_directory(path, problem) ? path / study_file_name : path;
  const auto bytes = read_file(file, size_limit);
  if (!bytes) return bytes.fault();
  const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  auto study = parse_study(text, file.string());
  if (!study) return study.fault();
  return LoadedStudy{std::move(*study), file};
}

std::string study_text(const Study& study) { return write_json(value_from(study)) + "\n"; }

std::string study_fingerprint(const Study& study) {
  Study shared = study;
  shared.participants.clear();
  return sha256_hex(write_json(value_from(shared), -1)).substr(0, 16);
}

}  // namespace focalstage
