#pragma once

/* A waveform generator behind a vendor's library (NI-DAQmx), that gives the lenses their current. Read
 * focalstage_plugin.h first: threads, memory, times and errors. */

#include "focalstage_plugin.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Raised with every change that is not an addition to the end of a struct. */
#define FOCALSTAGE_LENS_DRIVE_ABI 1

struct focalstage_drive_abilities {
  uint32_t eyes_apart;   /* 1: a channel for each lens; 0: both get the same current */
  uint32_t sync_edge;    /* 1: gives out one edge at the start of each period */
  uint32_t most_samples; /* of a period; 0: any number */
  double most_a;         /* either way */
};

/* One period, uniform samples from its start, played over and over. */
struct focalstage_drive_period {
  double period_ns;
  uint32_t count;        /* of samples; at most `most_samples` */
  const double* left_a;  /* `count` of them, within +-most_a */
  const double* right_a; /* the same as `left_a` where the eyes are not apart */
};

/* How it stands. Counts begin at 0 with `start` and never go back until the next one. */
struct focalstage_drive_counts {
  int64_t told_ns;          /* when the counts stood so; as old as the device's last word */
  uint64_t periods;         /* begun */
  int64_t newest_period_ns; /* about when the newest began; 0 before the first */
  double period_ns;         /* as given out, by the device's own clock: what it could make of the one asked for */
  uint64_t underruns;       /* the host came too late; each stops it: no current until the next `start` */
  double temperature_c;     /* of the hotter lens; NaN: not known */
};

/* An opened generator, the plugin's own. */
struct focalstage_drive_device;

/* The table of calls. `size` and `abi` come first and stay there in every version. */
struct focalstage_lens_drive {
  uint32_t size; /* sizeof(struct focalstage_lens_drive) as the plugin was compiled */
  uint32_t abi;  /* FOCALSTAGE_LENS_DRIVE_ABI as the plugin was compiled */
  const char* name;

  /* Finds the device and takes the current away. Within 3 s. On a failure there is nothing to close. */
  int32_t (*open)(const struct focalstage_setting* settings, uint32_t count, struct focalstage_drive_device** device,
                  char* error);

  /* No current first. Within 1 s. Called once for each `open` that succeeded. */
  void (*close)(struct focalstage_drive_device* device);

  /* Which one, and what it can do. At once; the same from `open` to `close`. */
  void (*describe)(struct focalstage_drive_device* device, struct focalstage_identity* identity,
                   struct focalstage_drive_abilities* abilities);

  /* Something that a person in the room can see and that is safe. Within 2 s; only while stopped. */
  int32_t (*identify)(struct focalstage_drive_device* device, char* error);

  /* Current from now on, from the period's start. Within 1 s; only while stopped. FOCALSTAGE_UNABLE names the limit. */
  int32_t (*start)(struct focalstage_drive_device* device, const struct focalstage_drive_period* period, char* error);

  /* This from a period's start on, without a gap. `from_period`: which one, counted as `periods` counts (the first is
   * 1). Within 1 s. The period's length is that of `start`; another one is FOCALSTAGE_UNABLE. */
  int32_t (*refill)(struct focalstage_drive_device* device, const struct focalstage_drive_period* period,
                    uint64_t* from_period, char* error);

  /* How it stands. Returns within 10 ms, with what is known. FOCALSTAGE_LOST: it does not answer any more. */
  int32_t (*status)(struct focalstage_drive_device* device, struct focalstage_drive_counts* counts, char* error);

  /* No current within 100 ms, without a jump where the device allows, whatever else is under way, and until `start`:
   * the safety call. FOCALSTAGE_OK once it is known to be so; anything else: it could not be told. Stopping what is
   * stopped changes nothing. */
  int32_t (*stop)(struct focalstage_drive_device* device);
};

/* What a plugin exports. */

/* FOCALSTAGE_LENS_DRIVE_ABI as it was compiled; asked before anything else. */
FOCALSTAGE_EXPORT uint32_t focalstage_lens_drive_abi(void);

/* The table for this version; null where it has none. Valid as long as the plugin is loaded. */
FOCALSTAGE_EXPORT const struct focalstage_lens_drive* focalstage_lens_drive_get(uint32_t abi);

#ifdef __cplusplus
}
#endif
