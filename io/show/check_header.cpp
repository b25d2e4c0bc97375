#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "io/show/show.h"

namespace focalstage {
namespace {

constexpr int max_side_px = 16384;
constexpr std::size_t max_images = 4096;

/// Gathers the first thing that is wrong; later ones are not looked at.
struct Check {
  std::string source;
  Status status;

  void demand(bool holds, std::string_view dataset, const std::string& message) {
    if (!status.ok() || holds) return;
    status = Fault{"show.invalid", source + ": " + std::string(dataset), message, "compile the show again"};
  }
};

bool finite(double value) { return std::isfinite(value); }
bool positive(double value) { return std::isfinite(value) && value > 0.0; }
bool all_finite(const std::vector<double>& values) { return std::all_of(values.begin(), values.end(), finite); }
bool is_text(const std::string& text) { return text.find('\0') == std::string::npos; }

bool is_sha256(const std::string& text) {
  const auto hex_digit = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
  return text.size() == 64 && std::all_of(text.begin(), text.end(), hex_digit);
}

void check_scalars(const ShowHeader& header, Check& check) {
  check.demand(is_text(header.compiler), "/ attribute compiler", "it holds a NUL character");
  check.demand(!header.project_text.empty() && is_text(header.project_text), "/project", "it is empty or holds a NUL");
  check.demand(positive(header.frequency_hz), "/ attribute frequency_hz", "it must be above 0");
  check.demand(positive(header.frames_per_second), "/ attribute frames_per_second", "it must be above 0");
  check.demand(positive(header.rate_hz), "/ attribute rate_hz", "it must be above 0");
  check.demand(header.first_frame >= 0, "/ attribute first_frame", "it must not be below 0");
}

void check_assets(const ShowHeader& header, Check& check) {
  const std::string* last = nullptr;
  for (const AssetFile& asset : header.assets) {
    check.demand(is_sha256(asset.sha256), "/asset/" + asset.sha256, "its name is no SHA-256");
    check.demand(!asset.path.empty() && is_text(asset.path), "/asset/" + asset.sha256, "its path is no file name");
    check.demand(!last || *last < asset.path, "/asset/" + asset.sha256, "assets are not in the order of their paths");
    last = &asset.path;
  }
}

void check_images(const ShowProjector& projector, int frames, const std::string& group, Check& check) {
  const bool sized = projector.width_px >= 1 && projector.width_px <= max_side_px && projector.height_px >= 1 &&
                     projector.height_px <= max_side_px && (projector.channels == 1 || projector.channels == 3);
  check.demand(sized && frames >= 1 && projector.images.size() <= max_images, group + "/images",
               "its shape is out of range");
  for (const ImageSpec& image : projector.images) {
    const int eye = static_cast<int>(image.eye);
    const int kind = static_cast<int>(image.kind);
    check.demand(eye >= 0 && eye <= 2, group + "/image/eye", "it must be 0, 1 or 2");
    check.demand(kind >= 0 && kind <= 2, group + "/image/kind", "it must be 0, 1 or 2");
    check.demand(finite(image.power_d), group + "/image/power_d", "it is not finite");
    check.demand(image.slice >= -1, group + "/image/slice", "it must be -1 or an index");
  }
}

void check_slots(const ShowProjector& projector, const std::string& group, Check& check) {
  double last_start_s = -INFINITY;
  for (const Slot& slot : projector.slots) {
    const bool known = slot.image >= 0 && static_cast<std::size_t>(slot.image) < projector.images.size();
    check.demand(known, group + "/slot/image", "it names an image that is not there");
    if (!known) return;
    const ImageEye eye = projector.images[static_cast<std::size_t>(slot.image)].eye;
    check.demand(slot.eye == Side::left || slot.eye == Side::right, group + "/slot/eye", "it must be 0 or 1");
    check.demand(eye == ImageEye::both || static_cast<int>(eye) == static_cast<int>(slot.eye), group + "/slot/eye",
                 "it shows the other eye's image");
    check.demand(finite(slot.start_s) && slot.start_s >= last_start_s, group + "/slot/start_s",
                 "exposures are not in time order");
    check.demand(positive(slot.exposure_s), group + "/slot/exposure_s", "it must be above 0");
    check.demand(finite(slot.trigger_s), group + "/slot/trigger_s", "it is not finite");
    check.demand(finite(slot.power_d) && finite(slot.smear_d), group + "/slot/power_d", "it is not finite");
    last_start_s = slot.start_s;
  }
}

void check_projectors(const ShowHeader& header, Check& check) {
  for (std::size_t i = 0; i < header.projectors(); ++i) {
    const ShowProjector projector = header.projector(i);
    const std::string group = projector_group(i);
    if (i > 0) {
      check.demand(positive(projector.frames_per_second), group + " attribute frames_per_second", "it must be above 0");
    }
    check_images(projector, header.frames, group, check);
    check_slots(projector, group, check);
  }
}

void check_lens(const ShowHeader& header, Check& check) {
  const Schedule& schedule = header.schedule;
  check.demand(positive(schedule.period_s), "/lens attribute period_s", "it must be above 0");
  const std::size_t samples = schedule.lens_power_d.left.size();
  for (const Side side : both_sides) {
    const ShutterTimes& shutter = schedule.shutter[side];
    check.demand(schedule.lens_power_d[side].size() == samples && all_finite(schedule.lens_power_d[side]),
                 "/lens/power_d", "it is not finite or its two rows differ in length");
    check.demand(schedule.lens_drive_a[side].size() == samples && all_finite(schedule.lens_drive_a[side]),
                 "/lens/drive_a", "it is not finite or not as long as the power");
    check.demand(finite(shutter.open_s) && finite(shutter.close_s),
                 side == Side::left ? "/shutter/left_s" : "/shutter/right_s", "it is not finite");
  }
}

bool all_finite(const PoseRow& row) { return std::all_of(row.begin(), row.end(), finite); }

bool all_finite(const std::vector<PoseRow>& rows) {
  return std::all_of(rows.begin(), rows.end(), [](const PoseRow& row) { return all_finite(row); });
}

void check_poses(const ShowHeader& header, Check& check) {
  check.demand(header.poses.size() == static_cast<std::size_t>(std::max(header.frames, 0)), "/pose/viewer",
               "it does not hold one row per frame");
  for (const FramePoses& poses : header.poses) {
    check.demand(all_finite(poses.viewer), "/pose/viewer", "it is not finite");
    check.demand(poses.surfaces.size() == header.poses[0].surfaces.size() && all_finite(poses.surfaces),
                 "/pose/surfaces", "it is not finite or not as many in every frame");
    check.demand(poses.objects.size() == header.poses[0].objects.size() && all_finite(poses.objects), "/pose/objects",
                 "it is not finite or not as many in every frame");
  }
}

void check_cues(const ShowHeader& header, Check& check) {
  for (const ShowCue& cue : header.cues) {
    check.demand(is_text(cue.name), "/cue/name", "it holds a NUL character");
    check.demand(cue.frame >= 0 && cue.frame < header.frames, "/cue/frame", "it names a frame that is not there");
  }
}

}  // namespace

Status check_header(const ShowHeader& header, const std::string& source) {
  Check check{source, {}};
  check_scalars(header, check);
  check_assets(header, check);
  check_projectors(header, check);
  check_lens(header, check);
  check_poses(header, check);
  check_cues(header, check);
  return check.status;
}

}  // namespace focalstage
