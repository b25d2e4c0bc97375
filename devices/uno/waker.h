#pragma once

namespace focalstage::uno {

/// Rings in a thread that waits in poll, from any other.
class Waker {
 public:
  Waker();
  ~Waker();
  Waker(const Waker&) = delete;
  Waker& operator=(const Waker&) = delete;

  void ring() const noexcept;
  /// Whether it rang; no longer afterwards.
  bool answer() const noexcept;
  /// For poll: readable while it rings. -1 where the system has none left: then who waits, waits its time out.
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_ = -1;
};

}  // namespace focalstage::uno
