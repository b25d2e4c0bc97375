#include <cstdio>

#include "core/calibrate/verify_picture.h"
#include "core/reference/ray_room.h"
#include "editor/cli/calibrate_actions.h"
#include "editor/cli/calibrate_output.h"
#include "editor/cli/output.h"
#include "editor/pipeline/source.h"
#include "io/image/png.h"

namespace focalstage {

ExitStatus run_calibrate_verify(const CalibrateOptions& options) {
  const auto loaded = load_project(options.project);
  if (!loaded) return report(loaded.fault());
  const auto projector = projector_meant(*loaded, options.projector);
  if (!projector) return report(projector.fault());
  const auto source = open_project(options.project);
  if (!source) return report(source.fault());
  const auto room = stage(source->project, source->loaded.assets, 0.0);
  if (!room) return report(room.fault());
  const auto rays = RayRoom::of(room->surfaces);
  if (!rays) return report(rays.fault());
  const ProjectorModel model = projector_model(*projector);
  const glm::dvec3& from_m = model.world_from_projector.position_m;
  const auto edges = model_edges(room->surfaces, from_m);
  const auto seen = [&](const glm::dvec3& at_m) { return rays->free(from_m, at_m); };
  const auto codes = verify_picture(model, edges, seen);
  if (Status written = write_png(options.output, model.width_px, model.height_px, 1, codes); !written) {
    return report(written.fault());
  }
  std::printf("%s: %zu edges of %zu surfaces, as %s shows them\n", options.output.c_str(), edges.size(),
              room->surfaces.size(), projector->name.c_str());
  return ExitStatus::done;
}

}  // namespace focalstage
