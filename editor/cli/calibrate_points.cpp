#include "editor/cli/calibrate_actions.h"
#include "editor/cli/calibrate_output.h"
#include "editor/cli/output.h"
#include "editor/cli/points_file.h"

namespace focalstage {
namespace {

LensFreedom freedom_of(const std::string& solve) {
  return solve == "pose" ? LensFreedom::fixed : solve == "focal" ? LensFreedom::focal : LensFreedom::centre;
}

}  // namespace

ExitStatus run_calibrate_points(const CalibrateOptions& options) {
  const auto loaded = load_project(options.project);
  if (!loaded) return report(loaded.fault());
  const auto file = read_points(options.input);
  if (!file) return report(file.fault());
  const auto projector = projector_meant(*loaded, options.projector.empty() ? file->projector : options.projector);
  if (!projector) return report(projector.fault());
  const auto calibration = calibrate_by_points(projector_model(*projector), file->points, freedom_of(options.solve));
  if (!calibration) {
    Fault fault = calibration.fault();
    fault.where = options.input + ": " + fault.where;
    return report(fault);
  }
  return finish_calibration(options, *loaded, *projector, *calibration, Value(Value::Object{}));
}

}  // namespace focalstage
