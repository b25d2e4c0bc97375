#include "io/show/write_header.h"

#include <algorithm>
#include <map>
#include <span>
#include <string>

#include "io/files/digest.h"

namespace focalstage {
namespace {

constexpr std::int32_t show_version = 1;

/// The numbers `get` finds in each of `items`.
template <class T, class Items, class Get>
std::vector<T> column(const Items& items, Get get) {
  std::vector<T> out;
  out.reserve(items.size());
  for (const auto& item : items) out.push_back(static_cast<T>(get(item)));
  return out;
}

void write_root(Hdf5Out& out, const ShowHeader& header) {
  out.attribute("/", "format", std::string("focalstage-show"));
  out.attribute("/", "version", show_version);
  out.attribute("/", "frequency_hz", header.frequency_hz);
  out.attribute("/", "frames_per_second", header.frames_per_second);
  out.attribute("/", "rate_hz", header.rate_hz);
  out.attribute("/", "first_frame", static_cast<std::int32_t>(header.first_frame));
  out.attribute("/", "project_sha256", hex(sha256_of(header.project_text)));
  out.attribute("/", "compiler", header.compiler);
  out.dataset("/project", header.project_text);
}

/// One dataset per content; `path` is the first of its names, `paths` lists all where there is more than one.
void write_assets(Hdf5Out& out, const ShowHeader& header) {
  out.group("/asset");
  std::map<std::string, std::vector<const AssetFile*>> by_content;
  for (const AssetFile& asset : header.assets) by_content[asset.sha256].push_back(&asset);
  for (const auto& [sha256, files] : by_content) {
    const std::string name = "/asset/" + sha256;
    const auto& bytes = files.front()->bytes;
    const std::span numbers(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    out.dataset(name.c_str(), {bytes.size()}, numbers);
    out.attribute(name.c_str(), "path", files.front()->path);
    if (files.size() < 2) continue;
    std::vector<std::string> paths;
    for (const AssetFile* file : files) paths.push_back(file->path);
    out.attribute(name.c_str(), "paths", paths);
  }
}

void write_image_table(Hdf5Out& out, const ShowHeader& header) {
  const auto& images = header.images;
  const std::size_t count = images.size();
  out.group("/projector/0/image");
  out.dataset("/projector/0/image/eye", {count}, column<std::uint8_t>(images, [](auto& i) { return i.eye; }));
  out.dataset("/projector/0/image/kind", {count}, column<std::uint8_t>(images, [](auto& i) { return i.kind; }));
  out.dataset("/projector/0/image/power_d", {count}, column<double>(images, [](auto& i) { return i.power_d; }));
  out.dataset("/projector/0/image/slice", {count}, column<std::int32_t>(images, [](auto& i) { return i.slice; }));
}

void write_slots(Hdf5Out& out, const ShowHeader& header) {
  const auto& slots = header.schedule.slots;
  const std::size_t count = slots.size();
  out.group("/projector/0/slot");
  out.dataset("/projector/0/slot/image", {count}, column<std::int32_t>(slots, [](auto& s) { return s.image; }));
  out.dataset("/projector/0/slot/eye", {count}, column<std::uint8_t>(slots, [](auto& s) { return s.eye; }));
  out.dataset("/projector/0/slot/start_s", {count}, column<double>(slots, [](auto& s) { return s.start_s; }));
  out.dataset("/projector/0/slot/exposure_s", {count}, column<double>(slots, [](auto& s) { return s.exposure_s; }));
  out.dataset("/projector/0/slot/trigger_s", {count}, column<double>(slots, [](auto& s) { return s.trigger_s; }));
  out.dataset("/projector/0/slot/power_d", {count}, column<double>(slots, [](auto& s) { return s.power_d; }));
  out.dataset("/projector/0/slot/smear_d", {count}, column<double>(slots, [](auto& s) { return s.smear_d; }));
}

std::vector<double> both_rows(const PerEye<std::vector<double>>& rows) {
  std::vector<double> out = rows.left;
  out.insert(out.end(), rows.right.begin(), rows.right.end());
  return out;
}

void write_rig(Hdf5Out& out, const Schedule& schedule) {
  const std::size_t samples = schedule.lens_power_d.left.size();
  const auto times = [](const ShutterTimes& shutter) { return std::vector<double>{shutter.open_s, shutter.close_s}; };
  out.group("/lens");
  out.attribute("/lens", "period_s", schedule.period_s);
  out.dataset("/lens/power_d", {2, samples}, both_rows(schedule.lens_power_d));
  out.dataset("/lens/drive_a", {2, samples}, both_rows(schedule.lens_drive_a));
  out.group("/shutter");
  out.dataset("/shutter/left_s", {2}, times(schedule.shutter.left));
  out.dataset("/shutter/right_s", {2}, times(schedule.shutter.right));
}

void write_poses(Hdf5Out& out, const ShowHeader& header) {
  std::vector<double> viewer, surfaces, objects;
  const auto append = [](std::vector<double>& to, const PoseRow& row) { to.insert(to.end(), row.begin(), row.end()); };
  for (const FramePoses& poses : header.poses) {
    append(viewer, poses.viewer);
    for (const PoseRow& row : poses.surfaces) append(surfaces, row);
    for (const PoseRow& row : poses.objects) append(objects, row);
  }
  const std::size_t frames = header.poses.size();
  out.group("/pose");
  out.dataset("/pose/viewer", {frames, 7}, viewer);
  out.dataset("/pose/surfaces", {frames, header.poses[0].surfaces.size(), 7}, surfaces);
  out.dataset("/pose/objects", {frames, header.poses[0].objects.size(), 7}, objects);
}

void write_cues(Hdf5Out& out, const ShowHeader& header) {
  out.group("/cue");
  out.dataset("/cue/name", column<std::string>(header.cues, [](auto& cue) { return cue.name; }));
  out.dataset("/cue/frame", {header.cues.size()},
              column<std::int32_t>(header.cues, [](auto& cue) { return cue.frame; }));
}

/// Of the assignment `optimal` alone; other shows have no such datasets.
void write_optimal(Hdf5Out& out, const std::vector<FrameMeasure>& measures) {
  std::vector<OptimalMeasure> eyes;
  for (const FrameMeasure& measure : measures) {
    eyes.push_back(measure.optimal.left);
    eyes.push_back(measure.optimal.right);
  }
  if (std::all_of(eyes.begin(), eyes.end(), [](auto& eye) { return eye == OptimalMeasure{}; })) return;
  const auto counts = [&](const char* name, auto get) {
    out.dataset(name, {measures.size(), 2}, column<std::uint64_t>(eyes, get));
  };
  const auto sums = [&](const char* name, auto get) {
    out.dataset(name, {measures.size(), 2}, column<double>(eyes, get));
  };
  counts("/measure/optimal_tiles", [](auto& eye) { return eye.tiles; });
  counts("/measure/optimal_accepted_tiles", [](auto& eye) { return eye.accepted_tiles; });
  counts("/measure/optimal_left_tiles", [](auto& eye) { return eye.left_tiles; });
  counts("/measure/optimal_values", [](auto& eye) { return eye.values; });
  sums("/measure/optimal_linear_error", [](auto& eye) { return eye.linear_error; });
  sums("/measure/optimal_error", [](auto& eye) { return eye.optimal_error; });
}

bool is_asked(const SurfaceAsked& surface) { return surface.lit_pixels > 0; }

/// With compensation alone; other shows have no such datasets.
void write_asked(Hdf5Out& out, const std::vector<FrameMeasure>& measures) {
  std::vector<SurfaceAsked> rows;
  for (const FrameMeasure& measure : measures)
    rows.insert(rows.end(), measure.surfaces.begin(), measure.surfaces.end());
  if (std::none_of(rows.begin(), rows.end(), is_asked)) return;
  const std::size_t frames = measures.size(), surfaces = measures[0].surfaces.size();
  const auto counts = [&](const char* name, auto get) {
    out.dataset(name, {frames, surfaces}, column<std::uint64_t>(rows, get));
  };
  counts("/measure/surface_lit", [](auto& s) { return s.lit_pixels; });
  counts("/measure/surface_too_bright", [](auto& s) { return s.too_bright; });
  counts("/measure/surface_too_dark", [](auto& s) { return s.too_dark; });
  std::vector<std::uint64_t> bright, dark;
  for (const SurfaceAsked& row : rows) {
    bright.insert(bright.end(), row.bright_in.begin(), row.bright_in.end());
    dark.insert(dark.end(), row.dark_in.begin(), row.dark_in.end());
  }
  out.dataset("/measure/surface_bright_in", {frames, surfaces, 3}, bright);
  out.dataset("/measure/surface_dark_in", {frames, surfaces, 3}, dark);
  out.dataset("/measure/surface_most", {frames, surfaces}, column<double>(rows, [](auto& s) { return s.most; }));
  out.dataset("/measure/surface_least", {frames, surfaces}, column<double>(rows, [](auto& s) { return s.least; }));
}

void write_measures(Hdf5Out& out, const std::vector<FrameMeasure>& measures) {
  const std::size_t frames = measures.size();
  const std::size_t objects = measures[0].objects.size();
  std::vector<ObjectMeasure> rows;
  for (const FrameMeasure& measure : measures) rows.insert(rows.end(), measure.objects.begin(), measure.objects.end());
  const auto counts = [&](auto get) { return column<std::uint64_t>(measures, get); };
  out.group("/measure");
  out.dataset("/measure/lit_pixels", {frames}, counts([](auto& m) { return m.lit_pixels; }));
  out.dataset("/measure/clipped_pixels", {frames}, counts([](auto& m) { return m.clipped_pixels; }));
  out.dataset("/measure/surface_pixels", {frames}, counts([](auto& m) { return m.surface_pixels; }));
  out.dataset("/measure/defocused_pixels", {frames}, counts([](auto& m) { return m.defocused_pixels; }));
  out.dataset("/measure/worst_defocus_d", {frames},
              column<double>(measures, [](auto& m) { return m.worst_defocus_d; }));
  out.dataset("/measure/object_samples", {frames, objects},
              column<std::uint64_t>(rows, [](auto& o) { return o.samples; }));
  out.dataset("/measure/object_beyond", {frames, objects},
              column<std::uint64_t>(rows, [](auto& o) { return o.beyond; }));
  out.dataset("/measure/object_worst_beyond_d", {frames, objects},
              column<double>(rows, [](auto& o) { return o.worst_beyond_d; }));
  out.dataset("/measure/object_worst_below_d", {frames, objects},
              column<double>(rows, [](auto& o) { return o.worst_below_d; }));
  out.dataset("/measure/object_worst_above_d", {frames, objects},
              column<double>(rows, [](auto& o) { return o.worst_above_d; }));
  write_optimal(out, measures);
  write_asked(out, measures);
}

}  // namespace

void write_header(Hdf5Out& out, const ShowHeader& header, const std::vector<FrameMeasure>& measures) {
  write_root(out, header);
  write_assets(out, header);
  out.group("/projector");
  out.group("/projector/0");
  write_image_table(out, header);
  write_slots(out, header);
  write_rig(out, header.schedule);
  write_poses(out, header);
  write_cues(out, header);
  write_measures(out, measures);
}

}  // namespace focalstage
