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

void write_image_table(Hdf5Out& out, const std::vector<ImageSpec>& images, const std::string& group) {
  const std::size_t count = images.size();
  const auto name = [&](const char* last) { return group + "/image" + last; };
  out.group(name("").c_str());
  out.dataset(name("/eye").c_str(), {count}, column<std::uint8_t>(images, [](auto& i) { return i.eye; }));
  out.dataset(name("/kind").c_str(), {count}, column<std::uint8_t>(images, [](auto& i) { return i.kind; }));
  out.dataset(name("/power_d").c_str(), {count}, column<double>(images, [](auto& i) { return i.power_d; }));
  out.dataset(name("/slice").c_str(), {count}, column<std::int32_t>(images, [](auto& i) { return i.slice; }));
}

void write_slots(Hdf5Out& out, const std::vector<Slot>& slots, const std::string& group) {
  const std::size_t count = slots.size();
  const auto name = [&](const char* last) { return group + "/slot" + last; };
  out.group(name("").c_str());
  out.dataset(name("/image").c_str(), {count}, column<std::int32_t>(slots, [](auto& s) { return s.image; }));
  out.dataset(name("/eye").c_str(), {count}, column<std::uint8_t>(slots, [](auto& s) { return s.eye; }));
  out.dataset(name("/start_s").c_str(), {count}, column<double>(slots, [](auto& s) { return s.start_s; }));
  out.dataset(name("/exposure_s").c_str(), {count}, column<double>(slots, [](auto& s) { return s.exposure_s; }));
  out.dataset(name("/trigger_s").c_str(), {count}, column<double>(slots, [](auto& s) { return s.trigger_s; }));
  out.dataset(name("/power_d").c_str(), {count}, column<double>(slots, [](auto& s) { return s.power_d; }));
  out.dataset(name("/smear_d").c_str(), {count}, column<double>(slots, [](auto& s) { return s.smear_d; }));
}

