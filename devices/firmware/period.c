#include "devices/firmware/period.h"

// What the used period may lie off the mean: 0.25 ticks are 2 cycles at the end of a period.
#define HOLD_Q8 64
// A step this large is a change of the signal, not of the clock: taken over at once.
#define STEP_Q8 (4 * 256)

static bool within_2_percent(uint16_t ticks, uint32_t mean_q8) {
  const uint16_t mean = (uint16_t)(mean_q8 >> 8);
  const uint16_t off = ticks > mean ? (uint16_t)(ticks - mean) : (uint16_t)(mean - ticks);
  return off <= mean / 50u;
}

void fs_period_measured(struct fs_period* period, uint16_t ticks) {
  if (ticks < FS_PERIOD_MIN || ticks > FS_PERIOD_MAX) {
    period->good = 0;
    return;
  }
  const uint32_t ticks_q8 = (uint32_t)ticks << 8;
  if (!period->good || !within_2_percent(ticks, period->mean_q8)) {
    period->mean_q8 = ticks_q8;
    period->used_q8 = ticks_q8;
    period->good = 1;
    return;
  }
  if (period->good < FS_PERIODS_TO_LOCK) {
    ++period->good;
  }
  const int32_t off = (int32_t)(ticks_q8 - period->mean_q8);
  period->mean_q8 += (uint32_t)(off > STEP_Q8 || off < -STEP_Q8 ? off : off / 16);
  const int32_t behind = (int32_t)(period->mean_q8 - period->used_q8);
  if (behind > HOLD_Q8 || behind < -HOLD_Q8) {
    period->used_q8 = period->mean_q8;
  }
}

bool fs_period_locked(const struct fs_period* period) { return period->good >= FS_PERIODS_TO_LOCK; }

void fs_period_bounds(const struct fs_period* period, uint16_t* low, uint16_t* high) {
  const uint16_t mean = (uint16_t)(period->mean_q8 >> 8);
  *low = (uint16_t)(mean - mean / 50u);
  *high = (uint16_t)(mean + mean / 50u);
}

bool fs_period_ratio(const struct fs_period* period, uint16_t nominal, int16_t* ratio_q20) {
  const int32_t longer_q8 = (int32_t)(period->used_q8 - ((uint32_t)nominal << 8));
  const int32_t most_q8 = (int32_t)((uint32_t)nominal * 256u / 100u * 3u);
  if (longer_q8 > most_q8 || longer_q8 < -most_q8) {
    return false;
  }
  *ratio_q20 = (int16_t)(longer_q8 * 4096 / (int32_t)nominal);
  return true;
}

uint16_t fs_scale(uint16_t ticks, int16_t ratio_q20) {
  const int32_t longer_q20 = (int32_t)ticks * ratio_q20;
  return (uint16_t)(ticks + (uint16_t)((longer_q20 + (1L << 19)) >> 20));
}
