#pragma once

#include <stdbool.h>
#include <stdint.h>

#include "devices/firmware/table.h"

#ifdef __cplusplus
extern "C" {
#endif

enum fs_state { FS_SAFE, FS_WAITING, FS_RUNNING };
enum fs_reason { FS_NEVER_ARMED, FS_TOLD, FS_SYNC_LOST, FS_HOST_SILENT, FS_LATE };

struct fs_status {
  uint8_t state;
  uint8_t reason;  ///< of the last darkness
  uint16_t tables;
  uint16_t period;
  uint16_t edges;
};

/// The lens drive's edge at its own input, where a projector gives the sync edge.
struct fs_lens {
  uint16_t after;  ///< ticks since the newest sync edge when the newest came: up to a period
  uint16_t edges;
};

/// Timer, pins and the two tables: what commands act on. On the chip it is engine.c; tests put their own here.
/// The table not in use; one committed and not yet taken is dropped. NULL: not now, it is armed for that one.
struct fs_table* fs_engine_begin(void);
void fs_engine_commit(void);  ///< that table is taken at the next edge
enum fs_error fs_engine_arm(void);
void fs_engine_dark(enum fs_reason reason);
enum fs_error fs_engine_polarity(enum fs_eye eye, bool high_opens);
/// Bits of `failed`: left, right, trigger.
enum fs_error fs_engine_test(uint8_t* failed);
/// The board's own lamp, on and off for a while.
enum fs_error fs_engine_blink(void);
void fs_engine_status(struct fs_status* status);
void fs_engine_lens(struct fs_lens* lens);

#ifdef __cplusplus
}
#endif
