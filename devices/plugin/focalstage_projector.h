#pragma once

/* A projector behind a vendor's library. Read focalstage_plugin.h first: threads, memory, times and errors. */

#include "focalstage_plugin.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Raised with every change that is not an addition to the end of a struct. */
#define FOCALSTAGE_PROJECTOR_ABI 1

enum focalstage_pacing {
  FOCALSTAGE_TRIGGERED = 0, /* an electrical edge for each exposure */
  FOCALSTAGE_MASTER = 1     /* the projector's own clock: the rig follows the start of each of its periods */
};

struct focalstage_projector_abilities {
  uint32_t width_px;
  uint32_t height_px;
  uint32_t pacing;    /* focalstage_pacing */
  uint32_t most_bits; /* of a code: 1 to 8 */
  uint32_t rgb;       /* 0: gray alone; 1: pictures of three channels too */
  uint32_t
      most_periods_ahead; /* whole periods that it holds before they are shown, for any exposures it can do: >= 2 */
  int64_t latency_ns;     /* from trigger to light */
};

/* What is shown in every period. */
struct focalstage_exposures {
  double period_ns;
  int64_t exposure_ns;     /* of each picture */
  uint32_t channels;       /* of each picture: 1 gray, 3 RGB */
  uint32_t bits;           /* of a code; codes are bytes of 0 to 2^bits - 1 */
  uint32_t count;          /* of pictures in a period */
  const int64_t* start_ns; /* of the light, from the period's start, in time order; `count` of them */
};

/* How it stands. Counts begin at 0 with `start` and never go back until the next one. Each trigger (each exposure due,
 * where it is the master) is either shown or missed, never both: shown + missed is how many there were. A picture that
 * was submitted as black counts as shown. */
struct focalstage_projector_counts {
  int64_t told_ns; /* when the counts stood so; as old as the device's last word, never the time of the call */
  uint64_t shown;
  uint64_t missed;          /* there was no picture for it, and it was black */
  int64_t newest_period_ns; /* when the newest period began; 0 where it is not the master, and before the first */
  double temperature_c;     /* of its hottest part; NaN: not known */
};

/* An opened projector, the plugin's own. */
struct focalstage_projector_device;

/* The table of calls. `size` and `abi` come first and stay there in every version. */
struct focalstage_projector {
  uint32_t size; /* sizeof(struct focalstage_projector) as the plugin was compiled */
  uint32_t abi;  /* FOCALSTAGE_PROJECTOR_ABI as the plugin was compiled */
  const char* name;

  /* Finds the device, makes it dark and ready. Within 3 s. On a failure there is nothing to close. */
  int32_t (*open)(const struct focalstage_setting* settings, uint32_t count,
                  struct focalstage_projector_device** device, char* error);

  /* Dark first. Within 1 s. Called once for each `open` that succeeded. */
  void (*close)(struct focalstage_projector_device* device);

  /* Which one, and what it can do. At once; the same from `open` to `close`. */
  void (*describe)(struct focalstage_projector_device* device, struct focalstage_identity* identity,
                   struct focalstage_projector_abilities* abilities);

  /* Something that a person in the room can see and that is safe to look at. Within 2 s; only while dark.
   * FOCALSTAGE_UNABLE where it cannot. */
  int32_t (*identify)(struct focalstage_projector_device* device, char* error);

  /* Prepares what `start` begins and stays dark. Within 3 s; only while stopped. FOCALSTAGE_UNABLE names the limit. */
  int32_t (*configure)(struct focalstage_projector_device* device, const struct focalstage_exposures* exposures,
                       char* error);

  /* From now on triggers count; the first trigger is the first exposure of a period. At each one the picture that
   * waits longest is shown if it is of this exposure; else it goes on waiting, and the exposure is black and counted as
   * missed. So a picture that comes too late never shows at another one's place. A master begins its first period one
   * period after this. Within 1 s. Ends what `blank` began. */
  int32_t (*start)(struct focalstage_projector_device* device, char* error);

  /* No light, no triggers; what waits is forgotten. Within 1 s. Stopping what is stopped changes nothing. */
  void (*stop)(struct focalstage_projector_device* device);

  /* Room for one picture: width x height x channels bytes, rows from the top without padding, channels interleaved. It
   * is the plugin's (pinned, where its hardware needs that) and the host's to write until it submits it; each call that
   * succeeds is followed by `submit` of the same buffer, or by `stop`. FOCALSTAGE_NOT_YET after `timeout_ns` without
   * room; FOCALSTAGE_DARK while blank. */
  int32_t (*acquire)(struct focalstage_projector_device* device, uint8_t** buffer, int64_t timeout_ns, char* error);

  /* The next picture: of exposure `exposure`, in the `period`th period handed over since `start` (from 0); in order and
   * without gaps. Null: black, without a buffer. Within 100 ms; FOCALSTAGE_NOT_YET where black finds no room, and
   * FOCALSTAGE_DARK while blank. */
  int32_t (*submit)(struct focalstage_projector_device* device, uint8_t* buffer, uint64_t period, uint32_t exposure,
                    char* error);

  /* How it stands. Returns within 10 ms, with what is known: it does not wait for the device. FOCALSTAGE_LOST: it does
   * not answer any more. */
  int32_t (*status)(struct focalstage_projector_device* device, struct focalstage_projector_counts* counts,
                    char* error);

  /* No light within 100 ms, whatever else is under way, and until `start`: the safety call. FOCALSTAGE_OK once it is
   * known to be dark; anything else: it could not be told. */
  int32_t (*blank)(struct focalstage_projector_device* device);
};

/* What a plugin exports. */

/* FOCALSTAGE_PROJECTOR_ABI as it was compiled; asked before anything else. */
FOCALSTAGE_EXPORT uint32_t focalstage_projector_abi(void);

/* The table for this version; null where it has none. Valid as long as the plugin is loaded. */
FOCALSTAGE_EXPORT const struct focalstage_projector* focalstage_projector_get(uint32_t abi);

#ifdef __cplusplus
}
#endif
