#include "devices/runtime/lease.h"

#include <random>

namespace focalstage {

namespace {

std::string random_token() {
  static constexpr char digits[] = "0123456789abcdef";
  std::random_device random;
  std::string token;
  for (int i = 0; i < 32; ++i) token += digits[random() & 15u];
  return token;
}

}  // namespace

Result<std::string> LeaseDesk::acquire(const std::string& holder, Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  if (held(now)) {
    return Fault{"rig.held", holder_, "another editor holds the rig", "wait until it lets go, or watch meanwhile"};
  }
  token_ = random_token();
  holder_ = holder.empty() ? "somebody" : holder.substr(0, 200);
  until_ = now + lasts_;
  return token_;
}

Status LeaseDesk::use(const std::string& token, Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  if (!held(now) || token != token_) {
    return Fault{"rig.lease", "token", "this lease has ended", "take the rig again"};
  }
  until_ = now + lasts_;
  return {};
}

void LeaseDesk::release(const std::string& token) {
  const std::lock_guard lock(mutex_);
  if (token == token_) token_.clear();
}

std::string LeaseDesk::holder(Clock::time_point now) const {
  const std::lock_guard lock(mutex_);
  return held(now) ? holder_ : std::string();
}

}  // namespace focalstage
