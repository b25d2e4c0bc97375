#include "editor/viewer/breathing_rings.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include <glm/geometric.hpp>

#include "io/files/files.h"

namespace focalstage {
namespace {

constexpr double least_mm = 5.0;
constexpr double most_mm = 40.0;
constexpr double step_mm = 0.5;
constexpr double width_deg = 0.3;
constexpr double gap_deg = 8.0;  ///< from the horizontal, where the halves would meet
constexpr double mark_deg = 0.3;
constexpr int pieces = 96;
constexpr double least_span_d = 1.0;     ///< a millimetre is a thousandth of the size then: 25 seconds of arc
constexpr double ring_distance_m = 1.0;  ///< where a ring of the nominal size stands; pinned to a slice, it is free
constexpr double picture_deg = 22.0;
constexpr double beside = 0.25;     ///< where halves come near each other nothing is read: |sine| of the angle
constexpr double middle_deg = 2.0;  ///< nor from the mark in the middle

/// A half ring around the origin, facing +Z, of the size that it has at `ring_distance_m`.
std::string half_ring(double sign) {
  std::string text;
  char line[120];
  const double from = gap_deg, to = 180.0 - gap_deg;
  for (int i = 0; i <= pieces; ++i) {
    const double angle = sign * (from + (to - from) * i / pieces) * std::numbers::pi / 180.0;
    for (const double deg : {ring_deg - width_deg / 2.0, ring_deg + width_deg / 2.0}) {
      const double radius_m = ring_distance_m * tangent_deg(deg);
      std::snprintf(line, sizeof line, "v %.9f %.9f 0\n", radius_m * std::cos(angle), radius_m * std::sin(angle));
      text += line;
    }
  }
  for (int i = 0; i < pieces; ++i) {
    const int a = 2 * i + 1;
    std::snprintf(line, sizeof line, "f %d %d %d\nf %d %d %d\n", a, a + 1, a + 3, a, a + 3, a + 2);
    text += line;
  }
  return text;
}

AssetFile file_of(const std::string& path, const std::string& text) {
  const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
  return {path, sha256_hex(text), SharedBytes(bytes, bytes + text.size())};
}

/// How large on the surface a picture must be that the eye shall see at a given size through `power_d`: with the lens
/// d before the pupil and the surface D from it, in proportion to (D - d) + (1 - v (D - d)) d.
double size_on_surface(double surface_m, double power_d, double lens_to_pupil_m) {
  return surface_m - power_d * (surface_m - lens_to_pupil_m) * lens_to_pupil_m;
}

std::size_t slice_nearest_zero(const std::vector<double>& powers_d) {
  const auto nearer = [](double a, double b) { return std::abs(a) < std::abs(b); };
  return static_cast<std::size_t>(std::min_element(powers_d.begin(), powers_d.end(), nearer) - powers_d.begin());
}

/// Half a ring, frame by frame as large as each distance wants it. The project's compiler makes it for the nominal
/// distance: nearer rings are larger by what is wanted more.
void grow(Object& half, const BreathingRings& rings, const EyeInRoom& eye) {
  const Project& project = rings.source.project;
  const double power_d = project.slices.powers_d[static_cast<std::size_t>(half.depth.index)];
  const double nominal = size_on_surface(rings.surface_m, power_d, project.glasses.lens_to_pupil_mm * 1e-3);
  for (std::size_t k = 0; k < rings.lens_to_pupil_mm.size(); ++k) {
    const double larger = size_on_surface(rings.surface_m, power_d, rings.lens_to_pupil_mm[k] * 1e-3) / nominal;
    const glm::dvec3 place_m = eye.world_from_eye.point({0.0, 0.0, -ring_distance_m / larger});
    half.placement.keys.push_back({project.cues[k].time_s, {place_m, eye.world_from_eye.rotation}});
  }
}

/// What the gaze rests on.
Object middle_mark(const EyeInRoom& eye, std::size_t slice) {
  const double size_m = ring_distance_m * tangent_deg(mark_deg);
  Object mark = slice_object("mark", PlaneMesh{{size_m, size_m}}, slice);
  mark.placement.pose = {eye.world_from_eye.point({0.0, 0.0, -ring_distance_m}), eye.world_from_eye.rotation};
  return mark;
}

}  // namespace

Result<BreathingRings> breathing_rings(const Source& from, Side side) {
  const std::vector<double>& powers_d = from.project.slices.powers_d;
  const auto [lowest, highest] = std::minmax_element(powers_d.begin(), powers_d.end());
  if (powers_d.empty() || *highest - *lowest < least_span_d) {
    return Fault{"viewer.slices", "/slices/powers_d", "the slices span less than one dioptre: too little to compare",
                 "add slices further apart"};
  }
  const auto eye = EyeInRoom::of(from, side);
  if (!eye) return eye.fault();
  const auto surface_m = eye->flat_surface_m(ring_deg + 1.0);
  if (!surface_m) return surface_m.fault();

  BreathingRings rings{from, {}, side, *surface_m};
  for (double mm = least_mm; mm < most_mm + step_mm / 2.0; mm += step_mm) rings.lens_to_pupil_mm.push_back(mm);
  rings.source.project = bare_room(from.project, "Lens to pupil", rings.lens_to_pupil_mm.size());
  Object upper =
      slice_object("upper", FileMesh{"rings/upper.obj"}, static_cast<std::size_t>(highest - powers_d.begin()));
  Object lower =
      slice_object("lower", FileMesh{"rings/lower.obj"}, static_cast<std::size_t>(lowest - powers_d.begin()));
  grow(upper, rings, *eye);
  grow(lower, rings, *eye);
  Project project = rings.source.project;
  project.objects = {upper, lower, middle_mark(*eye, slice_nearest_zero(powers_d))};
  auto source =
      pattern_source(from, std::move(project),
                     {file_of("rings/upper.obj", half_ring(1.0)), file_of("rings/lower.obj", half_ring(-1.0))});
  if (!source) return source.fault();
  rings.source = *std::move(source);
  return rings;
}

Result<TwoChoiceTest> ring_test(const BreathingRings& rings, const std::filesystem::path& show,
                                const FrameProgress& progress, const std::stop_token& stop) {
  const auto ready = make_pattern_show(rings.source, show, progress, stop);
  if (!ready) return ready.fault();
  TwoChoiceTest test{rings.lens_to_pupil_mm, {*ready}, {}, Choice::second};
  // Made for more distance than there is, the picture of the higher power, the upper one, was drawn too small.
  for (const ShownTarget& target : ready->targets) test.stimuli.push_back({0, target});
  return test;
}

Result<double> seen_ring_difference(const ShowReader& show, std::size_t frame, const TrueEye& eye) {
  const auto seen = see_pattern(show, frame, eye, picture_deg);
  if (!seen) return seen.fault();
  double light[2] = {0.0, 0.0};
  double radius[2] = {0.0, 0.0};
  seen->each([&](const glm::dvec2& look, double level) {
    const double from_middle = glm::length(look);
    if (from_middle < tangent_deg(middle_deg) || std::abs(look.y) < beside * from_middle) return;
    const std::size_t half = look.y > 0.0 ? 0 : 1;
    light[half] += level;
    radius[half] += level * from_middle;
  });
  if (!(light[0] > 0.0) || !(light[1] > 0.0)) return nothing_seen(frame, "a half of the ring");
  const double upper = radius[0] / light[0];
  const double lower = radius[1] / light[1];
  return 2.0 * (upper - lower) / (upper + lower);
}

TrueEye eye_at_rings(const BreathingRings& rings, double lens_to_pupil_mm) {
  TrueEye eye;
  eye.side = rings.eye;
  eye.lens_to_pupil_m = lens_to_pupil_mm * 1e-3;
  eye.focus_d = 1.0 / (rings.surface_m - *eye.lens_to_pupil_m);
  return eye;
}

}  // namespace focalstage
