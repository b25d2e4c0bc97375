#include "devices/lightcrafter/identify.h"

#include <atomic>
#include <utility>

#include "devices/lightcrafter/control.h"

namespace focalstage {

Status identify_lightcrafter(const std::string& serial, const OpenReports& open_reports) {
  auto reports = open_reports(serial, "");
  if (!reports) return reports.fault();
  const std::atomic<bool> hurry = false;
  lightcrafter::Control control(std::move(*reports), LightCrafterSettings{}, hurry);
  Status done = control.make_ready();
  if (done) done = control.blink();
  if (control.dark() || !done) return done;
  return Fault{"projector.silent", "LightCrafter 4500", "it did not say that it is dark again", "switch it off"};
}

}  // namespace focalstage
