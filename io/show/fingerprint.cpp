#include "io/show/fingerprint.h"

#include <libdeflate.h>

#include <concepts>
#include <cstring>

#include "io/show/chunks.h"
#include "io/show/part.h"

namespace focalstage {
namespace {

/// Feeds values to a hash so that no two different headers feed the same bytes: numbers at a fixed width, whatever has
/// a length behind its length.
class Feed {
 public:
  template <class T>
  requires std::integral<T> || std::floating_point<T>
  void operator()(T number) {
    std::byte bytes[sizeof(T)];
    std::memcpy(bytes, &number, sizeof(T));
    sum_.add(std::span<const std::byte>(bytes));
  }

  void operator()(std::string_view text) {
    (*this)(static_cast<std::uint64_t>(text.size()));
    sum_.add(text);
  }

  template <class T>
  void operator()(const std::vector<T>& items) {
    (*this)(static_cast<std::uint64_t>(items.size()));
    for (const T& item : items) (*this)(item);
  }

  void operator()(const PoseRow& row) {
    for (const double number : row) (*this)(number);
  }

  void operator()(const AssetFile& asset) {
    (*this)(std::string_view(asset.path));
    (*this)(std::string_view(asset.sha256));
  }

  void operator()(const ImageSpec& image) {
    (*this)(static_cast<std::int32_t>(image.eye));
    (*this)(static_cast<std::int32_t>(image.kind));
    (*this)(image.power_d);
    (*this)(image.slice);
  }

  void operator()(const Slot& slot) {
    (*this)(slot.image);
    (*this)(static_cast<std::int32_t>(slot.eye));
    for (const double number : {slot.start_s, slot.exposure_s, slot.trigger_s, slot.power_d, slot.smear_d})
      (*this)(number);
  }

  void operator()(const Schedule& schedule) {
    (*this)(schedule.period_s);
    (*this)(schedule.slots);
    for (const Side side : both_sides) {
      (*this)(schedule.lens_power_d[side]);
      (*this)(schedule.lens_drive_a[side]);
      (*this)(schedule.shutter[side].open_s);
      (*this)(schedule.shutter[side].close_s);
    }
  }

  void operator()(const FramePoses& poses) {
    (*this)(poses.viewer);
    (*this)(poses.surfaces);
    (*this)(poses.objects);
  }

  void operator()(const ShowProjector& projector) {
    (*this)(projector.frames_per_second);
    for (const int number : {projector.width_px, projector.height_px, projector.channels}) (*this)(number);
    (*this)(projector.images);
    (*this)(projector.slots);
  }

  void operator()(const ShowCue& cue) {
    (*this)(std::string_view(cue.name));
    (*this)(cue.frame);
  }

  Sha256Value value() { return sum_.value(); }

 private:
  Sha256 sum_;
};

}  // namespace

Sha256Value fingerprint_of(const ShowHeader& header) {
  Feed feed;
  feed(std::string_view(LIBDEFLATE_VERSION_STRING));
  feed(compression_level);
  feed(chunk_rows);
  feed(chunk_columns);
  feed(part_version);
  feed(std::string_view(header.compiler));
  feed(std::string_view(header.project_text));
  feed(header.assets);
  for (const double number : {header.frequency_hz, header.frames_per_second, header.rate_hz}) feed(number);
  for (const int number : {header.first_frame, header.frames, header.width_px, header.height_px, header.channels})
    feed(number);
  feed(header.images);
  feed(header.schedule);
  feed(header.poses);
  feed(header.cues);
  if (!header.others.empty()) feed(header.others);
  return feed.value();
}

}  // namespace focalstage
