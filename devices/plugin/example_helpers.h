#pragma once

/* What the examples share. Needs _POSIX_C_SOURCE. */

#include <stdio.h>
#include <time.h>

#include "focalstage_plugin.h"

static inline int64_t now_ns(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

static inline void pause_ns(int64_t ns) {
  const struct timespec moment = {0, (long)ns};
  nanosleep(&moment, NULL);
}

/* `code`, and why. */
static inline int32_t fail(char* error, int32_t code, const char* words) {
  snprintf(error, FOCALSTAGE_ERROR_BYTES, "%s", words);
  return code;
}
