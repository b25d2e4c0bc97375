#include "devices/roles/clock.h"

#include <pthread.h>
#include <sched.h>

#include <cerrno>
#include <cmath>
#include <ctime>

namespace focalstage {

double monotonic_s() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void sleep_until(double time_s) {
  const double whole_s = std::floor(time_s);
  const timespec until{static_cast<time_t>(whole_s), static_cast<long>((time_s - whole_s) * 1e9)};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

void prefer_this_thread() {
  const sched_param priority{sched_get_priority_min(SCHED_FIFO)};
  (void)pthread_setschedparam(pthread_self(), SCHED_FIFO, &priority);
}

}  // namespace focalstage
