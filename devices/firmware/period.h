#pragma once

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Ticks are half a microsecond: 16 MHz through a prescaler of 8.
#define FS_TICKS_PER_MS 2000u
/// 125 Hz to 44 Hz. The longest stays clear of the 25 ms after which sync counts as lost, and of the timer's wrap.
#define FS_PERIOD_MIN 16000u
#define FS_PERIOD_MAX 45000u

/// The sync signal's period, smoothed: single measurements are whole ticks, their mean over 16 is finer. All zero is
/// one that has seen nothing.
struct fs_period {
  uint32_t mean_q8;  ///< ticks / 256
  uint32_t used_q8;  ///< what times are scaled by: follows the mean, but not its ripple, which would be jitter
  uint8_t good;      ///< successive periods within 2 % of the mean, counted up to FS_PERIODS_TO_LOCK
};

#define FS_PERIODS_TO_LOCK 3u

void fs_period_measured(struct fs_period* period, uint16_t ticks);
bool fs_period_locked(const struct fs_period* period);
/// Periods outside of these are no periods: the mean and 2 % either side.
void fs_period_bounds(const struct fs_period* period, uint16_t* low, uint16_t* high);

/// How much longer the measured period is than the nominal one, in 2^-20 of it. False: by more than 3 %.
bool fs_period_ratio(const struct fs_period* period, uint16_t nominal, int16_t* ratio_q20);
/// A nominal time on the measured period, rounded to the nearest tick.
uint16_t fs_scale(uint16_t ticks, int16_t ratio_q20);

#ifdef __cplusplus
}
#endif
