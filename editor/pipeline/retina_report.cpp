#include "editor/pipeline/retina_report.h"

#include <algorithm>
#include <numeric>

namespace focalstage {
namespace {

double sum_of(const RetinaImage& image) { return std::accumulate(image.rgb.begin(), image.rgb.end(), 0.0); }

/// The part of the light that was meant for the other eye. A Retina of its own, because the one at work keeps maps of
/// all exposures.
Result<double> leaked_share(std::span<const RetinaInput> inputs, const RetinaView& view, double all,
                            const std::stop_token& stop) {
  std::vector<RetinaInput> others(inputs.begin(), inputs.end());
  bool any = false;
  for (RetinaInput& other : others) {
    std::erase_if(other.exposures, [](const RetinaExposure& exposure) { return exposure.own; });
    any = any || !other.exposures.empty();
  }
  if (!any || !(all > 0.0)) return 0.0;
  const auto image = Retinas().view(others, view, stop);
  if (!image) return image.fault();
  return sum_of(*image) / all;
}

}  // namespace

RetinaView pinhole_of(const RetinaView& view) {
  RetinaView sharp = view;
  sharp.pupil_m = 0.0;
  sharp.diffraction = sharp.chromatic = false;
  return sharp;
}

Result<RetinaReport> report_on(Retinas& retinas, std::span<const RetinaInput> inputs, const RetinaView& view,
                               const ProjectorFlux& flux, std::stop_token stop) {
  auto picture = retinas.view(inputs, view, stop);
  if (!picture) return picture.fault();
  const auto focus = retinas.driven_focus(inputs, view, stop);
  if (!focus) return focus.fault();
  const auto pinhole = retinas.view(inputs, pinhole_of(view), stop);
  if (!pinhole) return pinhole.fault();
  const auto leaked = leaked_share(inputs, view, sum_of(*picture), stop);
  if (!leaked) return leaked.fault();

  RetinaReport report;
  report.picture = *std::move(picture);
  report.things = things_seen(inputs.front(), view, flux, stop);
  if (stop.stop_requested()) return Fault{"retina.cancelled", "", "stopped before the report was done", ""};
  report.looks = thing_looks(report.things, report.picture, *pinhole, *focus, inputs.front(), view);
  report.conflicts = thing_conflicts(report.things, *focus);
  report.conflict_d = conflict_map(report.things, *focus);
  report.leaked = *leaked;
  return report;
}

}  // namespace focalstage
