#include "editor/viewer/pattern.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

#include "core/optics/eye.h"
#include "core/stage/stage.h"
#include "editor/pipeline/compile_show.h"
#include "io/project/project_file.h"
#include "io/protocol/show_chunks.h"

namespace focalstage {
namespace {

constexpr double most_uneven = 0.05;  ///< of the distance

template <class Thing>
void keep_still(Thing& thing) {
  thing.placement = Placement{pose_at(thing.placement, 0.0), {}, {}};
}

/// Why a pattern is no good, if it is not.
Status check_findings(const std::vector<Finding>& findings) {
  for (const Finding& finding : findings) {
    const bool hidden = finding.code.starts_with("view.");
    if (finding.severity != Severity::error && !hidden) continue;
    const bool timing = finding.code == "slices.outside-sweep" || finding.code == "schedule.hidden-by-shutter" ||
                        finding.code == "schedule.overlap";
    return Fault{timing ? "viewer.unreachable" : "viewer.refused", finding.where, finding.message,
                 hidden ? "light the surface around the gaze, and see that nothing stands before it"
                        : "focalstage check says more of the project"};
  }
  return {};
}

}  // namespace

double tangent_deg(double deg) { return std::tan(deg * std::numbers::pi / 180.0); }

Result<EyeInRoom> EyeInRoom::of(const Source& source, Side eye) {
  const auto stood = stage(source.project, source.loaded.assets, 0.0);
  if (!stood) return stood.fault();
  if (source.project.projectors.empty()) {
    return Fault{"viewer.refused", "/projectors", "there is no projector to show anything with", "add one"};
  }
  auto room = RayRoom::of(stood->surfaces);
  if (!room) return room.fault();
  EyeInRoom here(*std::move(room));
  const double lens_to_pupil_m = source.project.glasses.lens_to_pupil_mm * 1e-3;
  here.world_from_eye =
      eyes_of(stood->world_from_viewer, stood->interpupillary_m, lens_to_pupil_m)[eye].eye_from_world.inverse();
  here.projector = projector_model(source.project.projectors.front());
  return here;
}

std::optional<double> EyeInRoom::depth_m(const glm::dvec3& from_m, double x, double y) const {
  const auto along = room_.first(world_from_eye.point(from_m), world_from_eye.direction({x, y, -1.0}), 1e-3);
  if (!along) return std::nullopt;
  return *along - from_m.z;
}

Result<double> EyeInRoom::flat_surface_m(double around_deg) const {
  const Fault none{"viewer.surface", "/surfaces", "there is no flat surface before the eye, square to its gaze",
                   "put one there, or turn the viewer to it"};
  const auto middle_m = depth_m({}, 0.0, 0.0);
  if (!middle_m) return none;
  for (int i = 0; i < 16; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 16.0;
    const double size = tangent_deg(around_deg);
    const auto at_m = depth_m({}, size * std::cos(angle), size * std::sin(angle));
    if (!at_m || std::abs(*at_m - *middle_m) > most_uneven * *middle_m) return none;
  }
  return *middle_m;
}

Result<double> EyeInRoom::pixel_m(const glm::dvec3& point_m) const {
  constexpr double step_m = 1e-3;
  const auto here = pixel_of_world(projector, world_from_eye.point(point_m));
  const auto beside = pixel_of_world(projector, world_from_eye.point(point_m + glm::dvec3(step_m, 0.0, 0.0)));
  const double pixels = here && beside ? glm::length(*beside - *here) : 0.0;
  if (!(pixels > 0.0)) {
    return Fault{"viewer.refused", "/projectors/0", "does not reach the surface before the eye",
                 "calibrate the projector, or turn it to the surface"};
  }
  return step_m / pixels;
}

Project bare_room(const Project& from, const std::string& name, std::size_t frames) {
  Project project = from;
  project.name = name;
  project.objects.clear();
  project.lights.clear();
  project.cues.clear();
  project.frames.count = static_cast<int>(frames);
  project.frames.rate_hz = project.sweep.frequency_hz;
  project.slices.samples_per_pixel = 4;
  project.slices.breathing = Breathing::exact;
  project.slices.assignment = Assignment::linear;
  keep_still(project.viewer);
  for (Surface& surface : project.surfaces) {
    keep_still(surface);
    surface.illumination = 0.0;
  }
  for (std::size_t k = 0; k < frames; ++k) {
    project.cues.push_back({level_cue(k), static_cast<double>(k) / project.frames.rate_hz});
  }
  return project;
}

Object slice_object(const std::string& name, MeshShape shape, std::size_t slice) {
  Object object;
  object.name = name;
  object.mesh.shape = std::move(shape);
  object.appearance = UnlitAppearance{};
  object.depth.mode = DepthMode::slice;
  object.depth.index = static_cast<int>(slice);
  return object;
}

std::string level_cue(std::size_t frame) { return "level " + std::to_string(frame); }

Result<Source> pattern_source(const Source& from, Project project, std::vector<AssetFile> files) {
  files.insert(files.end(), from.loaded.files.begin(), from.loaded.files.end());
  std::sort(files.begin(), files.end(), [](const AssetFile& a, const AssetFile& b) { return a.path < b.path; });
  auto assets = assets_from(project, files);
  if (!assets) return assets.fault();
  Source source = from;
  source.loaded = {*std::move(assets), std::move(files)};
  source.text = project_text(project);
  source.project = std::move(project);
  return source;
}

Result<ReadyCondition> make_pattern_show(const Source& pattern, const std::filesystem::path& show,
                                         const FrameProgress& progress, const std::stop_token& stop) {
  CompileJob job;
  job.show = show;
  const auto compiled = compile_show(pattern, job, progress, stop);
  if (!compiled) return compiled.fault();
  if (Status good = check_findings(compiled->findings); !good) return good.fault();
  const auto chunks = ShowChunks::open(show, stop);
  if (!chunks) return chunks.fault();
  ReadyCondition ready{show, chunks->sha256(), pattern.project.viewer.interpupillary_mm, {}};
  for (std::size_t k = 0; k < pattern.project.cues.size(); ++k) {
    ready.targets.push_back({level_cue(k), static_cast<int>(k)});
  }
  return ready;
}

}  // namespace focalstage
