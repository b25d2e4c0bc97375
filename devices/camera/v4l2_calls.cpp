#include "devices/camera/v4l2_calls.h"

#include <cerrno>

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace focalstage {

namespace {

class KernelCalls final : public V4l2Calls {
 public:
  int open(const char* path) override { return ::open(path, O_RDWR | O_NONBLOCK | O_CLOEXEC); }
  void close(int descriptor) override { ::close(descriptor); }

  int ioctl(int descriptor, unsigned long request, void* argument) override {
    int answer = 0;
    do {
      answer = ::ioctl(descriptor, request, argument);
    } while (answer < 0 && errno == EINTR);
    return answer;
  }

  void* mmap(int descriptor, std::size_t length, std::size_t offset) override {
    void* memory = ::mmap(nullptr, length, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, static_cast<off_t>(offset));
    return memory == MAP_FAILED ? nullptr : memory;
  }

  void munmap(void* memory, std::size_t length) override { ::munmap(memory, length); }

  bool wait(int descriptor, int timeout_ms) override {
    pollfd polled{descriptor, POLLIN, 0};
    return ::poll(&polled, 1, timeout_ms) > 0;
  }
};

}  // namespace

std::shared_ptr<V4l2Calls> kernel_v4l2() { return std::make_shared<KernelCalls>(); }

}  // namespace focalstage
