#include "devices/uno/waker.h"

#include <sys/eventfd.h>
#include <unistd.h>

#include <cstdint>

namespace focalstage::uno {

Waker::Waker() : descriptor_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {}

Waker::~Waker() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void Waker::ring() const noexcept {
  const std::uint64_t one = 1;
  // A count that is full rings already.
  [[maybe_unused]] const ssize_t sent = ::write(descriptor_, &one, sizeof one);
}

bool Waker::answer() const noexcept {
  std::uint64_t count = 0;
  return ::read(descriptor_, &count, sizeof count) == sizeof count;
}

}  // namespace focalstage::uno
