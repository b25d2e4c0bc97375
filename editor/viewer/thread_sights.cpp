#include "editor/viewer/thread_sights.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>

#include "core/optics/eye_rotation.h"
#include "core/stage/stage.h"

namespace focalstage {
namespace {

constexpr double nearest_mm = 20.0;  ///< of an eye to the middle: interpupillary distances of 40 to 84 mm
constexpr double farthest_mm = 42.0;
constexpr double step_mm = 0.5;
constexpr double least_beyond = 1.2;  ///< surface over thread: nearer to each other they tell nothing
constexpr double line_deg = 0.15;
constexpr double line_px = 3.0;
constexpr double high_deg = 2.0;    ///< of the line, below the gaze, and of the light above it
constexpr double middle_deg = 1.3;  ///< of both
constexpr double margin_m = 0.015;  ///< of the light beyond the outermost lines
constexpr double ground_light = 0.5;
constexpr double picture_deg = 16.0;

/// Where the way from an eye through the thread meets the surface, in the viewer's axes.
Result<glm::dvec3> behind_thread(const EyeInRoom& room, double eye_x_m, double nominal_x_m, double thread_m) {
  const double slope = -eye_x_m / (thread_m + pupil_to_centre_m);
  const glm::dvec3 eye_m{eye_x_m - nominal_x_m, 0.0, pupil_to_centre_m};  // the room's axes begin at the nominal pupil
  const auto depth_m = room.depth_m(eye_m, slope, 0.0);
  if (!depth_m) {
    return Fault{"viewer.surface", "/surfaces", "there is no surface behind the thread", "put one there"};
  }
  if (*depth_m < least_beyond * thread_m) {
    return Fault{"viewer.thread", "--thread-m", "the thread does not hang between the eyes and the surface",
                 "hang it about half way"};
  }
  return glm::dvec3{eye_x_m + slope * (*depth_m + pupil_to_centre_m), 0.0, -*depth_m};
}

/// A sheet on the surface, square to the gaze; its middle in the viewer's axes.
Object sheet(const std::string& name, const glm::dvec2& size_m) { return slice_object(name, PlaneMesh{size_m}, 0); }

}  // namespace

Result<ThreadSights> thread_sights(const Source& from, Side side, double thread_m) {
  const auto room = EyeInRoom::of(from, side);
  if (!room) return room.fault();
  ThreadSights sights{from, {}, side, thread_m, 0.0};
  const double sign = side == Side::left ? -1.0 : 1.0;
  for (double mm = nearest_mm; mm < farthest_mm + step_mm / 2.0; mm += step_mm) sights.eye_x_mm.push_back(sign * mm);
  std::sort(sights.eye_x_mm.begin(), sights.eye_x_mm.end());

  const double nominal_x_m = sign * from.project.viewer.interpupillary_mm * 0.5e-3;
  const Rigid world_from_viewer = pose_at(from.project.viewer.placement, 0.0);
  std::vector<glm::dvec3> lines_m;
  for (const double x_mm : sights.eye_x_mm) {
    const auto line_m = behind_thread(*room, x_mm * 1e-3, nominal_x_m, thread_m);
    if (!line_m) return line_m.fault();
    lines_m.push_back(*line_m);
  }
  const glm::dvec3 middle_m = (lines_m.front() + lines_m.back()) / 2.0;
  sights.surface_m = -middle_m.z;
  const auto pixel_m = room->pixel_m(middle_m - glm::dvec3(nominal_x_m, 0.0, 0.0));
  if (!pixel_m) return pixel_m.fault();

  Project project = bare_room(from.project, "Interpupillary distance", lines_m.size());
  project.slices.powers_d = {0.0};
  project.slices.samples_per_pixel = 16;  // a line is placed by its edges' gray
  const double high_m = sights.surface_m * tangent_deg(high_deg);
  const double off_m = sights.surface_m * tangent_deg(middle_deg);
  Object line = sheet("line", {std::max(sights.surface_m * tangent_deg(line_deg), line_px * *pixel_m), high_m});
  for (std::size_t k = 0; k < lines_m.size(); ++k) {
    const glm::dvec3 place_m = world_from_viewer.point(lines_m[k] - glm::dvec3(0.0, off_m, 0.0));
    line.placement.keys.push_back({project.cues[k].time_s, {place_m, world_from_viewer.rotation}});
  }
  Object ground = sheet("ground", {std::abs(lines_m.back().x - lines_m.front().x) + 2.0 * margin_m, high_m});
  ground.appearance = UnlitAppearance{glm::dvec3(ground_light)};
  ground.placement.pose = {world_from_viewer.point(middle_m + glm::dvec3(0.0, off_m, 0.0)), world_from_viewer.rotation};
  project.objects = {ground, line};
  auto source = pattern_source(from, std::move(project), {});
  if (!source) return source.fault();
  sights.source = *std::move(source);
  return sights;
}

Result<TwoChoiceTest> thread_test(const ThreadSights& sights, const std::filesystem::path& show,
                                  const FrameProgress& progress, const std::stop_token& stop) {
  const auto ready = make_pattern_show(sights.source, show, progress, stop);
  if (!ready) return ready.fault();
  TwoChoiceTest test{sights.eye_x_mm, {*ready}, {}, Choice::first};
  // Made for an eye farther to the right than it stands, the line was drawn too far to the left.
  for (const ShownTarget& target : ready->targets) test.stimuli.push_back({0, target});
  return test;
}

Result<double> seen_thread_difference(const ShowReader& show, std::size_t frame, const ThreadSights& sights,
                                      double eye_x_mm) {
  const double sign = sights.eye == Side::left ? -1.0 : 1.0;
  const double nominal_x_m = sign * sights.source.project.viewer.interpupillary_mm * 0.5e-3;
  const glm::dvec3 centre_m{eye_x_mm * 1e-3, 0.0, pupil_to_centre_m};
  const glm::dvec3 thread_m{0.0, 0.0, -sights.thread_m};
  const glm::dvec3 pupil_m = centre_m + pupil_to_centre_m * glm::normalize(thread_m - centre_m);
  const double thread_look = -pupil_m.x / (sights.thread_m + pupil_m.z);
  TrueEye eye;
  eye.side = sights.eye;
  eye.focus_d = 1.0 / sights.surface_m;
  eye.pupil_offset_m = pupil_m - glm::dvec3(nominal_x_m, 0.0, 0.0);
  const auto seen = see_pattern(show, frame, eye, picture_deg, {thread_look, -tangent_deg(middle_deg)});
  if (!seen) return seen.fault();
  double sum = 0.0, moment = 0.0;
  seen->each([&](const glm::dvec2& look, double light) {
    if (look.y > -tangent_deg(middle_deg) + tangent_deg(high_deg) / 4.0) return;
    sum += light;
    moment += light * look.x;
  });
  if (!(sum > 0.0)) return nothing_seen(frame, "the line");
  return thread_look - moment / sum;
}

InterpupillaryDistance interpupillary_distance(const PerEye<EqualityEstimate>& eye_x_mm, const ThreadSights& sights,
                                               double thread_uncertainty_mm) {
  InterpupillaryDistance found;
  found.mm = eye_x_mm.right.value - eye_x_mm.left.value;
  found.middle_mm = (eye_x_mm.right.value + eye_x_mm.left.value) / 2.0;
  found.answers_mm = std::hypot(eye_x_mm.left.uncertainty, eye_x_mm.right.uncertainty);
  // Lines apart by s lie behind a thread at z before a surface at D for eyes apart by s z / (D - z), both from where
  // the eyes turn.
  const double thread_m = sights.thread_m + pupil_to_centre_m;
  const double relative = (sights.surface_m + pupil_to_centre_m) / (sights.surface_m - sights.thread_m) / thread_m;
  found.thread_mm = found.mm * relative * std::hypot(thread_uncertainty_mm * 1e-3, pupil_to_centre_uncertainty_m);
  found.uncertainty_mm = std::hypot(found.answers_mm, found.thread_mm);
  return found;
}

}  // namespace focalstage
