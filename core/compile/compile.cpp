#include "core/compile/compile.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <utility>

#include "core/compile/encode.h"
#include "core/compile/frame_run.h"
#include "core/compile/optimal.h"
#include "core/compile/pixel_looks.h"
#include "core/compile/slice_tile.h"
#include "core/compile/surface_gain.h"
#include "core/compile/surface_hits.h"
#include "core/compile/tile_clips.h"
#include "core/mesh/solid.h"

namespace focalstage {
namespace {

/// Which meshes are solid, asked once per mesh that stays on stage.
class SolidMeshes {
 public:
  void mark(std::vector<ViewDrawable>& drawables) {
    for (ViewDrawable& seen : drawables) {
      const auto [entry, fresh] = known_.try_emplace(seen.drawable->mesh, false);
      if (fresh) entry->second = is_solid(*seen.drawable->mesh);
      seen.solid = entry->second && !(seen.drawable->finish.alpha_cutoff > 0.0);  // its inside is seen through cuts
    }
  }
  /// Forgets meshes that nobody else holds.
  void tidy() {
    std::erase_if(known_, [](const auto& entry) { return entry.first.use_count() == 1; });
  }

 private:
  std::map<std::shared_ptr<const Mesh>, bool> known_;
};

/// What a row of tiles counted.
struct RowTally {
  std::uint64_t lit_pixels = 0;
  std::uint64_t clipped_pixels = 0;
  std::vector<ObjectTally> objects;
  std::vector<SurfaceAsked> surfaces;  ///< with compensation alone
};

/// A frame's images in the making.
struct Frame {
  FrameRun run;
  PerEye<const OptimalChange*> changes;  ///< null without
  const Encoder* encoder;
  FrameImages* images;
  const SurfaceGains* gains;  ///< null: no compensation, and no other projector
  ClipMap* clips;             ///< null: nobody asks
};

void write_tile(const Frame& frame, std::size_t image, int tile_column, int tile_row, const TileLight& light,
                RowTally& tally) {
  FrameImages& out = *frame.images;
  const auto channels = static_cast<std::size_t>(out.channels);
  const int left = tile_column * tile_side;
  const int columns = std::min(tile_side, out.width_px - left);
  const int rows = std::min(tile_side, out.height_px - tile_row * tile_side);
  for (int y = 0; y < rows; ++y) {
    const auto row = static_cast<std::size_t>(tile_row * tile_side + y) * static_cast<std::size_t>(out.width_px);
    std::uint8_t* to =
        out.codes.data() + image * out.bytes_per_image() + (row + static_cast<std::size_t>(left)) * channels;
    if (!light.any) {
      std::memset(to, 0, static_cast<std::size_t>(columns) * channels);
      continue;
    }
    for (int x = 0; x < columns; ++x) {
      float most = 0.0f;
      for (std::size_t c = 0; c < channels; ++c) {
        const float value = light.channel[c][y * tile_side + x];
        most = std::max(most, value);
        *to++ = frame.encoder->code(value);
      }
      constexpr float full = 1.0f + clip_tolerance;
      tally.lit_pixels += most > 0.0f ? 1 : 0;
      tally.clipped_pixels += most > full ? 1 : 0;
    }
  }
}

Side side_of(const ImageSpec& image) { return image.eye == ImageEye::left ? Side::left : Side::right; }

/// The light that an image is to show in a tile, and for `kind` alone where an image carries both.
void wanted_light(const Frame& frame, ImageSpec spec, ImageKind kind, int column, int row, TileLight& light,
                  std::vector<ObjectTally>& tallies) {
  spec.kind = kind;
  light_of_tile(frame.run, spec, column, row, light, tallies);
  if (kind == ImageKind::surface_light) return;
  const OptimalChange* const change = frame.changes[side_of(spec)];
  const auto tile = static_cast<std::size_t>(row * frame.run.rays->grid.columns() + column);
  if (change != nullptr)
    add_change(*change, tile, static_cast<std::size_t>(spec.slice), frame.run.slice.channels, light);
}

/// What the projector has to give so that the wanted light comes back.
void compensated_light(const Frame& frame, const ImageSpec& spec, int column, int row, TileLight& light,
                       std::vector<ObjectTally>& tallies) {
  const auto tile = static_cast<std::size_t>(row * frame.run.rays->grid.columns() + column);
  const TileGain& gain = frame.gains->tiles[tile];
  const int channels = frame.run.slice.channels;
  if (spec.kind == ImageKind::surface_light) {
    wanted_light(frame, spec, spec.kind, column, row, light, tallies);
    if (light.any) scale_surface_light(gain, channels, light);
    return;
  }
  wanted_light(frame, spec, ImageKind::content, column, row, light, tallies);
  if (light.any) compensate_content(gain, frame.gains->leak[side_of(spec)], channels, light);
  if (spec.kind == ImageKind::content) return;
  TileLight lit;
  wanted_light(frame, spec, ImageKind::surface_light, column, row, lit, tallies);
  if (!lit.any) return;
  scale_surface_light(gain, channels, lit);
  add_light(lit, channels, light);
}

void compile_tile(const Frame& frame, std::size_t image, int column, int row, RowTally& tally) {
  const ImageSpec& spec = frame.run.settings->images[image];
  TileLight light;
  if (frame.gains == nullptr) {
    wanted_light(frame, spec, spec.kind, column, row, light, tally.objects);
  } else {
    compensated_light(frame, spec, column, row, light, tally.objects);
    const auto tile = static_cast<std::size_t>(row * frame.run.rays->grid.columns() + column);
    if (light.any && frame.gains->counts)
      count_asked(light, frame.run.met->tiles[tile], *frame.run.surfaces, frame.run.slice.channels, tally.surfaces);
  }
  write_tile(frame, image, column, row, light, tally);
  if (frame.clips != nullptr && light.any) mark_clips(light, frame.run.slice.channels, column, row, *frame.clips);
}

std::vector<RowTally> compile_rows(const Frame& frame, std::stop_token stop) {
  const FrameRun& run = frame.run;
  const TileGrid& grid = run.rays->grid;
  std::vector<RowTally> tallies(static_cast<std::size_t>(grid.rows()));
  tbb::parallel_for(0, grid.rows(), [&](int row) {
    RowTally& tally = tallies[static_cast<std::size_t>(row)];
    tally.objects.resize(run.stage->objects.size());
    if (frame.gains != nullptr && frame.gains->counts) tally.surfaces.resize(run.stage->surfaces.size());
    if (stop.stop_requested()) return;
    for (std::size_t image = 0; image < run.settings->images.size(); ++image) {
      for (int column = 0; column < grid.columns(); ++column) compile_tile(frame, image, column, row, tally);
    }
  });
  return tallies;
}

struct SurfaceMeasure {
  std::uint64_t surface_pixels = 0;
  std::uint64_t defocused_pixels = 0;
  double worst_defocus_d = 0.0;
};

/// Pixels (their first samples) that meet a surface, and how many of those the projector can't focus.
SurfaceMeasure measure_surface(const CompileSettings& settings, const ProjectorRays& rays, const ProjectorHits& met) {
  SurfaceMeasure measure;
  for (std::size_t tile = 0; tile < rays.grid.count(); ++tile) {
    const TileMet& hit = met.tiles[tile];
    if (!hit.any) continue;
    for (int i = 0; i < tile_samples; ++i) {
      if (hit.drawable[i] < 0) continue;
      ++measure.surface_pixels;
      if (!(settings.focus_m > 0.0) || !(settings.depth_of_field_d > 0.0)) continue;
      const double off_d = std::abs(1.0 / -hit.z[i] - 1.0 / settings.focus_m) - settings.depth_of_field_d / 2.0;
      if (off_d > 0.0) ++measure.defocused_pixels;
      measure.worst_defocus_d = std::max(measure.worst_defocus_d, off_d);
    }
  }
  return measure;
}

FrameMeasure gather(const Stage& stage, const std::vector<RowTally>& tallies) {
  FrameMeasure measure;
  for (const StagedObject& object : stage.objects) measure.objects.push_back({object.index, 0, 0, 0.0});
  if (!tallies.empty() && !tallies.front().surfaces.empty()) measure.surfaces.resize(stage.surfaces.size());
  for (std::size_t i = 0; i < measure.surfaces.size(); ++i) measure.surfaces[i].index = stage.surfaces[i].index;
  for (const RowTally& row : tallies) {
    for (std::size_t i = 0; i < row.surfaces.size(); ++i) add_asked(row.surfaces[i], measure.surfaces[i]);
    measure.lit_pixels += row.lit_pixels;
    measure.clipped_pixels += row.clipped_pixels;
    for (std::size_t i = 0; i < row.objects.size(); ++i) {
      ObjectMeasure& object = measure.objects[i];
      object.samples += row.objects[i].samples;
      object.beyond += row.objects[i].beyond;
      object.worst_beyond_d = std::max(object.worst_beyond_d, row.objects[i].worst_beyond_d);
      object.worst_below_d = std::max(object.worst_below_d, row.objects[i].worst_below_d);
      object.worst_above_d = std::max(object.worst_above_d, row.objects[i].worst_above_d);
    }
  }
  return measure;
}

}  // namespace

struct Compiler::State {
  State(CompileSettings given, int threads, VectorPath path)
      : settings(std::move(given)),
        arena(threads > 0 ? threads : tbb::task_arena::automatic),
        kernel(path == VectorPath::portable ? portable_kernel : best_kernel()),
        rule(settings.slices.powers_d, settings.slices.assignment),
        encoder(settings.bits, settings.gamma, settings.transfer) {}

