#include "core/study/scripted.h"

#include <algorithm>

#include "core/study/seeded.h"

namespace focalstage {
namespace {

constexpr double noise_m = 0.010;
constexpr double bias_m = 0.025;
constexpr int gives_up_every = 7;

bool is_biased_under(const Study& study, int condition) {
  const Condition& asked = study.conditions[static_cast<std::size_t>(condition)];
  return asked.project.empty() ? condition > 0 : asked.variant == ConditionVariant::conventional;
}

}  // namespace

std::vector<std::string> ScriptedParticipant::names() { return {"exact", "noisy", "biased", "gives-up"}; }

Result<ScriptedParticipant> ScriptedParticipant::named(const std::string& name) {
  if (name == "exact") return ScriptedParticipant(name, 0.0, 0.0, 0);
  if (name == "noisy") return ScriptedParticipant(name, noise_m, 0.0, 0);
  if (name == "biased") return ScriptedParticipant(name, noise_m, bias_m, 0);
  if (name == "gives-up") return ScriptedParticipant(name, noise_m, 0.0, gives_up_every);
  std::string known;
  for (const std::string& each : names()) known += (known.empty() ? "" : ", ") + each;
  return Fault{"study.scripted", name, "there is no scripted participant of that name", "choose from " + known};
}

std::optional<double> ScriptedParticipant::answer(const Study& study, const std::string& participant,
                                                  const TrialBlock& block, const Trial& trial) const {
  if (gives_up_every_ > 0 && trial.number % gives_up_every_ == 0) return std::nullopt;
  const std::string& condition = study.conditions[static_cast<std::size_t>(block.condition)].name;
  Seeded chance(study.seed, "answer " + participant + " " + condition + " " + std::to_string(trial.number));
  double answer_m = study.targets[static_cast<std::size_t>(trial.target)].actual_m;
  if (noise_m_ > 0.0) answer_m += noise_m_ * chance.gaussian();
  if (is_biased_under(study, block.condition)) answer_m += bias_m_;
  return std::clamp(answer_m, study.pointer.from_m, study.pointer.to_m);
}

}  // namespace focalstage
