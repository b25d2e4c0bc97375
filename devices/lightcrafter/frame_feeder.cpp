#include "devices/lightcrafter/frame_feeder.h"

#include <algorithm>
#include <string>

namespace focalstage::lightcrafter {

FrameFeeder::FrameFeeder(Display& display, std::size_t most_ahead)
    : display_(display), most_ahead_(most_ahead), thread_([this](const std::stop_token& stop) { loop(stop); }) {}

Status FrameFeeder::arm(const PackPlan& plan) {
  Result<FramePacker> packer = FramePacker::make(plan);
  if (!packer) return packer.fault();
  forget();
  const std::lock_guard lock(mutex_);
  packer_ = std::make_shared<FramePacker>(std::move(*packer));
  going_ = false;
  return {};
}

void FrameFeeder::go(bool going) {
  const std::lock_guard lock(mutex_);
  going_ = going;
  changed_.notify_all();
}

Status FrameFeeder::post(std::vector<Picture> pictures) {
  const std::lock_guard lock(mutex_);
  if (!packer_) return Fault{"projector.idle", "LightCrafter 4500", "it was not armed", "arm it first"};
  const PackPlan& plan = packer_->plan();
  const auto size = static_cast<std::size_t>(plan.width_px) * static_cast<std::size_t>(plan.height_px) *
                    static_cast<std::size_t>(plan.channels);
  const bool sized =
      std::ranges::all_of(pictures, [&](const Picture& picture) { return picture.codes.size() == size; });
  if (!pictures.empty() && (pictures.size() != static_cast<std::size_t>(plan.pictures) || !sized)) {
    return Fault{"projector.picture", "LightCrafter 4500",
                 "a period takes " + std::to_string(plan.pictures) + " pictures of " + std::to_string(size) + " codes",
                 "post the pictures that it was armed for"};
  }
  if (periods_.size() + (packing_ ? 1 : 0) + display_.waiting() >= most_ahead_) {
    return Fault{"projector.full", "LightCrafter 4500", std::to_string(most_ahead_) + " periods are waiting",
                 "post when one was shown"};
  }
  periods_.push_back(std::move(pictures));
  changed_.notify_all();
  return {};
}

void FrameFeeder::forget() noexcept {
  const std::lock_guard lock(mutex_);
  ++forgotten_;
  periods_.clear();
  display_.black();
}

std::shared_ptr<std::vector<std::uint32_t>> FrameFeeder::free_frame(std::size_t pixels) {
  for (auto& frame : frames_) {
    if (frame && frame.use_count() > 1) continue;
    if (!frame || frame->size() != pixels) frame = std::make_shared<std::vector<std::uint32_t>>(pixels);
    return frame;
  }
  return std::make_shared<std::vector<std::uint32_t>>(pixels);
}

void FrameFeeder::loop(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    std::vector<Picture> pictures;
    std::shared_ptr<FramePacker> packer;
    std::uint64_t forgotten = 0;
    {
      std::unique_lock lock(mutex_);
      if (!changed_.wait(lock, stop, [&] { return going_ && !periods_.empty(); })) return;
      pictures = std::move(periods_.front());
      periods_.pop_front();
      packer = packer_;
      forgotten = forgotten_;
      packing_ = true;
    }
    VideoFrame frame;
    if (!pictures.empty()) {
      const PackPlan& plan = packer->plan();
      const auto pixels =
          free_frame(static_cast<std::size_t>(plan.width_px) * static_cast<std::size_t>(plan.height_px));
      std::vector<std::span<const std::uint8_t>> codes;
      for (const Picture& picture : pictures) codes.push_back(picture.codes);
      if (packer->pack(codes, *pixels)) frame = pixels;
    }
    const std::lock_guard lock(mutex_);
    packing_ = false;
    if (forgotten == forgotten_) (void)display_.post(std::move(frame));
  }
}

}  // namespace focalstage::lightcrafter
