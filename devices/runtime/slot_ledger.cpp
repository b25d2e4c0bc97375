#include "devices/runtime/slot_ledger.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace focalstage {

void SlotLedger::ask(AskedSweep sweep) { asked_.push_back(std::move(sweep)); }

void SlotLedger::deliver(std::vector<DeliveredExposure> exposures) {
  std::ranges::move(exposures, std::back_inserter(delivered_));
}

void SlotLedger::begin_show(const std::shared_ptr<const LoadedShow>& show) {
  show_ = show;
  seen_whole_ = false;
  slots_.clear();
  for (const Slot& slot : show->header.schedule.slots) {
    SlotReport report;
    report.slot = static_cast<int>(slots_.size());
    report.image = slot.image;
    report.eye = static_cast<int>(index_of(slot.eye));
    report.asked_power_d = report.delivered_power_d = slot.power_d;
    report.asked_smear_d = slot.smear_d;
    report.asked_s = report.delivered_s = slot.start_s;
    report.unmeasured = !sees_light_;
    slots_.push_back(report);
  }
}

const DeliveredExposure* SlotLedger::find(double start_s, double within_s) const {
  const DeliveredExposure* nearest = nullptr;
  for (const DeliveredExposure& light : delivered_) {
    const double off_s = std::abs(light.start_s - start_s);
    if (off_s < within_s && (nearest == nullptr || off_s < std::abs(nearest->start_s - start_s))) nearest = &light;
  }
  return nearest;
}

/// False where the light did not come.
bool SlotLedger::settle(const AskedSweep& sweep, std::size_t slot) {
  const Slot& asked = show_->header.schedule.slots[slot];
  SlotReport& report = slots_[slot];
  const bool first = report.exposures + report.missed == 0;
  // Exposures never overlap, so the nearest within one exposure is the one, or a neighbour in its place.
  const DeliveredExposure* light = sweep.lit ? find(sweep.start_s + asked.start_s, 0.9 * asked.exposure_s) : nullptr;
  if (light == nullptr) {
    ++report.missed;
    report.delivered = false;
    return false;
  }
  ++report.exposures;
  const Side other = asked.eye == Side::left ? Side::right : Side::left;
  const double power_d = light->power_d[asked.eye];
  const double at_s = light->start_s - sweep.start_s;
  const bool right = same_picture(light->picture, sweep.pictures[slot]);
  const bool open = light->transmission[asked.eye].least >= 1.0 - tolerance_.transmission;
  const bool closed = light->transmission[other].most <= tolerance_.transmission;
  const bool exact = std::abs(power_d - asked.power_d) <= tolerance_.power_d &&
                     std::abs(at_s - asked.start_s) <= tolerance_.time_s &&
                     std::abs(light->duration_s - asked.exposure_s) <= tolerance_.time_s;

  const auto keep_worst = [](double& worst, double value, double wanted) {
    if (std::abs(value - wanted) > std::abs(worst - wanted)) worst = value;
  };
  keep_worst(report.delivered_power_d, power_d, asked.power_d);
  report.delivered_smear_d = std::max(report.delivered_smear_d, light->smear_d[asked.eye]);
  keep_worst(report.delivered_s, at_s, asked.start_s);
  report.right_image = right && (first || report.right_image);
  report.own_shutter_open = open && (first || report.own_shutter_open);
  report.other_shutter_closed = closed && (first || report.other_shutter_closed);
  report.delivered = exact && right && open && closed && (first || report.delivered);
  return true;
}

void SlotLedger::settle(const AskedSweep& sweep) {
  if (sweep.show != show_) begin_show(sweep.show);
  if (!sweep.lit && !sweep.missed) return;
  std::uint64_t missed = 0;
  if (sees_light_) {
    for (std::size_t slot = 0; slot < slots_.size(); ++slot) missed += settle(sweep, slot) ? 0 : 1;
  } else if (sweep.missed) {
    missed = slots_.size();
  }
  missed_ += missed;
  if (missed > 0) ++faulty_;
  if (missed == 0 && !std::exchange(seen_whole_, true) && show_->on_light) {
    show_->on_light(sweep.number, sweep.start_s);
  }
}

void SlotLedger::settle_until(double time_s) {
  while (!asked_.empty() && asked_.front().start_s + asked_.front().show->plan.period_s <= time_s) {
    const AskedSweep& sweep = asked_.front();
    settle(sweep);
    std::erase_if(delivered_, [&](const DeliveredExposure& light) { return light.start_s < sweep.start_s; });
    asked_.pop_front();
  }
}

void SlotLedger::call_off_after(double time_s) {
  while (!asked_.empty() && asked_.back().start_s + asked_.back().show->plan.period_s > time_s) asked_.pop_back();
}

void SlotLedger::forget() {
  show_.reset();
  asked_.clear();
  delivered_.clear();
  slots_.clear();
}

std::uint64_t SlotLedger::take_faulty_sweeps() { return std::exchange(faulty_, 0); }

}  // namespace focalstage
