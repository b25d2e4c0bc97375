#include "editor/pipeline/focal_sweep.h"

#include "editor/pipeline/retina_report.h"

namespace focalstage {

std::vector<double> sharpness_over(const FocalSweep& sweep, std::size_t thing) {
  std::vector<double> sharpness;
  for (const std::vector<ThingLook>& looks : sweep.looks) sharpness.push_back(looks[thing].sharpness);
  return sharpness;
}

Result<FocalSweep> sweep_focus(Retinas& retinas, std::span<const RetinaInput> inputs, const RetinaView& view,
                               const ProjectorFlux& flux, const FocusRange& range, const TakePicture& take,
                               std::stop_token stop) {
  const auto focus = retinas.driven_focus(inputs, view, stop);
  if (!focus) return focus.fault();
  const auto pinhole = retinas.view(inputs, pinhole_of(view), stop);
  if (!pinhole) return pinhole.fault();
  const ThingMap things = things_seen(inputs.front(), view, flux, stop);
  FocalSweep sweep;
  sweep.things = things.things;
  RetinaView at = view;
  for (int i = 0; i < range.count; ++i) {
    at.focus_d = range.at(i);
    const auto picture = retinas.view(inputs, at, stop);
    if (!picture) return picture.fault();
    if (stop.stop_requested()) return Fault{"retina.cancelled", "", "stopped before the sweep was done", ""};
    sweep.focus_d.push_back(at.focus_d);
    sweep.looks.push_back(thing_looks(things, *picture, *pinhole, *focus, inputs.front(), at));
    if (Status taken = take(i, *picture); !taken) return taken.fault();
  }
  for (std::size_t thing = 0; thing < sweep.things.size(); ++thing)
    sweep.peaks.push_back(focus_peak(sweep.focus_d, sharpness_over(sweep, thing)));
  return sweep;
}

}  // namespace focalstage
