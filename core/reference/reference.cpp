#include "core/reference/reference.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <glm/geometric.hpp>

#include "core/optics/assignment.h"
#include "core/optics/eye.h"
#include "core/optics/look.h"
#include "core/reference/colour.h"
#include "core/reference/view.h"

namespace focalstage {
namespace {

constexpr double near_plane_m = 1e-3;      ///< nothing nearer to the lens centre is seen
constexpr double hidden_by_share = 1e-4;   ///< a surface hides a point that lies this much deeper along the same line
constexpr double beyond_limit_d = 0.3;     ///< wanted powers further outside the slices are counted
constexpr double full_light = 1.0 + 1e-6;  ///< above it light is lost

/// Everything the samples read; made once per frame.
struct Scene {
  const Stage& stage;
  const CompileSettings& settings;
  SliceRule rule;
  PerEye<Eye> eyes;
  View lit;                    ///< the surfaces from the projector
  std::vector<View> surfaces;  ///< from each eye
  std::vector<View> objects;   ///< from each eye
};

/// A sample's point on a real surface as one eye sees it.
struct EyePoint {
  glm::dvec3 point_m;   ///< in eye space
  glm::dvec3 normal;    ///< of its triangle, in eye space
  glm::dvec2 straight;  ///< the look straight at it
  double own_m;         ///< axial, from the lens centre
};

/// What one sample of one slice adds to the picture and to the measures.
struct SliceLight {
  glm::dvec3 colour{0.0};  ///< already weighted
  bool counted = false;    ///< it has weight
  std::size_t object = 0;
  double beyond_d = 0.0;
};

/// What one row measured; rows are added up in order.
struct RowMeasure {
  FrameMeasure frame;
  explicit RowMeasure(std::size_t objects = 0) { frame.objects.resize(objects); }
};

std::optional<EyePoint> eye_point(const Scene& scene, Side side, const Sighting& lit, const glm::dvec3& world_m) {
  const Rigid& eye_from_world = scene.eyes[side].eye_from_world;
  const double lens_to_pupil_m = scene.settings.lens_to_pupil_m;
  EyePoint eye;
  eye.point_m = eye_from_world.point(world_m);
  if (-eye.point_m.z < lens_to_pupil_m + near_plane_m) return std::nullopt;
  eye.own_m = -eye.point_m.z - lens_to_pupil_m;
  eye.straight = straight_look(eye.point_m);
  eye.normal = scene.surfaces[index_of(side)].normal(lit.triangle);  // faces are listed alike in every view
  const std::optional<Sighting> first = scene.surfaces[index_of(side)].sight.nearest(eye.straight);
  const bool hidden = first && first->depth_m < -eye.point_m.z * (1.0 - hidden_by_share);
  if (hidden) return std::nullopt;
  return eye;
}

/// The look from the pupil in which slice `n` shows the point; none where the lens turns it behind the eye.
std::optional<glm::dvec2> slice_look(const Scene& scene, const EyePoint& eye, std::size_t n) {
  const Slices& slices = scene.settings.slices;
  if (slices.breathing == Breathing::off) return eye.straight;
  const double stretch = look_stretch(slices.powers_d[n], eye.own_m, scene.settings.lens_to_pupil_m);
  if (!(stretch > 0.0) || !std::isfinite(stretch)) return std::nullopt;
  return eye.straight * stretch;
}

double wanted_vergence_d(const Depth& depth, double placed_m) {
  if (depth.mode == DepthMode::fixed) return depth.vergence_d;
  return 1.0 / placed_m + (depth.mode == DepthMode::offset ? depth.vergence_d : 0.0);
}

SliceLight slice_light(const Scene& scene, Side side, const EyePoint& eye, std::size_t n) {
  const std::optional<glm::dvec2> look = slice_look(scene, eye, n);
  if (!look) return {};
  const View& view = scene.objects[index_of(side)];
  const std::optional<Sighting> met = view.sight.nearest(*look);
  if (!met) return {};

  const Face& face = view.faces[met->triangle];
  const StagedObject& object = scene.stage.objects[face.thing];
  const double lens_to_pupil_m = scene.settings.lens_to_pupil_m;
  double weight = static_cast<std::size_t>(object.depth.index) == n ? 1.0 : 0.0;
  SliceLight light;
  if (object.depth.mode != DepthMode::slice) {
    const double plane_m = plane_distance_m(*look, eye.point_m, eye.normal, lens_to_pupil_m);
    const double wanted_d = 1.0 / plane_m - wanted_vergence_d(object.depth, met->depth_m - lens_to_pupil_m);
    weight = scene.rule.weight(n, wanted_d);
    light.beyond_d = scene.rule.beyond_d(wanted_d);
  }
  if (weight <= 0.0) return {};
  const glm::dvec3 pupil_m = scene.eyes[side].eye_from_world.inverse().position_m;
  light.colour =
      weight * colour_at(object.drawables[face.drawable], face.triangle, met->shares, pupil_m, scene.stage.lights);
  light.counted = true;
  light.object = face.thing;
  return light;
}

void count(const SliceLight& light, RowMeasure& row) {
  if (!light.counted) return;
  ObjectMeasure& object = row.frame.objects[light.object];
  ++object.samples;
  if (light.beyond_d > beyond_limit_d) ++object.beyond;
  object.worst_beyond_d = std::max(object.worst_beyond_d, light.beyond_d);
}

/// Adds one sample of the projector's raster to the light of every image.
void add_sample(const Scene& scene, const Sighting& lit, const glm::dvec2& tangent, std::vector<glm::dvec3>& light,
                RowMeasure& row) {
  const CompileSettings& settings = scene.settings;
  const glm::dvec3 world_m = settings.projector.world_from_projector.point(glm::dvec3(tangent, -1.0) * lit.depth_m);
  const PerEye<std::optional<EyePoint>> eyes{eye_point(scene, Side::left, lit, world_m),
                                             eye_point(scene, Side::right, lit, world_m)};
  for (std::size_t i = 0; i < settings.images.size(); ++i) {
    const ImageSpec& image = settings.images[i];
    if (image.kind != ImageKind::content) {
      light[i] += glm::dvec3(scene.stage.surfaces[scene.lit.faces[lit.triangle].thing].illumination);
    }
    if (image.kind == ImageKind::surface_light || image.slice < 0 || image.eye == ImageEye::both) continue;
    const Side side = image.eye == ImageEye::left ? Side::left : Side::right;
    if (!eyes[side]) continue;
    const SliceLight seen = slice_light(scene, side, *eyes[side], static_cast<std::size_t>(image.slice));
    light[i] += seen.colour;
    count(seen, row);
  }
}

std::uint8_t code(double light, const CompileSettings& settings) {
  if (!(light > 0.0)) return 0;
  const double levels = std::exp2(settings.bits) - 1.0;
  return static_cast<std::uint8_t>(std::floor(levels * std::pow(std::min(1.0, light), 1.0 / settings.gamma) + 0.5));
}

void measure_focus(const CompileSettings& settings, double depth_m, RowMeasure& row) {
  ++row.frame.surface_pixels;
  if (!(settings.focus_m > 0.0)) return;
  const double defocus_d = std::abs(1.0 / depth_m - 1.0 / settings.focus_m);
  if (defocus_d > settings.depth_of_field_d / 2.0) ++row.frame.defocused_pixels;
  row.frame.worst_defocus_d = std::max(row.frame.worst_defocus_d, defocus_d);
}

void write_pixel(const CompileSettings& settings, const glm::dvec3& light, std::uint8_t* codes, RowMeasure& row) {
  const glm::dvec3 shown = settings.channels == 1 ? glm::dvec3(luminance(light)) : light;
  const double brightest = std::max(shown.x, std::max(shown.y, shown.z));
  if (brightest > 0.0) ++row.frame.lit_pixels;
  if (brightest > full_light) ++row.frame.clipped_pixels;
  for (int channel = 0; channel < settings.channels; ++channel) codes[channel] = code(shown[channel], settings);
}

void compile_row(const Scene& scene, int y, FrameImages& images, RowMeasure& row) {
  const CompileSettings& settings = scene.settings;
  const int side = static_cast<int>(std::lround(std::sqrt(settings.slices.samples_per_pixel)));
  std::vector<glm::dvec3> light(settings.images.size());
  for (int x = 0; x < images.width_px; ++x) {
    std::fill(light.begin(), light.end(), glm::dvec3(0.0));
    std::optional<double> nearest_m;
    for (int sample = 0; sample < side * side; ++sample) {
      const glm::dvec2 pixel{x + (sample % side + 0.5) / side, y + (sample / side + 0.5) / side};
      const glm::dvec2 tangent = tangent_of_pixel(settings.projector, pixel);
      const std::optional<Sighting> lit = scene.lit.sight.nearest(tangent);
      if (!lit) continue;
      nearest_m = std::min(nearest_m.value_or(lit->depth_m), lit->depth_m);
      add_sample(scene, *lit, tangent, light, row);
    }
    if (!nearest_m) continue;
    measure_focus(settings, *nearest_m, row);
    const auto at =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(images.width_px) + static_cast<std::size_t>(x);
    for (std::size_t i = 0; i < light.size(); ++i) {
      std::uint8_t* codes =
          &images.codes[i * images.bytes_per_image() + at * static_cast<std::size_t>(images.channels)];
      write_pixel(settings, light[i] / static_cast<double>(side * side), codes, row);
    }
  }
}

void add(const FrameMeasure& row, FrameMeasure& sum) {
  sum.lit_pixels += row.lit_pixels;
  sum.clipped_pixels += row.clipped_pixels;
  sum.surface_pixels += row.surface_pixels;
  sum.defocused_pixels += row.defocused_pixels;
  sum.worst_defocus_d = std::max(sum.worst_defocus_d, row.worst_defocus_d);
  for (std::size_t i = 0; i < sum.objects.size(); ++i) {
    sum.objects[i].samples += row.objects[i].samples;
    sum.objects[i].beyond += row.objects[i].beyond;
    sum.objects[i].worst_beyond_d = std::max(sum.objects[i].worst_beyond_d, row.objects[i].worst_beyond_d);
  }
}

Result<Scene> scene_of(const Stage& stage, const CompileSettings& settings) {
  Result<View> lit = view_of(stage.surfaces, settings.projector.world_from_projector.inverse(), 0.0);
  if (!lit) return lit.fault();
  Scene scene{stage,
              settings,
              SliceRule(settings.slices.powers_d, settings.slices.assignment),
              eyes_of(stage.world_from_viewer, stage.interpupillary_m, settings.lens_to_pupil_m),
              *std::move(lit),
              {},
              {}};
  const double nearest_m = settings.lens_to_pupil_m + near_plane_m;
  for (const Side side : both_sides) {
    Result<View> surfaces = view_of(stage.surfaces, scene.eyes[side].eye_from_world, nearest_m);
    if (!surfaces) return surfaces.fault();
    Result<View> objects = view_of(stage.objects, scene.eyes[side].eye_from_world, nearest_m);
    if (!objects) return objects.fault();
    scene.surfaces.push_back(*std::move(surfaces));
    scene.objects.push_back(*std::move(objects));
  }
  return scene;
}

}  // namespace

Result<CompiledFrame> compile_reference(const Stage& stage, const CompileSettings& settings, int threads) {
  if (settings.slices.assignment == Assignment::optimal) {
    return Fault{"compile.assignment", "/slices/assignment", "the rule \"optimal\" is not known here",
                 "use \"linear\" or \"nearest\""};
  }
  const Result<Scene> scene = scene_of(stage, settings);
  if (!scene) return scene.fault();

  CompiledFrame frame;
  frame.images = {
      settings.images.size(), settings.projector.width_px, settings.projector.height_px, settings.channels, {}};
  frame.images.codes.resize(frame.images.count * frame.images.bytes_per_image());
  std::vector<RowMeasure> rows(static_cast<std::size_t>(frame.images.height_px), RowMeasure(stage.objects.size()));
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute([&] {
    tbb::parallel_for(0, frame.images.height_px,
                      [&](int y) { compile_row(*scene, y, frame.images, rows[static_cast<std::size_t>(y)]); });
  });
  frame.measure.objects.resize(stage.objects.size());
  for (std::size_t i = 0; i < stage.objects.size(); ++i) frame.measure.objects[i].index = stage.objects[i].index;
  for (const RowMeasure& row : rows) add(row.frame, frame.measure);
  return frame;
}

}  // namespace focalstage
