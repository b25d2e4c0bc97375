#include "core/schedule/shutter.h"

#include <algorithm>

#include "core/base/periodic.h"

namespace focalstage {

ShutterPlan plan_shutters(const Glasses& glasses, double period_s, double handover_s) {
  const double opening_s = glasses.shutter_open_ms / 1000.0;
  const double closing_s = glasses.shutter_close_ms / 1000.0;
  const double half_window_s = std::max(opening_s, closing_s) / 2.0;
  const auto told_to_open = [&](double centre_s) { return wrapped_s(centre_s + half_window_s - opening_s, period_s); };
  const auto told_to_close = [&](double centre_s) { return wrapped_s(centre_s - half_window_s, period_s); };

  ShutterPlan plan;
  plan.told.left = {told_to_open(0.0), told_to_close(handover_s)};
  plan.told.right = {told_to_open(handover_s), told_to_close(0.0)};
  plan.clear.left = {half_window_s, handover_s - half_window_s};
  plan.clear.right = {handover_s + half_window_s, period_s - half_window_s};
  return plan;
}

}  // namespace focalstage
