#include "core/study/study.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace focalstage {
namespace {

constexpr double same_distance_m = 1e-9;

Fault wrong(std::string where, std::string message, std::string remedy) {
  return {"study.invalid", std::move(where), std::move(message), std::move(remedy)};
}

std::string item(const std::string& list, std::size_t index) { return "/" + list + "/" + std::to_string(index); }

/// Names become columns of tables and, those of participants, names of files.
bool is_plain(const std::string& name) {
  const auto plain = [](char c) { return c >= ' ' && c != ',' && c != '"' && c != '|' && c != 0x7f; };
  return !name.empty() && name.size() <= 64 && std::ranges::all_of(name, plain);
}

bool is_file_name(const std::string& name) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  };
  return !name.empty() && name.size() <= 32 && std::ranges::all_of(name, plain);
}

template <class Things, class NameOf>
Status check_names(const Things& things, const std::string& list, NameOf name_of_thing) {
  std::set<std::string> met;
  for (std::size_t i = 0; i < things.size(); ++i) {
    const std::string& name = name_of_thing(things[i]);
    if (!is_plain(name)) {
      return wrong(item(list, i), "the name \"" + name + "\" cannot stand in a table",
                   "use 1 to 64 signs without commas, quotes and bars");
    }
    if (!met.insert(name).second) return wrong(item(list, i), "\"" + name + "\" is there twice", "rename one of them");
  }
  return {};
}

Status check_participants(const Study& study) {
  for (std::size_t i = 0; i < study.participants.size(); ++i) {
    if (is_file_name(study.participants[i])) continue;
    return wrong(item("participants", i), "\"" + study.participants[i] + "\" cannot name a file of answers",
                 "use 1 to 32 letters, digits, hyphens and underscores");
  }
  return check_names(study.participants, "participants",
                     [](const std::string& id) -> const std::string& { return id; });
}

Status check_conditions(const Study& study) {
  if (study.conditions.size() < 2) {
    return wrong("/conditions", "there is nothing to compare", "name at least two conditions");
  }
  for (std::size_t i = 0; i < study.conditions.size(); ++i) {
    const Condition& condition = study.conditions[i];
    if (condition.project.empty() != condition.show.empty()) continue;
    return wrong(item("conditions", i), "names both a project and a show, or neither", "name one of them");
  }
  return check_names(study.conditions, "conditions", [](const Condition& c) -> const std::string& { return c.name; });
}

Status check_target(const Study& study, std::size_t i) {
  const StudyTarget& target = study.targets[i];
  const StudyPointer& pointer = study.pointer;
  if (target.cue.empty() == (target.frame < 0)) {
    return wrong(item("targets", i), "names both a cue and a frame, or neither", "name one of them");
  }
  if (!(target.actual_m >= pointer.from_m && target.actual_m <= pointer.to_m)) {
    return wrong(item("targets", i) + "/actual_m", "the pointer cannot be moved there",
                 "widen /pointer/from_m and /pointer/to_m, or correct the distance (in metres)");
  }
  for (std::size_t j = 0; j < i; ++j) {
    if (std::abs(study.targets[j].actual_m - target.actual_m) > same_distance_m) continue;
    return wrong(item("targets", i) + "/actual_m", "stands where \"" + study.targets[j].name + "\" does",
                 "leave one of them out; more trials of one target are /repetitions");
  }
  return {};
}

Status check_pointer(const StudyPointer& pointer) {
  if (!(std::isfinite(pointer.from_m) && std::isfinite(pointer.to_m) && pointer.from_m >= 0.0 &&
        pointer.to_m > pointer.from_m)) {
    return wrong("/pointer", "from_m must be 0 or more and to_m beyond it", "name the ends of the slider in metres");
  }
  if (!(pointer.step_m > 0.0 && pointer.step_m <= pointer.to_m - pointer.from_m)) {
    return wrong("/pointer/step_m", "must be above 0 and within the range", "0.001 is a millimetre");
  }
  return {};
}

}  // namespace

const char* name_of(ConditionVariant variant) {
  return variant == ConditionVariant::conventional ? "conventional" : "multifocal";
}

const char* name_of(MissingRule rule) {
  return rule == MissingRule::complete_participants ? "complete-participants" : "answered-repetitions";
}

Status check(const Study& study) {
  if (study.participants.empty()) return wrong("/participants", "there is nobody", "name at least one participant");
  if (Status named = check_participants(study); !named) return named;
  if (Status named = check_conditions(study); !named) return named;
  if (Status usable = check_pointer(study.pointer); !usable) return usable;
  if (study.targets.size() < 2) return wrong("/targets", "one distance makes no line", "name at least two targets");
  for (std::size_t i = 0; i < study.targets.size(); ++i) {
    if (Status usable = check_target(study, i); !usable) return usable;
  }
  const auto target_name = [](const StudyTarget& t) -> const std::string& { return t.name; };
  if (Status named = check_names(study.targets, "targets", target_name); !named) return named;
  if (study.repetitions < 1) return wrong("/repetitions", "must be 1 or more", "the paper's study has 4");
  if (study.training_trials < 0) return wrong("/training_trials", "must be 0 or more", "the paper's study has 1");
  return check_names(study.questions, "questions", [](const StudyQuestion& q) -> const std::string& { return q.name; });
}

Result<int> participant_index(const Study& study, const std::string& participant) {
  const auto found = std::ranges::find(study.participants, participant);
  if (found != study.participants.end()) return static_cast<int>(found - study.participants.begin());
  std::string known;
  for (const std::string& id : study.participants) known += (known.empty() ? "" : ", ") + id;
  return Fault{"study.participant", "/participants", "has no \"" + participant + "\"",
               "choose from " + known + ", or add the name at the end of the list"};
}

}  // namespace focalstage
