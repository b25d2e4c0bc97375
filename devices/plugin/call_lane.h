#pragma once

#include <functional>
#include <memory>
#include <string>

namespace focalstage {

/// A thread that makes calls which may never return. Who asks waits only as long as he says; a call that hangs keeps
/// its lane, and nothing else: not even the end of the lane, which leaves the thread behind then. So a call owns all
/// that it uses.
class CallLane {
 public:
  CallLane();
  CallLane(const CallLane&) = delete;
  CallLane& operator=(const CallLane&) = delete;
  /// Forgets what waits, and gives the call under way a tenth of a second to return.
  ~CallLane();

  /// To be made after all that waits; it should take no longer than `due_s`.
  void post(std::function<void()> call, double due_s);

  /// `post`, and waits for it. False: not done after `wait_s`; it may still happen.
  bool run(std::function<void()> call, double due_s, double wait_s);

  /// Forgets what waits; what is under way goes on.
  void forget();

  /// Nothing waits, nothing is under way; `wait_s` may pass until it is so.
  bool idle(double wait_s = 0.0) const;

  /// By how much the call under way has passed the time that it should take; 0: by nothing.
  double overdue_s() const;

 private:
  struct Shared;
  static void work(const std::shared_ptr<Shared>& shared);

  std::shared_ptr<Shared> shared_;
};

}  // namespace focalstage
