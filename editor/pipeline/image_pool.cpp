#include "editor/pipeline/image_pool.h"

#include <utility>

namespace focalstage {

FrameImages ImagePool::take() {
  const std::scoped_lock lock(free_->mutex);
  if (free_->images.empty()) return {};
  FrameImages images = std::move(free_->images.back());
  free_->images.pop_back();
  return images;
}

std::shared_ptr<const FrameImages> ImagePool::share(FrameImages images) {
  const auto come_back = [free = free_](FrameImages* held) {
    const std::unique_ptr<FrameImages> owned(held);
    const std::scoped_lock lock(free->mutex);
    free->images.push_back(std::move(*owned));
  };
  return {new FrameImages(std::move(images)), come_back};
}

}  // namespace focalstage