/// The rate of the first is the show's.
void write_projector(Hdf5Out& out, const ShowProjector& projector, std::size_t i) {
  const std::string group = projector_group(i);
  out.group(group.c_str());
  if (i > 0) out.attribute(group.c_str(), "frames_per_second", projector.frames_per_second);
  write_image_table(out, projector.images, group);
  write_slots(out, projector.slots, group);
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
void write_optimal(Hdf5Out& out, const std::vector<FrameMeasure>& measures, const std::string& group) {
  std::vector<OptimalMeasure> eyes;
  for (const FrameMeasure& measure : measures) {
    eyes.push_back(measure.optimal.left);
    eyes.push_back(measure.optimal.right);
  }
  if (std::all_of(eyes.begin(), eyes.end(), [](auto& eye) { return eye == OptimalMeasure{}; })) return;
  const auto counts = [&](const char* name, auto get) {
    out.dataset((group + "/" + name).c_str(), {measures.size(), 2}, column<std::uint64_t>(eyes, get));
  };
  const auto sums = [&](const char* name, auto get) {
    out.dataset((group + "/" + name).c_str(), {measures.size(), 2}, column<double>(eyes, get));
  };
  counts("optimal_tiles", [](auto& eye) { return eye.tiles; });
  counts("optimal_accepted_tiles", [](auto& eye) { return eye.accepted_tiles; });
  counts("optimal_left_tiles", [](auto& eye) { return eye.left_tiles; });
  counts("optimal_values", [](auto& eye) { return eye.values; });
  sums("optimal_linear_error", [](auto& eye) { return eye.linear_error; });
  sums("optimal_error", [](auto& eye) { return eye.optimal_error; });
}

bool is_asked(const SurfaceAsked& surface) { return surface.lit_pixels > 0; }

/// With compensation alone; other shows have no such datasets.
void write_asked(Hdf5Out& out, const std::vector<FrameMeasure>& measures, const std::string& group) {
  std::vector<SurfaceAsked> rows;
  for (const FrameMeasure& measure : measures)
    rows.insert(rows.end(), measure.surfaces.begin(), measure.surfaces.end());
  if (std::none_of(rows.begin(), rows.end(), is_asked)) return;
  const std::size_t frames = measures.size(), surfaces = measures[0].surfaces.size();
  const auto counts = [&](const char* name, auto get) {
    out.dataset((group + "/" + name).c_str(), {frames, surfaces}, column<std::uint64_t>(rows, get));
  };
  counts("surface_lit", [](auto& s) { return s.lit_pixels; });
  counts("surface_too_bright", [](auto& s) { return s.too_bright; });
  counts("surface_too_dark", [](auto& s) { return s.too_dark; });
  std::vector<std::uint64_t> bright, dark;
  for (const SurfaceAsked& row : rows) {
    bright.insert(bright.end(), row.bright_in.begin(), row.bright_in.end());
    dark.insert(dark.end(), row.dark_in.begin(), row.dark_in.end());
  }
  out.dataset((group + "/surface_bright_in").c_str(), {frames, surfaces, 3}, bright);
  out.dataset((group + "/surface_dark_in").c_str(), {frames, surfaces, 3}, dark);
  out.dataset((group + "/surface_most").c_str(), {frames, surfaces},
              column<double>(rows, [](auto& s) { return s.most; }));
  out.dataset((group + "/surface_least").c_str(), {frames, surfaces},
              column<double>(rows, [](auto& s) { return s.least; }));
}

void write_measures(Hdf5Out& out, const std::vector<FrameMeasure>& measures, const std::string& group) {
  const std::size_t frames = measures.size();
  const std::size_t objects = measures[0].objects.size();
  std::vector<ObjectMeasure> rows;
  for (const FrameMeasure& measure : measures) rows.insert(rows.end(), measure.objects.begin(), measure.objects.end());
  const auto counts = [&](auto get) { return column<std::uint64_t>(measures, get); };
  out.group(group.c_str());
  out.dataset((group + "/lit_pixels").c_str(), {frames}, counts([](auto& m) { return m.lit_pixels; }));
  out.dataset((group + "/clipped_pixels").c_str(), {frames}, counts([](auto& m) { return m.clipped_pixels; }));
  out.dataset((group + "/surface_pixels").c_str(), {frames}, counts([](auto& m) { return m.surface_pixels; }));
  out.dataset((group + "/defocused_pixels").c_str(), {frames}, counts([](auto& m) { return m.defocused_pixels; }));
  out.dataset((group + "/worst_defocus_d").c_str(), {frames},
              column<double>(measures, [](auto& m) { return m.worst_defocus_d; }));
  out.dataset((group + "/object_samples").c_str(), {frames, objects},
              column<std::uint64_t>(rows, [](auto& o) { return o.samples; }));
  out.dataset((group + "/object_beyond").c_str(), {frames, objects},
              column<std::uint64_t>(rows, [](auto& o) { return o.beyond; }));
  out.dataset((group + "/object_worst_beyond_d").c_str(), {frames, objects},
              column<double>(rows, [](auto& o) { return o.worst_beyond_d; }));
  out.dataset((group + "/object_worst_below_d").c_str(), {frames, objects},
              column<double>(rows, [](auto& o) { return o.worst_below_d; }));
  out.dataset((group + "/object_worst_above_d").c_str(), {frames, objects},
              column<double>(rows, [](auto& o) { return o.worst_above_d; }));
  write_optimal(out, measures, group);
  write_asked(out, measures, group);
}

}  // namespace

void write_header(Hdf5Out& out, const ShowHeader& header,
                  const std::vector<const std::vector<FrameMeasure>*>& measures) {
  write_root(out, header);
  write_assets(out, header);
  out.group("/projector");
  write_projector(out, header.projector(0), 0);
  write_rig(out, header.schedule);
  write_poses(out, header);
  write_cues(out, header);
  write_measures(out, *measures.at(0), "/measure");
  for (std::size_t i = 1; i < header.projectors(); ++i) {
    write_projector(out, header.projector(i), i);
    write_measures(out, *measures.at(i), projector_group(i) + "/measure");
  }
}

}  // namespace focalstage
