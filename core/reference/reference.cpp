#include "core/reference/reference.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <glm/common.hpp>

#include "core/reference/codes.h"
#include "core/reference/colour.h"
#include "core/reference/samples.h"

namespace focalstage {
namespace {

constexpr double beyond_limit_d = 0.3;  ///< wanted powers further outside the slices are counted

/// What every row reads, and where it writes.
struct Frame {
  const Stage& stage;
  const CompileSettings& settings;
  const Samples& samples;
  FrameImages& images;
  int grid;  ///< samples per pixel and direction
};

void count(const SliceSample& sample, FrameMeasure& measure) {
  ObjectMeasure& object = measure.objects[sample.object];
  ++object.samples;
  if (sample.beyond_d > beyond_limit_d) ++object.beyond;
  object.worst_beyond_d = std::max(object.worst_beyond_d, sample.beyond_d);
  double& own_side_d = sample.below ? object.worst_below_d : object.worst_above_d;
  own_side_d = std::max(own_side_d, sample.beyond_d);
}

/// What a pixel is to show in one image, summed over its samples.
struct Wanted {
  glm::dvec3 content{0.0};
  glm::dvec3 surface{0.0};  ///< surface light
  double weight = 0.0;      ///< of the content
};

/// What of a pixel's light comes back, summed over its samples that meet a surface.
struct Returned {
  glm::dvec3 back{0.0};
  double density = 0.0;
  int count = 0;
  std::size_t surface = 0;  ///< that of the first sample
  bool first_meets = false;
};

/// Adds what a lit point shows to every image.
void add_sample(const Frame& frame, const LitPoint& lit, std::vector<Wanted>& wanted, FrameMeasure& measure) {
  const PerEye<std::optional<EyePoint>> eyes{frame.samples.seen(Side::left, lit), frame.samples.seen(Side::right, lit)};
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const ImageSpec& image = frame.settings.images[i];
    if (image.kind != ImageKind::content)
      wanted[i].surface += glm::dvec3(frame.stage.surfaces[lit.surface].illumination);
    if (image.kind == ImageKind::surface_light || image.eye == ImageEye::both) continue;
    const Side side = image.eye == ImageEye::left ? Side::left : Side::right;
    if (!eyes[side]) continue;
    const auto sample = frame.samples.slice(side, *eyes[side], static_cast<std::size_t>(image.slice));
    if (!sample || !(sample->weight > 0.0)) continue;
    wanted[i].content += sample->weight * sample->colour;
    wanted[i].weight += sample->weight;
    count(*sample, measure);
  }
}

/// Focus is asked of a pixel's first sample.
void measure_focus(const CompileSettings& settings, const std::optional<LitPoint>& first, FrameMeasure& measure) {
  if (!first) return;
  ++measure.surface_pixels;
  if (!(settings.focus_m > 0.0) || !(settings.depth_of_field_d > 0.0)) return;
  const double off_d = std::abs(1.0 / first->depth_m - 1.0 / settings.focus_m) - settings.depth_of_field_d / 2.0;
  if (off_d > 0.0) ++measure.defocused_pixels;
  measure.worst_defocus_d = std::max(measure.worst_defocus_d, off_d);
}

/// In the images' channels: a gray projector's is the luminance.
glm::dvec3 in_channels(const glm::dvec3& colour, int channels) {
  return channels == 1 ? glm::dvec3(luminance(colour)) : colour;
}

/// How many exposures of a period reach the eye that an image is for.
int exposures_beside(const ImageSpec& image, const std::vector<ImageSpec>& images) {
  int count = 0;
  for (const ImageSpec& other : images) count += other.eye == image.eye || other.eye == ImageEye::both ? 1 : 0;
  return count;
}

/// The light that the projector has to give in a pixel, full white being 1 and black 0, so that what is wanted comes
/// back (docs/colour.md): everything that leaks meanwhile is part of what comes back.
glm::dvec3 given(const Frame& frame, const ImageSpec& image, const Wanted& wanted, const Returned& returned) {
  const double samples = frame.grid * frame.grid;
  const CompileSettings& settings = frame.settings;
  const glm::dvec3 content = in_channels(wanted.content / samples, settings.channels);
  const glm::dvec3 surface = in_channels(wanted.surface / samples, settings.channels);
  const Compensation& asked = settings.slices.compensation;
  if (asked.mode == CompensationMode::off) return content + surface;
  if (returned.count == 0) return glm::dvec3(0.0);
  constexpr double least_back = 1e-6;  // less comes back from nothing real
  const glm::dvec3 back = glm::max(in_channels(returned.back / static_cast<double>(returned.count), settings.channels),
                                   glm::dvec3(least_back));
  const double density = std::max(returned.density / returned.count, least_back);
  const double leaks = settings.black_level * exposures_beside(image, settings.images) * wanted.weight / samples;
  return (asked.white * content / back - leaks) / (1.0 - settings.black_level) + asked.white * surface / density;
}

void write_pixel(const Frame& frame, int x, int y, const std::vector<Wanted>& wanted, const Returned& returned,
                 FrameMeasure& measure) {
  FrameImages& images = frame.images;
  const auto channels = static_cast<std::size_t>(images.channels);
  const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(images.width_px) + static_cast<std::size_t>(x);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const glm::dvec3 shown = given(frame, frame.settings.images[i], wanted[i], returned);
    if (returned.first_meets && !measure.surfaces.empty())
      count_asked(shown, images.channels, measure.surfaces[returned.surface]);
    const double brightest = std::max(shown.x, std::max(shown.y, shown.z));
    if (brightest > 0.0) ++measure.lit_pixels;
    if (brightest > full_light) ++measure.clipped_pixels;
    std::uint8_t* codes = &images.codes[i * images.bytes_per_image() + at * channels];
    for (std::size_t channel = 0; channel < channels; ++channel) {
      codes[channel] = code_of(shown[static_cast<int>(channel)], frame.settings);
    }
  }
}

