#pragma once

#include <cstddef>
#include <memory>

namespace focalstage {

/// The system calls that a V4L2 camera takes (kernel.org, "Video for Linux API", userspace-api/media/v4l): injected, so
/// that the driver is tested without one. Each answers as the call of that name does and leaves `errno` behind.
class V4l2Calls {
 public:
  V4l2Calls() = default;
  V4l2Calls(const V4l2Calls&) = delete;
  V4l2Calls& operator=(const V4l2Calls&) = delete;
  virtual ~V4l2Calls() = default;

  virtual int open(const char* path) = 0;  ///< read and write, not waiting
  virtual void close(int descriptor) = 0;
  virtual int ioctl(int descriptor, unsigned long request, void* argument) = 0;
  virtual void* mmap(int descriptor, std::size_t length, std::size_t offset) = 0;  ///< null where it failed
  virtual void munmap(void* memory, std::size_t length) = 0;

  /// Whether a picture may be there, or something happened; false after `timeout_ms`.
  virtual bool wait(int descriptor, int timeout_ms) = 0;
};

/// Those of the kernel.
std::shared_ptr<V4l2Calls> kernel_v4l2();

}  // namespace focalstage
