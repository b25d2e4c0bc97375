/* A projector that swallows what it is given, by a clock of its own. Options: width, height. The smallest plugin there
 * is: begin with a copy of it, and of ../example_helpers.h. */
#define _POSIX_C_SOURCE 200809L

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../example_helpers.h"
#include "../focalstage_projector.h"

enum { periods_ahead = 3, most_exposures = 1024 };

struct focalstage_projector_device {
  pthread_mutex_t mutex; /* held for some instructions only, so that every call may take it */
  uint32_t width_px;
  uint32_t height_px;
  uint8_t* picture;
  int running;
  int64_t first_ns; /* when the first period begins */
  double period_ns;
  int64_t start_ns[most_exposures];
  uint32_t count; /* of exposures in a period */
  uint32_t channels;
  uint64_t queued; /* pictures, ever */
  uint64_t due;    /* exposures that came */
  uint64_t shown;
};

/* When exposure number `number` of the run begins. */
static int64_t exposure_ns(const struct focalstage_projector_device* device, uint64_t number) {
  const double period = (double)(number / device->count);
  return device->first_ns + (int64_t)(period * device->period_ns) + device->start_ns[number % device->count];
}

/* Lets the exposures up to now happen. */
static void catch_up(struct focalstage_projector_device* device) {
  const int64_t now = now_ns();
  while (device->running && exposure_ns(device, device->due) <= now) {
    const int waits = device->queued > device->shown;
    if (waits && device->shown % device->count == device->due % device->count) ++device->shown;
    ++device->due;
  }
}

static int has_room(const struct focalstage_projector_device* device) {
  return device->queued - device->shown < (uint64_t)device->count * periods_ahead;
}

static int32_t null_open(const struct focalstage_setting* settings, uint32_t count,
                         struct focalstage_projector_device** device, char* error) {
  unsigned width = 64;
  unsigned height = 48;
  for (uint32_t i = 0; i < count; ++i) {
    unsigned* into = strcmp(settings[i].key, "width") == 0    ? &width
                     : strcmp(settings[i].key, "height") == 0 ? &height
                                                              : NULL;
    if (into == NULL || sscanf(settings[i].value, "%u", into) != 1 || *into < 1 || *into > 8192) {
      return fail(error, FOCALSTAGE_SETTINGS, "the options of the null projector are width and height, 1 to 8192");
    }
  }
  struct focalstage_projector_device* made = calloc(1, sizeof *made);
  if (made != NULL) made->picture = calloc((size_t)width * height, 3);
  if (made == NULL || made->picture == NULL) {
    free(made);
    return fail(error, FOCALSTAGE_UNABLE, "there is not enough memory");
  }
  pthread_mutex_init(&made->mutex, NULL);
  made->width_px = width;
  made->height_px = height;
  *device = made;
  return FOCALSTAGE_OK;
}

static void null_close(struct focalstage_projector_device* device) {
  pthread_mutex_destroy(&device->mutex);
  free(device->picture);
  free(device);
}

static void null_describe(struct focalstage_projector_device* device, struct focalstage_identity* identity,
                          struct focalstage_projector_abilities* abilities) {
  memset(identity, 0, sizeof *identity);
  snprintf(identity->model, sizeof identity->model, "null projector");
  memset(abilities, 0, sizeof *abilities);
  abilities->width_px = device->width_px;
  abilities->height_px = device->height_px;
  abilities->pacing = FOCALSTAGE_MASTER;
  abilities->most_bits = 8;
  abilities->rgb = 1;
  abilities->most_periods_ahead = periods_ahead;
}

static int32_t null_identify(struct focalstage_projector_device* device, char* error) {
  (void)device;
  return fail(error, FOCALSTAGE_UNABLE, "a null projector has nothing to show itself with");
}

