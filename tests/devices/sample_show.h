#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "devices/player/frame_cache.h"
#include "devices/player/player.h"

namespace focalstage::sample {

/// Frames whose every byte says which frame and image it is: 16 * frame + image + 1, plus `base`.
class CountedFrames : public FrameSource {
 public:
  explicit CountedFrames(std::size_t images, int base = 0) : images_(images), base_(base) {}

  Result<FrameImages> frame(int frame) override {
    FrameImages images{images_, 8, 4, 1, {}};
    for (std::size_t i = 0; i < images_; ++i) {
      images.codes.insert(images.codes.end(), images.bytes_per_image(),
                          static_cast<std::uint8_t>(base_ + 16 * frame + static_cast<int>(i) + 1));
    }
    return images;
  }

 private:
  std::size_t images_;
  int base_;
};

/// A show of `frames` frames at 60 Hz with two left and two right exposures; drive and shutters plain.
inline ShowHeader header(int frames, double rate_hz = 60.0) {
  ShowHeader show;
  show.frames = frames;
  show.rate_hz = rate_hz;
  show.width_px = 8;
  show.height_px = 4;
  show.images.resize(4);
  Schedule& schedule = show.schedule;
  schedule.period_s = 1.0 / 60.0;
  for (int i = 0; i < 4; ++i) {
    Slot slot;
    slot.image = i;
    slot.eye = i < 2 ? Side::left : Side::right;
    slot.start_s = 0.003 + 0.0035 * i;
    slot.exposure_s = 0.0005;
    slot.trigger_s = slot.start_s - 0.00015;
    schedule.slots.push_back(slot);
  }
  for (const Side eye : both_sides) {
    schedule.lens_power_d[eye].assign(16, 1.0);
    schedule.lens_drive_a[eye].assign(16, 0.025);
  }
  schedule.shutter.left = {schedule.period_s - 0.0015, 0.5 * schedule.period_s - 0.0015};
  schedule.shutter.right = {0.5 * schedule.period_s - 0.0015, schedule.period_s - 0.0015};
  show.poses.resize(static_cast<std::size_t>(frames));
  return show;
}

inline std::shared_ptr<LoadedShow> loaded(ShowHeader header, std::unique_ptr<FrameSource> source,
                                          std::string name = "a") {
  auto show = std::make_shared<LoadedShow>();
  show->sha256 = std::move(name);
  show->plan = *sweep_plan(header, 8);
  show->frames = std::make_unique<FrameCache>(std::move(source), header.frames, 128);
  show->header = std::move(header);
  return show;
}

inline std::shared_ptr<LoadedShow> counted(int frames, int base = 0, double rate_hz = 60.0) {
  return loaded(header(frames, rate_hz), std::make_unique<CountedFrames>(4, base), base == 0 ? "a" : "b");
}

}  // namespace focalstage::sample
