/* The null projector with one defect each: what the conformance suite must not let through. */
#define focalstage_projector_abi null_abi
#define focalstage_projector_get null_get
#include "devices/plugin/examples/null.c"
#undef focalstage_projector_abi
#undef focalstage_projector_get

#include <unistd.h>

FOCALSTAGE_EXPORT uint32_t focalstage_projector_abi(void);
FOCALSTAGE_EXPORT const struct focalstage_projector* focalstage_projector_get(uint32_t abi);

static struct focalstage_projector changed;

#if defined(MUTANT_HANG)
static int32_t hang_in_submit(struct focalstage_projector_device* device, uint8_t* buffer, uint64_t period,
                              uint32_t exposure, char* error) {
  if (period >= 2) {
    for (;;) pause();
  }
  return null_submit(device, buffer, period, exposure, error);
}
#endif

#if defined(MUTANT_LIE) || defined(MUTANT_SILENT) || defined(MUTANT_STUCK) || defined(MUTANT_BACK)
static int32_t defective_status(struct focalstage_projector_device* device, struct focalstage_projector_counts* counts,
                                char* error) {
  const int32_t code = null_status(device, counts, error);
#if defined(MUTANT_LIE)
  counts->shown += counts->missed;
  counts->missed = 0;
#elif defined(MUTANT_SILENT)
  static int64_t frozen_ns;
  if (frozen_ns == 0) frozen_ns = counts->told_ns;
  counts->told_ns = frozen_ns;
#elif defined(MUTANT_STUCK)
  for (; counts->shown > 4;) pause();
#else
  if (counts->shown > 6) counts->shown -= 5;
#endif
  return code;
}
#endif

#if defined(MUTANT_LIT)
static int32_t stay_lit(struct focalstage_projector_device* device) {
  (void)device;
  return FOCALSTAGE_OK;
}
#endif

#if defined(MUTANT_BLANK_HANGS)
static int32_t hang_in_blank(struct focalstage_projector_device* device) {
  pthread_mutex_lock(&device->mutex);
  const int running = device->running;
  pthread_mutex_unlock(&device->mutex);
  for (; running;) pause();
  return FOCALSTAGE_OK;
}
#endif

#if defined(MUTANT_ROOM)
static void boast(struct focalstage_projector_device* device, struct focalstage_identity* identity,
                  struct focalstage_projector_abilities* abilities) {
  null_describe(device, identity, abilities);
  abilities->most_periods_ahead = 64;
}
#endif

uint32_t focalstage_projector_abi(void) {
#if defined(MUTANT_ABI)
  return FOCALSTAGE_PROJECTOR_ABI + 1;
#else
  return null_abi();
#endif
}

const struct focalstage_projector* focalstage_projector_get(uint32_t abi) {
  changed = *null_get(abi);
#if defined(MUTANT_SIZE)
  changed.size -= (uint32_t)sizeof changed.blank;
#elif defined(MUTANT_CALL)
  changed.blank = NULL;
#elif defined(MUTANT_HANG)
  changed.submit = hang_in_submit;
#elif defined(MUTANT_LIE) || defined(MUTANT_SILENT) || defined(MUTANT_STUCK) || defined(MUTANT_BACK)
  changed.status = defective_status;
#elif defined(MUTANT_LIT)
  changed.blank = stay_lit;
#elif defined(MUTANT_BLANK_HANGS)
  changed.blank = hang_in_blank;
#elif defined(MUTANT_ROOM)
  changed.describe = boast;
#endif
  return &changed;
}