  /// Where the projector's rays end and what each eye sees of it; kept while surfaces and viewer stand still.
  void look_at_surfaces(const Stage& stage, const std::vector<ViewDrawable>& surfaces) {
    if (!rays) rays = projector_rays(settings.projector, settings.slices.samples_per_pixel);
    const bool same_surfaces = surfaces_before == stage.surfaces && met;
    const bool same_viewer =
        same_surfaces && viewer_before == stage.world_from_viewer && interpupillary_before_m == stage.interpupillary_m;
    if (same_viewer) return;
    if (!same_surfaces) {
      met = projector_hits(*rays, settings.projector, surfaces, kernel);
      surface_measure = measure_surface(settings, *rays, *met);
      gains = surface_gains(settings, *rays, *met, surfaces, kernel);
    }
    const PerEye<Eye> eyes = eyes_of(stage.world_from_viewer, stage.interpupillary_m, settings.lens_to_pupil_m);
    for (const Side side : both_sides) {
      hits[side] = eye_hits(*met, rays->grid, settings.projector.world_from_projector, eyes[side], surfaces,
                            settings.slices.breathing, kernel);
      if (optimal()) {
        looks[side] = pixel_looks(hits[side], rays->grid, rays->subsamples, settings.lens_to_pupil_m);
      }
    }
    surfaces_before = stage.surfaces;
    viewer_before = stage.world_from_viewer;
    interpupillary_before_m = stage.interpupillary_m;
  }

