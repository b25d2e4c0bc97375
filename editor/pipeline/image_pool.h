#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "core/compile/frame.h"

namespace focalstage {

/// Images that several may hold, whose memory comes back when the last lets go of them: a long show is compiled in the
/// memory of a few frames, none of which need be asked for and cleared again.
class ImagePool {
 public:
  /// Memory of images nobody holds any more, or none.
  FrameImages take();

  std::shared_ptr<const FrameImages> share(FrameImages images);

 private:
  struct Free {
    std::mutex mutex;
    std::vector<FrameImages> images;
  };
  std::shared_ptr<Free> free_ = std::make_shared<Free>();  ///< outlives the pool while images are held
};

}  // namespace focalstage
