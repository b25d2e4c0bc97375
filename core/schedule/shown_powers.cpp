#include "core/schedule/shown_powers.h"

#include "core/optics/image_plan.h"
#include "core/schedule/slots.h"

namespace focalstage {

ShownPowers::ShownPowers(const Project& project, const std::vector<double>& powers_d)
    : period_s_(1.0 / project.sweep.frequency_hz), at_(powers_d.size()) {
  std::vector<ImageSpec> images;
  for (const double power_d : powers_d) images.push_back({ImageEye::both, ImageKind::content, power_d, 0});
  for (const Slot& slot : time_slots(project, images).slots) {
    At& at = at_[static_cast<std::size_t>(slot.image)];
    at.start_s[slot.eye] = slot.start_s;
    at.smear_d = std::max(at.smear_d, slot.smear_d);
    ++at.eyes;
  }
}

}  // namespace focalstage