  CompiledFrame frame(const Stage& stage, std::stop_token stop, FrameImages recycled, ClipMap* clips) {
    std::vector<ViewDrawable> surfaces = drawables_of(stage.surfaces);
    std::vector<ViewDrawable> objects = drawables_of(stage.objects);
    solid.mark(surfaces);
    solid.mark(objects);
    look_at_surfaces(stage, surfaces);

    CompiledFrame out;
    out.images = {settings.images.size(), settings.projector.width_px, settings.projector.height_px, settings.channels,
                  std::move(recycled.codes)};
    out.images.codes.resize(out.images.count * out.images.bytes_per_image());

    Frame work{{&settings,
                &stage,
                &*rays,
                &*met,
                &surfaces,
                {&hits.left, &hits.right},
                {&views.left, &views.right},
                slice_setups(settings.slices, settings.lens_to_pupil_m),
                {&kernel, &rule, settings.channels, 1.0f / static_cast<float>(rays->subsamples),
                 gains && makes_up_for_black(settings)}},
               {nullptr, nullptr},
               &encoder,
               &out.images,
               gains ? &*gains : nullptr,
               clips};
    if (clips != nullptr) *clips = no_clips(out.images.width_px, out.images.height_px);
    const PerEye<Eye> eyes = eyes_of(stage.world_from_viewer, stage.interpupillary_m, settings.lens_to_pupil_m);
    tbb::parallel_for(0, 2, [&](int i) {
      const Side side = both_sides[static_cast<std::size_t>(i)];
      if (stop.stop_requested()) return;
      look_at_objects(views[side], stage, objects, eyes[side], hits[side], rays->grid, work.run.slices);
    });
    if (optimal()) solve(work, objects, eyes, stop);
    const std::vector<RowTally> tallies = compile_rows(work, stop);
    out.measure = gather(stage, tallies);
    out.measure.surface_pixels = surface_measure.surface_pixels;
    out.measure.defocused_pixels = surface_measure.defocused_pixels;
    out.measure.worst_defocus_d = surface_measure.worst_defocus_d;
    for (const Side side : both_sides) {
      if (work.changes[side] != nullptr) out.measure.optimal[side] = changes[side].measure;
    }
    solid.tidy();
    return out;
  }