/// Adds what comes back of the light that a sample's point gets.
void add_return(const Frame& frame, const glm::dvec2& pixel, const LitPoint& lit, bool first, Returned& returned) {
  const Compensation& asked = frame.settings.slices.compensation;
  if (asked.mode == CompensationMode::off) return;
  double density = 1.0;
  if (asked.mode == CompensationMode::even) {
    // A pixel square to the axis at the reference covers reference^2 / (fx fy); here it covers its footprint.
    const ProjectorModel& projector = frame.settings.projector;
    const double reference_m2 =
        frame.settings.reference_m * frame.settings.reference_m / (projector.focal_px.x * projector.focal_px.y);
    density = reference_m2 / frame.samples.footprint_m2(pixel, lit);
  }
  returned.back += frame.samples.albedo(lit) * density;
  returned.density += density;
  ++returned.count;
  if (!first) return;
  returned.first_meets = true;
  returned.surface = lit.surface;
}

void compile_row(const Frame& frame, int y, FrameMeasure& measure) {
  std::vector<Wanted> wanted(frame.settings.images.size());
  for (int x = 0; x < frame.images.width_px; ++x) {
    std::fill(wanted.begin(), wanted.end(), Wanted{});
    Returned returned;
    for (int row = 0; row < frame.grid; ++row) {
      for (int column = 0; column < frame.grid; ++column) {
        const glm::dvec2 pixel{x + (column + 0.5) / frame.grid, y + (row + 0.5) / frame.grid};
        const auto lit = frame.samples.lit(pixel);
        const bool first = row == 0 && column == 0;
        if (first) measure_focus(frame.settings, lit, measure);
        if (!lit) continue;
        add_sample(frame, *lit, wanted, measure);
        add_return(frame, pixel, *lit, first, returned);
      }
    }
    write_pixel(frame, x, y, wanted, returned, measure);
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
    sum.objects[i].worst_below_d = std::max(sum.objects[i].worst_below_d, row.objects[i].worst_below_d);
    sum.objects[i].worst_above_d = std::max(sum.objects[i].worst_above_d, row.objects[i].worst_above_d);
  }
  for (std::size_t i = 0; i < sum.surfaces.size(); ++i) add(row.surfaces[i], sum.surfaces[i]);
}

}  // namespace

Result<CompiledFrame> compile_reference(const Stage& stage, const CompileSettings& settings, int threads) {
  if (settings.slices.assignment == Assignment::optimal) {
    return Fault{"compile.assignment", "/slices/assignment", "the naive reference has no assignment \"optimal\"",
                 "compile without --reference, or use \"linear\" or \"nearest\""};
  }
  if (!settings.blend.empty()) {
    return Fault{"compile.blend", "/projectors", "the naive reference knows one projector, and has no blending",
                 "compile without --reference"};
  }
  const Result<Samples> samples = Samples::of(stage, settings);
  if (!samples) return samples.fault();

  CompiledFrame out;
  out.images = {
      settings.images.size(), settings.projector.width_px, settings.projector.height_px, settings.channels, {}};
  out.images.codes.resize(out.images.count * out.images.bytes_per_image());
  for (const StagedObject& object : stage.objects) out.measure.objects.push_back({object.index, 0, 0, 0.0});
  if (settings.slices.compensation.mode != CompensationMode::off) {
    for (const StagedSurface& surface : stage.surfaces) out.measure.surfaces.push_back({surface.index});
  }

  const int grid = static_cast<int>(std::lround(std::sqrt(settings.slices.samples_per_pixel)));
  const Frame frame{stage, settings, *samples, out.images, grid};
  std::vector<FrameMeasure> rows(static_cast<std::size_t>(out.images.height_px), out.measure);
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute([&] {
    tbb::parallel_for(0, out.images.height_px,
                      [&](int y) { compile_row(frame, y, rows[static_cast<std::size_t>(y)]); });
  });
  for (const FrameMeasure& row : rows) add(row, out.measure);
  return out;
}

}  // namespace focalstage
