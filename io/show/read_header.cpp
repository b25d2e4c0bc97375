#include "io/show/read_header.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "io/files/digest.h"

namespace focalstage {
namespace {

constexpr std::int32_t show_version = 1;

void read_root(Hdf5In& in, ShowHeader& header) {
  if (in.text_attribute("/", "format") != "focalstage-show") in.refuse("/ attribute format", "it is not a show's");
  if (in.attribute<std::int32_t>("/", "version") != show_version)
    in.refuse("/ attribute version", "this program reads version 1");
  header.frequency_hz = in.attribute<double>("/", "frequency_hz");
  header.frames_per_second = in.attribute<double>("/", "frames_per_second");
  header.rate_hz = in.attribute<double>("/", "rate_hz");
  header.first_frame = in.attribute<std::int32_t>("/", "first_frame");
  header.compiler = in.text_attribute("/", "compiler");
  header.project_text = in.text("/project");
  if (in.text_attribute("/", "project_sha256") != hex(sha256_of(header.project_text)))
    in.refuse("/project", "its hash is not project_sha256");
}

void read_assets(Hdf5In& in, ShowHeader& header) {
  for (const std::string& sha256 : in.names("/asset")) {
    const std::string name = "/asset/" + sha256;
    const std::vector<std::uint8_t> bytes = in.numbers<std::uint8_t>(name.c_str(), {Hdf5In::any});
    const auto* first = reinterpret_cast<const std::byte*>(bytes.data());
    AssetFile asset{in.text_attribute(name.c_str(), "path"), sha256, SharedBytes(first, first + bytes.size())};
    if (in.ok() && hex(sha256_of(asset.bytes)) != sha256) in.refuse(name, "its bytes have another hash");
    std::vector<std::string> paths{asset.path};
    if (in.has_attribute(name.c_str(), "paths")) paths = in.texts_attribute(name.c_str(), "paths");
    for (const std::string& path : paths) {
      asset.path = path;
      header.assets.push_back(asset);
    }
  }
  std::sort(header.assets.begin(), header.assets.end(),
            [](const AssetFile& a, const AssetFile& b) { return a.path < b.path; });
}

void read_shape(Hdf5In& in, ShowHeader& header) {
  const auto shape = in.open_chunked("/projector/0/images", {Hdf5In::any, Hdf5In::any, Hdf5In::any, Hdf5In::any});
  if (!in.ok()) return;
  const bool small = std::all_of(shape.begin(), shape.end(), [](std::size_t extent) {
    return extent <= static_cast<std::size_t>(std::numeric_limits<int>::max());
  });
  if (!small) return in.refuse("/projector/0/images", "its shape is out of range");
  header.frames = static_cast<int>(shape[0]);
  header.images.resize(std::min<std::size_t>(shape[1], 1u << 16));
  header.height_px = static_cast<int>(shape[2]);
  header.width_px = static_cast<int>(shape[3]);
  header.channels = shape.size() == 5 ? 3 : 1;
}

void read_image_table(Hdf5In& in, ShowHeader& header) {
  const std::size_t count = header.images.size();
  const auto eye = in.numbers<std::uint8_t>("/projector/0/image/eye", {count});
  const auto kind = in.numbers<std::uint8_t>("/projector/0/image/kind", {count});
  const auto power_d = in.numbers<double>("/projector/0/image/power_d", {count});
  const auto slice = in.numbers<std::int32_t>("/projector/0/image/slice", {count});
  if (!in.ok()) return;
  for (std::size_t i = 0; i < count; ++i)
    header.images[i] = {static_cast<ImageEye>(eye[i]), static_cast<ImageKind>(kind[i]), power_d[i], slice[i]};
}

void read_slots(Hdf5In& in, Schedule& schedule) {
  const auto image = in.numbers<std::int32_t>("/projector/0/slot/image", {Hdf5In::any});
  const std::size_t count = image.size();
  const auto eye = in.numbers<std::uint8_t>("/projector/0/slot/eye", {count});
  const auto start_s = in.numbers<double>("/projector/0/slot/start_s", {count});
  const auto exposure_s = in.numbers<double>("/projector/0/slot/exposure_s", {count});
  const auto trigger_s = in.numbers<double>("/projector/0/slot/trigger_s", {count});
  const auto power_d = in.numbers<double>("/projector/0/slot/power_d", {count});
  const auto smear_d = in.numbers<double>("/projector/0/slot/smear_d", {count});
  if (!in.ok()) return;
  for (std::size_t i = 0; i < count; ++i) {
    schedule.slots.push_back(
        {image[i], static_cast<Side>(eye[i]), start_s[i], exposure_s[i], trigger_s[i], power_d[i], smear_d[i]});
  }
}

PerEye<std::vector<double>> two_rows(const std::vector<double>& numbers) {
  const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
  return {{numbers.begin(), middle}, {middle, numbers.end()}};
}

ShutterTimes read_shutter(Hdf5In& in, const char* name) {
  const std::vector<double> times = in.numbers<double>(name, {2});
  return in.ok() ? ShutterTimes{times[0], times[1]} : ShutterTimes{};
}

void read_rig(Hdf5In& in, Schedule& schedule) {
  schedule.period_s = in.attribute<double>("/lens", "period_s");
  const auto power_d = in.numbers<double>("/lens/power_d", {2, Hdf5In::any});
  const auto drive_a = in.numbers<double>("/lens/drive_a", {2, power_d.size() / 2});
  schedule.lens_power_d = two_rows(power_d);
  schedule.lens_drive_a = two_rows(drive_a);
  schedule.shutter.left = read_shutter(in, "/shutter/left_s");
  schedule.shutter.right = read_shutter(in, "/shutter/right_s");
}

/// Row `row` of a table of seven columns.
PoseRow row_of(const std::vector<double>& numbers, std::size_t row) {
  PoseRow out{};
  std::copy_n(numbers.begin() + static_cast<std::ptrdiff_t>(7 * row), 7, out.begin());
  return out;
}

void read_poses(Hdf5In& in, ShowHeader& header) {
  const std::size_t frames = static_cast<std::size_t>(header.frames);
  const auto viewer = in.numbers<double>("/pose/viewer", {frames, 7});
  const auto surfaces = in.numbers<double>("/pose/surfaces", {frames, Hdf5In::any, 7});
  const auto objects = in.numbers<double>("/pose/objects", {frames, Hdf5In::any, 7});
  if (!in.ok() || frames == 0) return;
  const std::size_t surface_count = surfaces.size() / 7 / frames;
  const std::size_t object_count = objects.size() / 7 / frames;
  header.poses.resize(frames);
  for (std::size_t k = 0; k < frames; ++k) {
    header.poses[k].viewer = row_of(viewer, k);
    for (std::size_t i = 0; i < surface_count; ++i)
      header.poses[k].surfaces.push_back(row_of(surfaces, k * surface_count + i));
    for (std::size_t i = 0; i < object_count; ++i)
      header.poses[k].objects.push_back(row_of(objects, k * object_count + i));
  }
}

void read_cues(Hdf5In& in, ShowHeader& header) {
  const std::vector<std::string> name = in.texts("/cue/name");
  const std::vector<std::int32_t> frame = in.numbers<std::int32_t>("/cue/frame", {name.size()});
  if (!in.ok()) return;
  for (std::size_t i = 0; i < name.size(); ++i) header.cues.push_back({name[i], frame[i]});
}

}  // namespace

ShowHeader read_header(Hdf5In& in) {
  ShowHeader header;
  read_root(in, header);
  read_assets(in, header);
  read_shape(in, header);
  read_image_table(in, header);
  read_slots(in, header.schedule);
  read_rig(in, header.schedule);
  read_poses(in, header);
  read_cues(in, header);
  return header;
}

namespace {

/// Shows of other assignments than `optimal` have none of it.
void read_optimal(Hdf5In& in, std::vector<FrameMeasure>& measures) {
  const std::vector<std::string> names = in.names("/measure");
  if (std::find(names.begin(), names.end(), "optimal_tiles") == names.end()) return;
  const Hdf5In::Shape shape{measures.size(), 2};
  const auto tiles = in.numbers<std::uint64_t>("/measure/optimal_tiles", shape);
  const auto accepted = in.numbers<std::uint64_t>("/measure/optimal_accepted_tiles", shape);
  const auto left = in.numbers<std::uint64_t>("/measure/optimal_left_tiles", shape);
  const auto values = in.numbers<std::uint64_t>("/measure/optimal_values", shape);
  const auto linear = in.numbers<double>("/measure/optimal_linear_error", shape);
  const auto optimal = in.numbers<double>("/measure/optimal_error", shape);
  for (const auto* numbers : {&linear, &optimal}) {
    const bool sums =
        std::all_of(numbers->begin(), numbers->end(), [](double d) { return std::isfinite(d) && d >= 0.0; });
    if (!sums) in.refuse("/measure", "it is no sum of squares");
  }
  if (!in.ok()) return;
  for (std::size_t k = 0; k < measures.size(); ++k) {
    for (const Side side : both_sides) {
      const std::size_t at = 2 * k + index_of(side);
      measures[k].optimal[side] = {tiles[at], accepted[at], left[at], values[at], linear[at], optimal[at]};
    }
  }
}

/// Shows without compensation have none of it.
void read_asked(Hdf5In& in, std::size_t surfaces, std::vector<FrameMeasure>& measures) {
  const std::vector<std::string> names = in.names("/measure");
  if (std::find(names.begin(), names.end(), "surface_lit") == names.end()) return;
  const Hdf5In::Shape shape{measures.size(), surfaces}, by_channel{measures.size(), surfaces, 3};
  const auto lit = in.numbers<std::uint64_t>("/measure/surface_lit", shape);
  const auto too_bright = in.numbers<std::uint64_t>("/measure/surface_too_bright", shape);
  const auto too_dark = in.numbers<std::uint64_t>("/measure/surface_too_dark", shape);
  const auto bright = in.numbers<std::uint64_t>("/measure/surface_bright_in", by_channel);
  const auto dark = in.numbers<std::uint64_t>("/measure/surface_dark_in", by_channel);
  const auto most = in.numbers<double>("/measure/surface_most", shape);
  const auto least = in.numbers<double>("/measure/surface_least", shape);
  for (const auto* numbers : {&most, &least}) {
    const bool finite = std::all_of(numbers->begin(), numbers->end(), [](double d) { return std::isfinite(d); });
    if (!finite) in.refuse("/measure", "it is not finite");
  }
  if (!in.ok()) return;
  for (std::size_t k = 0; k < measures.size(); ++k) {
    for (std::size_t i = 0; i < surfaces; ++i) {
      const std::size_t at = k * surfaces + i;
      measures[k].surfaces.push_back({i,
                                      lit[at],
                                      too_bright[at],
                                      too_dark[at],
                                      {bright[3 * at], bright[3 * at + 1], bright[3 * at + 2]},
                                      {dark[3 * at], dark[3 * at + 1], dark[3 * at + 2]},
                                      most[at],
                                      least[at]});
    }
  }
}

}  // namespace

std::vector<FrameMeasure> read_measures(Hdf5In& in, const ShowHeader& header) {
  const std::size_t frames = static_cast<std::size_t>(header.frames);
  const std::size_t objects = header.poses.at(0).objects.size();
  const auto lit = in.numbers<std::uint64_t>("/measure/lit_pixels", {frames});
  const auto clipped = in.numbers<std::uint64_t>("/measure/clipped_pixels", {frames});
  const auto surface = in.numbers<std::uint64_t>("/measure/surface_pixels", {frames});
  const auto defocused = in.numbers<std::uint64_t>("/measure/defocused_pixels", {frames});
  const auto worst_defocus_d = in.numbers<double>("/measure/worst_defocus_d", {frames});
  const auto samples = in.numbers<std::uint64_t>("/measure/object_samples", {frames, objects});
  const auto beyond = in.numbers<std::uint64_t>("/measure/object_beyond", {frames, objects});
  const auto worst_beyond_d = in.numbers<double>("/measure/object_worst_beyond_d", {frames, objects});
  const auto worst_below_d = in.numbers<double>("/measure/object_worst_below_d", {frames, objects});
  const auto worst_above_d = in.numbers<double>("/measure/object_worst_above_d", {frames, objects});
  for (const auto* numbers : {&worst_defocus_d, &worst_beyond_d, &worst_below_d, &worst_above_d}) {
    const bool finite = std::all_of(numbers->begin(), numbers->end(), [](double d) { return std::isfinite(d); });
    if (!finite) in.refuse("/measure", "it is not finite");
  }
  std::vector<FrameMeasure> measures;
  if (!in.ok()) return measures;
  for (std::size_t k = 0; k < frames; ++k) {
    FrameMeasure measure{lit[k], clipped[k], surface[k], defocused[k], worst_defocus_d[k], {}, {}, {}};
    for (std::size_t i = 0; i < objects; ++i) {
      const std::size_t at = k * objects + i;
      measure.objects.push_back({i, samples[at], beyond[at], worst_beyond_d[at], worst_below_d[at], worst_above_d[at]});
    }
    measures.push_back(std::move(measure));
  }
  read_optimal(in, measures);
  read_asked(in, header.poses.at(0).surfaces.size(), measures);
  return measures;
}

}  // namespace focalstage