static int32_t null_configure(struct focalstage_projector_device* device, const struct focalstage_exposures* exposures,
                              char* error) {
  if (exposures->count < 1 || exposures->count > most_exposures) {
    return fail(error, FOCALSTAGE_UNABLE, "it shows 1 to 1024 pictures in a period");
  }
  if (exposures->period_ns < 1e5) return fail(error, FOCALSTAGE_UNABLE, "its shortest period is 0.1 ms");
  pthread_mutex_lock(&device->mutex);
  device->period_ns = exposures->period_ns;
  device->count = exposures->count;
  device->channels = exposures->channels;
  memcpy(device->start_ns, exposures->start_ns, exposures->count * sizeof *exposures->start_ns);
  pthread_mutex_unlock(&device->mutex);
  return FOCALSTAGE_OK;
}

static int32_t null_start(struct focalstage_projector_device* device, char* error) {
  pthread_mutex_lock(&device->mutex);
  const int ready = device->count > 0;
  device->queued = device->due = device->shown = 0;
  device->first_ns = now_ns() + (int64_t)device->period_ns;
  device->running = ready;
  pthread_mutex_unlock(&device->mutex);
  return ready ? FOCALSTAGE_OK : fail(error, FOCALSTAGE_UNABLE, "it was not configured");
}

static int32_t null_blank(struct focalstage_projector_device* device) {
  pthread_mutex_lock(&device->mutex);
  device->running = 0;
  pthread_mutex_unlock(&device->mutex);
  return FOCALSTAGE_OK;
}

static void null_stop(struct focalstage_projector_device* device) { (void)null_blank(device); }

static int32_t null_acquire(struct focalstage_projector_device* device, uint8_t** buffer, int64_t timeout_ns,
                            char* error) {
  const int64_t until = now_ns() + timeout_ns;
  (void)error;
  for (;;) {
    pthread_mutex_lock(&device->mutex);
    catch_up(device);
    const int running = device->running;
    const int room = has_room(device);
    pthread_mutex_unlock(&device->mutex);
    if (!running) return FOCALSTAGE_DARK;
    *buffer = device->picture; /* what is written there goes nowhere, so one is enough */
    if (room) return FOCALSTAGE_OK;
    if (now_ns() >= until) return FOCALSTAGE_NOT_YET;
    pause_ns(500000);
  }
}

static int32_t null_submit(struct focalstage_projector_device* device, uint8_t* buffer, uint64_t period,
                           uint32_t exposure, char* error) {
  (void)buffer;
  pthread_mutex_lock(&device->mutex);
  catch_up(device);
  const int running = device->running;
  const int room = running && has_room(device);
  const int in_order = running && device->queued == period * device->count + exposure;
  if (room && in_order) ++device->queued;
  pthread_mutex_unlock(&device->mutex);
  if (!running) return FOCALSTAGE_DARK;
  if (!in_order) return fail(error, FOCALSTAGE_UNABLE, "this is not the next picture");
  return room ? FOCALSTAGE_OK : FOCALSTAGE_NOT_YET;
}

static int32_t null_status(struct focalstage_projector_device* device, struct focalstage_projector_counts* counts,
                           char* error) {
  (void)error;
  memset(counts, 0, sizeof *counts);
  pthread_mutex_lock(&device->mutex);
  catch_up(device);
  counts->told_ns = now_ns();
  counts->shown = device->shown;
  counts->missed = device->due - device->shown;
  counts->temperature_c = NAN;
  if (device->due > 0) {
    const uint64_t period = (device->due - 1) / device->count;
    counts->newest_period_ns = device->first_ns + (int64_t)((double)period * device->period_ns);
  }
  pthread_mutex_unlock(&device->mutex);
  return FOCALSTAGE_OK;
}

static const struct focalstage_projector table = {sizeof table,  FOCALSTAGE_PROJECTOR_ABI,
                                                  "null",        null_open,
                                                  null_close,    null_describe,
                                                  null_identify, null_configure,
                                                  null_start,    null_stop,
                                                  null_acquire,  null_submit,
                                                  null_status,   null_blank};

uint32_t focalstage_projector_abi(void) { return FOCALSTAGE_PROJECTOR_ABI; }

const struct focalstage_projector* focalstage_projector_get(uint32_t abi) {
  return abi == FOCALSTAGE_PROJECTOR_ABI ? &table : NULL;
}
