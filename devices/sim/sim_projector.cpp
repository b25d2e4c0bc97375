#include "devices/sim/sim_projector.h"

#include <utility>

namespace focalstage {

void SimProjector::sync_edge() {
  if (std::exchange(early_, false)) return;
  if (begun_ && !sets_.empty()) sets_.pop_front();
  begun_ = true;
  shown_ = 0;
}

Picture SimProjector::next_picture() {
  // A trigger may lead its sweep's sync edge by the projector's latency: the sweep before it is then shown to the end.
  if (begun_ && !early_ && sets_.size() > 1 && shown_ >= sets_.front().size()) {
    sets_.pop_front();
    shown_ = 0;
    early_ = true;
  }
  if (!begun_ && !sets_.empty()) begun_ = early_ = true;
  if (sets_.empty() || shown_ >= sets_.front().size()) return {};
  return sets_.front()[shown_++];
}

std::optional<StartedExposure> SimProjector::trigger(double time_s) {
  constexpr double rounding_s = 1e-9;
  const bool lost = drop_at_ == triggers_++;
  if (lost || time_s - last_trigger_s_ < settings_.least_frame_s - rounding_s) return std::nullopt;
  last_trigger_s_ = time_s;
  return StartedExposure{next_picture(), time_s + settings_.latency_s, exposure_s_};
}

void SimProjector::forget_posted() {
  sets_.clear();
  shown_ = 0;
  begun_ = early_ = false;
}

}  // namespace focalstage
