#include "core/study/tally.h"

#include <algorithm>

namespace focalstage {

std::vector<Tally> tally_of(const Study& study, const std::vector<Response>& responses) {
  const auto trials = study.conditions.size() * study.targets.size() * static_cast<std::size_t>(study.repetitions);
  std::vector<Tally> tallies;
  for (const std::string& participant : study.participants) {
    Tally tally{participant, "", 0, 0, 0, static_cast<int>(trials), 0};
    for (const Response& response : responses) {
      if (response.participant != participant) continue;
      tally.kind = response.kind;
      tally.sittings = std::max(tally.sittings, response.sitting);
      if (response.training) continue;
      if (!response.spoiled.empty()) {
        ++tally.spoiled;
      } else {
        ++(response.gave_up ? tally.given_up : tally.answered);
      }
    }
    if (!tally.kind.empty()) tallies.push_back(std::move(tally));
  }
  return tallies;
}

}  // namespace focalstage
