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

/// Frames, and what the shape of the images says of the projector.
int read_shape(Hdf5In& in, const std::string& group, ShowProjector& projector) {
  const std::string name = group + "/images";
  const auto shape = in.open_chunked(name.c_str(), {Hdf5In::any, Hdf5In::any, Hdf5In::any, Hdf5In::any});
  if (!in.ok()) return 0;
  const bool small = std::all_of(shape.begin(), shape.end(), [](std::size_t extent) {
    return extent <= static_cast<std::size_t>(std::numeric_limits<int>::max());
  });
  if (!small) return in.refuse(name, "its shape is out of range"), 0;
  projector.images.resize(std::min<std::size_t>(shape[1], 1u << 16));
  projector.height_px = static_cast<int>(shape[2]);
  projector.width_px = static_cast<int>(shape[3]);
  projector.channels = shape.size() == 5 ? 3 : 1;
  return static_cast<int>(shape[0]);
}

void read_image_table(Hdf5In& in, const std::string& group, std::vector<ImageSpec>& images) {
  const std::size_t count = images.size();
  const auto eye = in.numbers<std::uint8_t>((group + "/image/eye").c_str(), {count});
  const auto kind = in.numbers<std::uint8_t>((group + "/image/kind").c_str(), {count});
  const auto power_d = in.numbers<double>((group + "/image/power_d").c_str(), {count});
  const auto slice = in.numbers<std::int32_t>((group + "/image/slice").c_str(), {count});
  if (!in.ok()) return;
  for (std::size_t i = 0; i < count; ++i)
    images[i] = {static_cast<ImageEye>(eye[i]), static_cast<ImageKind>(kind[i]), power_d[i], slice[i]};
}

std::vector<Slot> read_slots(Hdf5In& in, const std::string& group) {
  std::vector<Slot> slots;
  const auto image = in.numbers<std::int32_t>((group + "/slot/image").c_str(), {Hdf5In::any});
  const std::size_t count = image.size();
  const auto eye = in.numbers<std::uint8_t>((group + "/slot/eye").c_str(), {count});
  const auto start_s = in.numbers<double>((group + "/slot/start_s").c_str(), {count});
  const auto exposure_s = in.numbers<double>((group + "/slot/exposure_s").c_str(), {count});
  const auto trigger_s = in.numbers<double>((group + "/slot/trigger_s").c_str(), {count});
  const auto power_d = in.numbers<double>((group + "/slot/power_d").c_str(), {count});
  const auto smear_d = in.numbers<double>((group + "/slot/smear_d").c_str(), {count});
  if (!in.ok()) return slots;
  for (std::size_t i = 0; i < count; ++i) {
    slots.push_back(
        {image[i], static_cast<Side>(eye[i]), start_s[i], exposure_s[i], trigger_s[i], power_d[i], smear_d[i]});
  }
  return slots;
}

int read_projector(Hdf5In& in, std::size_t i, ShowProjector& projector) {
  const std::string group = projector_group(i);
  const int frames = read_shape(in, group, projector);
  read_image_table(in, group, projector.images);
  projector.slots = read_slots(in, group);
  return frames;
}

/// How many groups /projector has; they are numbered from 0.
std::size_t count_projectors(Hdf5In& in) {
  constexpr std::size_t most = 64;
  const std::vector<std::string> names = in.names("/projector");
  if (names.size() > most) in.refuse("/projector", "it holds more than 64 projectors");
  for (std::size_t i = 0; in.ok() && i < names.size(); ++i) {
    if (std::find(names.begin(), names.end(), std::to_string(i)) == names.end())
      in.refuse(projector_group(i), "it is missing");
  }
  return in.ok() ? std::max<std::size_t>(names.size(), 1) : 1;
}

void read_projectors(Hdf5In& in, ShowHeader& header) {
  ShowProjector first;
  header.frames = read_projector(in, 0, first);
  header.width_px = first.width_px;
  header.height_px = first.height_px;
  header.channels = first.channels;
  header.images = std::move(first.images);
  header.schedule.slots = std::move(first.slots);
  const std::size_t count = count_projectors(in);
  for (std::size_t i = 1; in.ok() && i < count; ++i) {
    ShowProjector& other = header.others.emplace_back();
    other.frames_per_second = in.attribute<double>(projector_group(i).c_str(), "frames_per_second");
    if (read_projector(in, i, other) != header.frames && in.ok())
      in.refuse(projector_group(i) + "/images", "it has not the frames of /projector/0");
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
  read_projectors(in, header);
  read_rig(in, header.schedule);
  read_poses(in, header);
  read_cues(in, header);
  return header;
}

}  // namespace focalstage
