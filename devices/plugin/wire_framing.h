#pragma once

/* What the projector plugin `wire` and the optics at the other end of its socket say to each other: see README.md. All
 * numbers are of this machine's byte order, for both ends run on it. */

#include <stdint.h>

#define WIRE_VERSION 1u

enum wire_type {
  /* from the plugin */
  WIRE_HELLO = 1,     /* wire_hello; first */
  WIRE_CONFIGURE = 2, /* wire_configure, then int64_t start_ns[count] */
  WIRE_START = 3,     /* wire_start */
  WIRE_FRAME = 4,     /* wire_frame, then width x height x channels bytes; none where it is black */
  WIRE_STOP = 5,      /* nothing follows */
  WIRE_BLANK = 6,     /* wire_blank: dark now, and answer with WIRE_BLANKED */
  WIRE_IDENTIFY = 7,  /* nothing follows */
  /* from the optics */
  WIRE_GEOMETRY = 64, /* wire_geometry: the answer to WIRE_HELLO */
  WIRE_COUNTS = 65,   /* wire_counts: with every trigger or every 2 ms, and at least every 100 ms */
  WIRE_BLANKED = 66   /* wire_blank, as it came */
};

/* Before every message. */
struct wire_header {
  uint32_t type; /* wire_type */
  uint32_t zero;
  uint64_t bytes; /* that follow */
};

struct wire_hello {
  uint32_t version; /* WIRE_VERSION */
  uint32_t zero;
};

struct wire_geometry {
  uint32_t version; /* WIRE_VERSION */
  uint32_t width_px;
  uint32_t height_px;
  uint32_t most_periods_ahead;
  int64_t latency_ns; /* from trigger to light */
  char serial[32];    /* ends with a zero */
};

struct wire_configure {
  double period_ns;
  int64_t exposure_ns;
  uint32_t channels;
  uint32_t count; /* of exposures in a period */
};

struct wire_start {
  uint64_t run; /* never the same twice: the counts of another run are worth nothing */
};

struct wire_frame {
  uint64_t period; /* handed over since the start, from 0 */
  uint32_t exposure;
  uint32_t width_px;
  uint32_t height_px;
  uint32_t channels;
  uint32_t black; /* 1: all dark, and no bytes follow */
  uint32_t zero;
};

struct wire_blank {
  uint64_t number; /* of the blanks since the connection began, from 1 */
};

struct wire_counts {
  uint64_t run;
  uint64_t shown;
  uint64_t missed;
  int64_t told_ns;   /* CLOCK_MONOTONIC, when they stood so */
  int64_t device_ns; /* the same moment on the optics' own clock, for whoever reads along */
};
