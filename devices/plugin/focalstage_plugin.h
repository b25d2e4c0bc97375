#pragma once

/* What every plugin of Focalstage has in common: C99 and nothing else, so that a plugin is built with its vendor's
 * compiler and library alone. A plugin is a shared object that the runtime opens by the absolute path in its settings;
 * it exports the functions that focalstage_projector.h or focalstage_lens_drive.h name.
 *
 * Threads. The host calls from three threads of its own, each with one call at a time:
 *
 *   work    all calls but the two below
 *   status  `status` only, every millisecond or so
 *   safety  `blank` (`stop` of a lens drive) only
 *
 * `status` and the safety call come between the return of `open` and the call of `close`, also while a work call has
 * not returned: they take no lock that a slow transfer may hold. The safety call returns within 100 ms, whatever hangs.
 * A work call returns within the time that it documents; one that stays away 1 s longer means darkness, and that the
 * device is lost. `close` comes last, and only once no other call is under way.
 *
 * Memory. Whoever made it frees it: neither side frees what the other one gave. What the host hands over (settings,
 * exposures, samples) is valid during the call. A string that a plugin returns is valid as long as it is loaded. A
 * plugin that was opened stays loaded until the process ends.
 *
 * Times. Moments are nanoseconds of CLOCK_MONOTONIC in int64_t; durations that a clock cannot divide into whole
 * nanoseconds (a period) are double nanoseconds.
 *
 * Errors. A call returns a focalstage_code and may say more in `error`, which the host gives and which holds
 * FOCALSTAGE_ERROR_BYTES: UTF-8 that ends with a zero, one sentence that a person in the room can act on. No exception
 * and no longjmp leaves a call, no signal handler is changed, the process does not end.
 */

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define FOCALSTAGE_EXPORT __attribute__((visibility("default")))
#else
#define FOCALSTAGE_EXPORT
#endif

#define FOCALSTAGE_ERROR_BYTES 256
#define FOCALSTAGE_TEXT_BYTES 64

enum focalstage_code {
  FOCALSTAGE_OK = 0,
  FOCALSTAGE_NOT_YET = 1, /* nothing is wrong, and there is no room: the host asks again */
  FOCALSTAGE_DARK = 2,    /* it was made dark meanwhile; what was handed over is forgotten */
  FOCALSTAGE_ABSENT = 3,  /* no device, or none with this serial: the host opens again later */
  FOCALSTAGE_LOST = 4,    /* it answered before and no longer does: the host closes and opens again later */
  FOCALSTAGE_UNABLE = 5,  /* this cannot be done with this device: `error` says what */
  FOCALSTAGE_SETTINGS = 6 /* a setting is missing or wrong: `error` names it */
};

/* One line of the plugin's settings, as a person wrote it: UTF-8, both end with a zero. */
struct focalstage_setting {
  const char* key;
  const char* value;
};

/* Which device was opened; UTF-8, each ends with a zero. */
struct focalstage_identity {
  char model[FOCALSTAGE_TEXT_BYTES];   /* in words */
  char serial[FOCALSTAGE_TEXT_BYTES];  /* what tells two of them apart; empty where the device has none */
  char address[FOCALSTAGE_TEXT_BYTES]; /* where it is now */
};

#ifdef __cplusplus
}
#endif
