#pragma once

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define FS_TRIGGERS_MAX 32u
/// From the edge to the first trigger, from a pulse's end to the next trigger, from the last pulse's end to the next
/// edge: what the interrupts need to be ready, with room for all others in between.
#define FS_FIRST_MIN 100u
#define FS_GAP_MIN 100u
#define FS_WIDTH_MIN 80u
#define FS_WIDTH_MAX 2000u

enum fs_eye { FS_LEFT, FS_RIGHT };

/// What one period shall be. Times are ticks of the nominal period after the sync edge.
struct fs_table {
  uint16_t period;
  uint16_t width;  ///< of a trigger pulse
  uint16_t trigger[FS_TRIGGERS_MAX];
  uint8_t triggers;
  uint16_t open[2];   ///< when each shutter is told to open,
  uint16_t close[2];  ///< and to close; before `open`: in the next period; equal: never open

  // Made by fs_table_check: shutters as one list in order. Bit 0: left is open, bit 1: right is.
  uint8_t open_at_edge;
  uint8_t changes;
  uint16_t change_at[4];
  uint8_t change_to[4];
};

enum fs_error {
  FS_OK,
  FS_UNKNOWN,     ///< no such command, or its words are not what they should be
  FS_CHECKSUM,    ///< the line was damaged or too long
  FS_RANGE,       ///< a number or a time is not possible
  FS_OVERLAP,     ///< both shutters would be open at once
  FS_NOT_SYNCED,  ///< no sync signal, or its period is over 3 % off the table's
  FS_NO_TABLE,    ///< no table was committed
  FS_NOT_NOW,     ///< only while safe; or a table between ARM and its edge
  FS_INCOMPLETE   ///< COMMIT counts other triggers than came
};

/// Begins a table anew.
void fs_table_begin(struct fs_table* table, uint16_t period, uint16_t width);
/// Sets trigger `index`; saying one again is allowed, leaving one out is not.
enum fs_error fs_table_trigger(struct fs_table* table, uint16_t index, uint16_t at);
enum fs_error fs_table_shutter(struct fs_table* table, enum fs_eye eye, uint16_t open, uint16_t close);
/// Whether a whole table can be played; if so it is ready for it.
enum fs_error fs_table_check(struct fs_table* table, uint16_t triggers);

#ifdef __cplusplus
}
#endif