  /// The solver takes the raster of the pixels for a square lattice; on any other its slices stay linear.
  bool optimal() const {
    return settings.slices.assignment == Assignment::optimal && settings.projector.layout == PixelLayout::square;
  }

  /// What changes against linear filtering. Eyes beside each other look past what is solid from other sides.
  void solve(Frame& work, const std::vector<ViewDrawable>& objects, const PerEye<Eye>& eyes, std::stop_token stop) {
    std::vector<ViewDrawable> open = objects;
    for (ViewDrawable& seen : open) seen.solid = false;
    const bool same = std::none_of(objects.begin(), objects.end(), [](const ViewDrawable& seen) { return seen.solid; });
    tbb::parallel_for(0, 2, [&](int i) {
      const Side side = both_sides[static_cast<std::size_t>(i)];
      if (stop.stop_requested()) return;
      if (!same) {
        look_at_objects(open_views[side], *work.run.stage, open, eyes[side], hits[side], rays->grid, work.run.slices);
      }
      changes[side] = optimal_change(work.run, side, looks[side], same ? views[side] : open_views[side], stop);
      work.changes[side] = &changes[side];
    });
  }

  CompileSettings settings;
  tbb::task_arena arena;
  const Kernel& kernel;
  SliceRule rule;
  Encoder encoder;
  SolidMeshes solid;

  std::optional<ProjectorRays> rays;
  std::optional<ProjectorHits> met;
  SurfaceMeasure surface_measure;
  std::optional<SurfaceGains> gains;
  PerEye<EyeHits> hits;
  PerEye<PixelLooks> looks;  ///< with `optimal` alone, as the two below
  PerEye<EyeView> views;
  PerEye<EyeView> open_views;  ///< no back left out
  PerEye<OptimalChange> changes;
  std::vector<StagedSurface> surfaces_before;
  Rigid viewer_before;
  double interpupillary_before_m = 0.0;
};

Compiler::Compiler(CompileSettings settings, int threads, VectorPath path)
    : state_(std::make_unique<State>(std::move(settings), threads, path)) {}
Compiler::~Compiler() = default;
Compiler::Compiler(Compiler&&) noexcept = default;
Compiler& Compiler::operator=(Compiler&&) noexcept = default;

Result<CompiledFrame> Compiler::frame(const Stage& stage, std::stop_token stop, FrameImages recycled, ClipMap* clips) {
  CompiledFrame out;
  state_->arena.execute([&] { out = state_->frame(stage, stop, std::move(recycled), clips); });
  if (stop.stop_requested()) return Fault{"compile.cancelled", "", "compiling was cancelled", ""};
  return out;
}

}  // namespace focalstage
