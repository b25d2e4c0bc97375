#pragma once

namespace focalstage {

/// The clock that all devices of one machine are told and tell by: CLOCK_MONOTONIC, in seconds.
double monotonic_s();

/// Sleeps until that clock shows `time_s`.
void sleep_until(double time_s);

/// Asks the system to run this thread before others, as one that keeps a device's time; fine if it will not.
void prefer_this_thread();

}  // namespace focalstage
