#include "editor/pipeline/retina_report.h"

#include <algorithm>
#include <numeric>

namespace focalstage {
namespace {

double sum_of(const RetinaImage& image) { return std::accumulate(image.rgb.begin(), image.rgb.end(), 0.0); }

/// The part of the light that was meant for the other eye. A Retina of its own, because the one at work keeps maps of
/// all exposures.
Result<double> leaked_share(const RetinaInput& input, const RetinaView& view, double all, const std::stop_token& stop) {
  RetinaInput others = input;
  std::erase_if(others.exposures, [](const RetinaExposure& exposure) { return exposure.own; });
  if (others.exposures.empty() || !(all > 0.0)) return 0.0;
  const auto image = Retina().view(others, view, stop);
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

Result<RetinaReport> report_on(Retina& retina, const RetinaInput& input, const RetinaView& view,
                               const ProjectorFlux& flux, std::stop_token stop) {
  auto picture = retina.view(input, view, stop);
  if (!picture) return picture.fault();
  const auto focus = retina.driven_focus(input, view, stop);
  if (!focus) return focus.fault();
  const auto pinhole = retina.view(input, pinhole_of(view), stop);
  if (!pinhole) return pinhole.fault();
  const auto leaked = leaked_share(input, view, sum_of(*picture), stop);
  if (!leaked) return leaked.fault();

  RetinaReport report;
  report.picture = *std::move(picture);
  report.things = things_seen(input, view, flux, stop);
  if (stop.stop_requested()) return Fault{"retina.cancelled", "", "stopped before the report was done", ""};
  report.looks = thing_looks(report.things, report.picture, *pinhole, *focus, input, view);
  report.conflicts = thing_conflicts(report.things, *focus);
  report.conflict_d = conflict_map(report.things, *focus);
  report.leaked = *leaked;
  return report;
}

}  // namespace focalstage
