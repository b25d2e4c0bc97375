#include "core/study/cells.h"

#include <algorithm>

namespace focalstage {
namespace {

struct Sum {
  double estimated_m = 0.0;
  int answered = 0;
  int given_up = 0;
};

/// Of one participant: a sum per condition and target.
class Sums {
 public:
  Sums(const Study& study) : study_(study), sums_(study.conditions.size() * study.targets.size()) {}

  Sum& at(int condition, int target) {
    return sums_[static_cast<std::size_t>(condition) * study_.targets.size() + static_cast<std::size_t>(target)];
  }

  bool whole() const {
    return std::ranges::all_of(sums_, [&](const Sum& s) { return s.answered + s.given_up >= study_.repetitions; });
  }

 private:
  const Study& study_;
  std::vector<Sum> sums_;
};

void add_participant(const Study& study, int participant, Sums& sums, CellMeans& cells) {
  if (!sums.whole()) {
    cells.unfinished.push_back(participant);
    return;
  }
  std::vector<CellMean> means;
  const std::size_t empty_before = cells.empty.size();
  for (int condition = 0; condition < static_cast<int>(study.conditions.size()); ++condition) {
    for (int target = 0; target < static_cast<int>(study.targets.size()); ++target) {
      const Sum& sum = sums.at(condition, target);
      if (sum.answered == 0) {
        cells.empty.push_back({participant, condition, target});
        continue;
      }
      const double actual_m = study.targets[static_cast<std::size_t>(target)].actual_m;
      means.push_back({participant, condition, target, actual_m, sum.estimated_m / sum.answered, sum.answered});
    }
  }
  if (cells.empty.size() > empty_before && study.missing == MissingRule::complete_participants) {
    cells.left_out.push_back(participant);
    return;
  }
  cells.used.push_back(participant);
  cells.means.insert(cells.means.end(), means.begin(), means.end());
}

}  // namespace

CellMeans cells_of(const Study& study, const std::vector<Response>& responses) {
  CellMeans cells;
  for (int participant = 0; participant < static_cast<int>(study.participants.size()); ++participant) {
    Sums sums(study);
    bool seen = false;
    for (const Response& response : responses) {
      if (response.participant != study.participants[static_cast<std::size_t>(participant)]) continue;
      seen = true;
      if (!response.counts()) continue;
      Sum& sum = sums.at(response.condition, response.target);
      ++(response.gave_up ? sum.given_up : sum.answered);
      if (!response.gave_up) sum.estimated_m += response.response_m;
    }
    if (seen) add_participant(study, participant, sums, cells);
  }
  return cells;
}

}  // namespace focalstage
