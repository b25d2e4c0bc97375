#include "core/reference/reference.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "core/reference/colour.h"
#include "core/reference/samples.h"

namespace focalstage {
namespace {

constexpr double beyond_limit_d = 0.3;     ///< wanted powers further outside the slices are counted
constexpr double full_light = 1.0 + 1e-4;  ///< the rounding of sums of weights is no clipping

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

/// Adds what a lit point shows to the light of every image.
void add_sample(const Frame& frame, const LitPoint& lit, std::vector<glm::dvec3>& light, FrameMeasure& measure) {
  const PerEye<std::optional<EyePoint>> eyes{frame.samples.seen(Side::left, lit), frame.samples.seen(Side::right, lit)};
  for (std::size_t i = 0; i < light.size(); ++i) {
    const ImageSpec& image = frame.settings.images[i];
    if (image.kind != ImageKind::content) light[i] += glm::dvec3(frame.stage.surfaces[lit.surface].illumination);
    if (image.kind == ImageKind::surface_light || image.eye == ImageEye::both) continue;
    const Side side = image.eye == ImageEye::left ? Side::left : Side::right;
    if (!eyes[side]) continue;
    const auto sample = frame.samples.slice(side, *eyes[side], static_cast<std::size_t>(image.slice));
    if (!sample || !(sample->weight > 0.0)) continue;
    light[i] += sample->weight * sample->colour;
    count(*sample, measure);
  }
}

std::uint8_t code(double light, const CompileSettings& settings) {
  if (!(light > 0.0)) return 0;
  const double levels = std::exp2(settings.bits) - 1.0;
  return static_cast<std::uint8_t>(std::floor(levels * std::pow(std::min(1.0, light), 1.0 / settings.gamma) + 0.5));
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

void write_pixel(const Frame& frame, int x, int y, const std::vector<glm::dvec3>& light, FrameMeasure& measure) {
  FrameImages& images = frame.images;
  const auto channels = static_cast<std::size_t>(images.channels);
  const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(images.width_px) + static_cast<std::size_t>(x);
  for (std::size_t i = 0; i < light.size(); ++i) {
    const glm::dvec3 mean = light[i] / static_cast<double>(frame.grid * frame.grid);
    const glm::dvec3 shown = channels == 1 ? glm::dvec3(luminance(mean)) : mean;
    const double brightest = std::max(shown.x, std::max(shown.y, shown.z));
    if (brightest > 0.0) ++measure.lit_pixels;
    if (brightest > full_light) ++measure.clipped_pixels;
    std::uint8_t* codes = &images.codes[i * images.bytes_per_image() + at * channels];
    for (std::size_t channel = 0; channel < channels; ++channel) {
      codes[channel] = code(shown[static_cast<int>(channel)], frame.settings);
    }
  }
}

void compile_row(const Frame& frame, int y, FrameMeasure& measure) {
  std::vector<glm::dvec3> light(frame.settings.images.size());
  for (int x = 0; x < frame.images.width_px; ++x) {
    std::fill(light.begin(), light.end(), glm::dvec3(0.0));
    for (int row = 0; row < frame.grid; ++row) {
      for (int column = 0; column < frame.grid; ++column) {
        const auto lit = frame.samples.lit({x + (column + 0.5) / frame.grid, y + (row + 0.5) / frame.grid});
        if (row == 0 && column == 0) measure_focus(frame.settings, lit, measure);
        if (lit) add_sample(frame, *lit, light, measure);
      }
    }
    write_pixel(frame, x, y, light, measure);
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
}

}  // namespace

Result<CompiledFrame> compile_reference(const Stage& stage, const CompileSettings& settings, int threads) {
  if (settings.slices.assignment == Assignment::optimal) {
    return Fault{"compile.assignment", "/slices/assignment", "the naive reference has no assignment \"optimal\"",
                 "compile without --reference, or use \"linear\" or \"nearest\""};
  }
  const Result<Samples> samples = Samples::of(stage, settings);
  if (!samples) return samples.fault();

  CompiledFrame out;
  out.images = {
      settings.images.size(), settings.projector.width_px, settings.projector.height_px, settings.channels, {}};
  out.images.codes.resize(out.images.count * out.images.bytes_per_image());
  for (const StagedObject& object : stage.objects) out.measure.objects.push_back({object.index, 0, 0, 0.0});

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
