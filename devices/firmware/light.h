#pragma once

#include <stdbool.h>
#include <stdint.h>

#include "devices/firmware/table.h"

#ifdef __cplusplus
extern "C" {
#endif

#define FS_LIGHT_SAMPLES_MAX 240u
#define FS_LIGHT_INPUTS 6u
/// Ticks from one sample to the next: 13 clocks of the converter, each 32 of the chip.
#define FS_LIGHT_TICKS 52u

enum fs_light_state { FS_LIGHT_NONE, FS_LIGHT_WAITING, FS_LIGHT_WHOLE, FS_LIGHT_LOST };

struct fs_light {
  uint8_t state;
  uint16_t after;  ///< ticks from the sync edge to the first sample, as it really was
  uint16_t samples;
};

/// The analogue inputs: what commands act on. On the chip it is light.c; tests put their own here.
/// `samples` of one input, from about `after` ticks past the next sync edge on. Refused while armed.
enum fs_error fs_light_look(uint16_t input, uint16_t after, uint16_t samples);
void fs_light_status(struct fs_light* light);
uint16_t fs_light_sample(uint16_t index);  ///< 0 to 1023; of a whole record

#ifdef __cplusplus
}
#endif
