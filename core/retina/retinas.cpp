#include "core/retina/retinas.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace focalstage {

void add_light(const RetinaImage& more, RetinaImage& sum) {
  for (std::size_t i = 0; i < sum.rgb.size(); ++i) sum.rgb[i] += more.rgb[i];
}

void add_light(const DrivenFocus& more, DrivenFocus& sum) {
  for (std::size_t i = 0; i < sum.luminance.size(); ++i) {
    const double a = sum.luminance[i], b = more.luminance[i];
    if (!(b > 0.0)) continue;
    if (!(a > 0.0)) {
      sum.luminance[i] = more.luminance[i];
      sum.vergence_d[i] = more.vergence_d[i];
      sum.spread_d[i] = more.spread_d[i];
      continue;
    }
    const double share = b / (a + b), apart_d = double{more.vergence_d[i]} - sum.vergence_d[i];
    const double own_d = sum.spread_d[i], other_d = more.spread_d[i];
    sum.luminance[i] = static_cast<float>(a + b);
    sum.vergence_d[i] = static_cast<float>(sum.vergence_d[i] + share * apart_d);
    sum.spread_d[i] = static_cast<float>(std::sqrt((1.0 - share) * own_d * own_d + share * other_d * other_d +
                                                   share * (1.0 - share) * apart_d * apart_d));
  }
}

template <class Seen, class Look>
Result<Seen> Retinas::sum(std::span<const RetinaInput> inputs, const Look& look) {
  if (inputs.empty()) return Fault{"retina.input", "", "there is no projector", ""};
  while (retinas_.size() < inputs.size()) retinas_.emplace_back(threads_);
  Result<Seen> all = look(retinas_[0], inputs[0]);
  for (std::size_t i = 1; all && i < inputs.size(); ++i) {
    const Result<Seen> more = look(retinas_[i], inputs[i]);
    if (!more) return more.fault();
    add_light(*more, *all);
  }
  return all;
}

Result<RetinaImage> Retinas::view(std::span<const RetinaInput> inputs, const RetinaView& view, std::stop_token stop) {
  return sum<RetinaImage>(inputs,
                          [&](Retina& retina, const RetinaInput& input) { return retina.view(input, view, stop); });
}

Result<DrivenFocus> Retinas::driven_focus(std::span<const RetinaInput> inputs, const RetinaView& view,
                                          std::stop_token stop) {
  return sum<DrivenFocus>(
      inputs, [&](Retina& retina, const RetinaInput& input) { return retina.driven_focus(input, view, stop); });
}

}  // namespace focalstage
