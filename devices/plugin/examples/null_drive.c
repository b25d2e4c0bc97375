/* A waveform generator that drives nothing, by this machine's clock. Options: most_a, apart (0 or 1). */
#define _POSIX_C_SOURCE 200809L

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../example_helpers.h"
#include "../focalstage_lens_drive.h"

struct focalstage_drive_device {
  pthread_mutex_t mutex; /* held for some instructions only, so that every call may take it */
  double most_a;
  unsigned apart;
  int running;
  int64_t first_ns;
  double period_ns;
  uint64_t stopped_after; /* periods; while it does not run */
};

static uint64_t periods_begun(const struct focalstage_drive_device* device, int64_t at_ns) {
  if (!device->running) return device->stopped_after;
  return 1 + (uint64_t)((double)(at_ns - device->first_ns) / device->period_ns);
}

static int32_t drive_open(const struct focalstage_setting* settings, uint32_t count,
                          struct focalstage_drive_device** device, char* error) {
  double most_a = 0.29;
  unsigned apart = 1;
  for (uint32_t i = 0; i < count; ++i) {
    const int good = strcmp(settings[i].key, "most_a") == 0  ? sscanf(settings[i].value, "%lf", &most_a) == 1
                     : strcmp(settings[i].key, "apart") == 0 ? sscanf(settings[i].value, "%u", &apart) == 1
                                                             : 0;
    if (!good) return fail(error, FOCALSTAGE_SETTINGS, "the options of the null drive are most_a and apart (0 or 1)");
  }
  struct focalstage_drive_device* made = calloc(1, sizeof *made);
  if (made == NULL) return fail(error, FOCALSTAGE_UNABLE, "there is not enough memory");
  pthread_mutex_init(&made->mutex, NULL);
  made->most_a = most_a;
  made->apart = apart;
  *device = made;
  return FOCALSTAGE_OK;
}

static void drive_close(struct focalstage_drive_device* device) {
  pthread_mutex_destroy(&device->mutex);
  free(device);
}

static void drive_describe(struct focalstage_drive_device* device, struct focalstage_identity* identity,
                           struct focalstage_drive_abilities* abilities) {
  memset(identity, 0, sizeof *identity);
  snprintf(identity->model, sizeof identity->model, "null drive");
  memset(abilities, 0, sizeof *abilities);
  abilities->eyes_apart = device->apart;
  abilities->sync_edge = 1;
  abilities->most_a = device->most_a;
}

static int32_t drive_identify(struct focalstage_drive_device* device, char* error) {
  (void)device;
  return fail(error, FOCALSTAGE_UNABLE, "a null drive has nothing to show itself with");
}

/* What a real one would put out must be within what it states. */
static int within(const struct focalstage_drive_device* device, const struct focalstage_drive_period* period) {
  for (uint32_t i = 0; i < period->count; ++i) {
    if (!(fabs(period->left_a[i]) <= device->most_a) || !(fabs(period->right_a[i]) <= device->most_a)) return 0;
  }
  return period->count > 0 && period->period_ns >= 1e5;
}

static int32_t drive_start(struct focalstage_drive_device* device, const struct focalstage_drive_period* period,
                           char* error) {
  if (!within(device, period)) return fail(error, FOCALSTAGE_UNABLE, "this is beyond its current, or too short");
  pthread_mutex_lock(&device->mutex);
  device->period_ns = period->period_ns;
  device->first_ns = now_ns();
  device->running = 1;
  pthread_mutex_unlock(&device->mutex);
  return FOCALSTAGE_OK;
}

static int32_t drive_refill(struct focalstage_drive_device* device, const struct focalstage_drive_period* period,
                            uint64_t* from_period, char* error) {
  if (!within(device, period)) return fail(error, FOCALSTAGE_UNABLE, "this is beyond its current");
  pthread_mutex_lock(&device->mutex);
  const int same = device->running && period->period_ns == device->period_ns;
  *from_period = periods_begun(device, now_ns()) + 1;
  pthread_mutex_unlock(&device->mutex);
  return same ? FOCALSTAGE_OK : fail(error, FOCALSTAGE_UNABLE, "a refill is of the length that it was started with");
}

static int32_t drive_status(struct focalstage_drive_device* device, struct focalstage_drive_counts* counts,
                            char* error) {
  (void)error;
  memset(counts, 0, sizeof *counts);
  counts->temperature_c = NAN;
  pthread_mutex_lock(&device->mutex);
  counts->told_ns = now_ns();
  counts->periods = periods_begun(device, counts->told_ns);
  counts->period_ns = device->period_ns;
  if (counts->periods > 0) {
    counts->newest_period_ns = device->first_ns + (int64_t)((double)(counts->periods - 1) * device->period_ns);
  }
  pthread_mutex_unlock(&device->mutex);
  return FOCALSTAGE_OK;
}

static int32_t drive_stop(struct focalstage_drive_device* device) {
  pthread_mutex_lock(&device->mutex);
  device->stopped_after = periods_begun(device, now_ns());
  device->running = 0;
  pthread_mutex_unlock(&device->mutex);
  return FOCALSTAGE_OK;
}

static const struct focalstage_lens_drive table = {sizeof table,   FOCALSTAGE_LENS_DRIVE_ABI,
                                                   "null",         drive_open,
                                                   drive_close,    drive_describe,
                                                   drive_identify, drive_start,
                                                   drive_refill,   drive_status,
                                                   drive_stop};

uint32_t focalstage_lens_drive_abi(void) { return FOCALSTAGE_LENS_DRIVE_ABI; }

const struct focalstage_lens_drive* focalstage_lens_drive_get(uint32_t abi) {
  return abi == FOCALSTAGE_LENS_DRIVE_ABI ? &table : NULL;
}
