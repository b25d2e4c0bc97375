/* The headers by themselves, in C99 and in any order: what this compiles is the test. */
#include "devices/plugin/focalstage_lens_drive.h"
#include "devices/plugin/focalstage_projector.h"
#include "devices/plugin/wire_framing.h"

/* No padding that two compilers could choose differently, and `size` and `abi` where every version has them. */
typedef char header_is_packed[sizeof(struct wire_header) == 16 ? 1 : -1];
typedef char geometry_is_packed[sizeof(struct wire_geometry) == 56 ? 1 : -1];
typedef char configure_is_packed[sizeof(struct wire_configure) == 24 ? 1 : -1];
typedef char frame_is_packed[sizeof(struct wire_frame) == 32 ? 1 : -1];
typedef char counts_are_packed[sizeof(struct wire_counts) == 40 ? 1 : -1];

uint32_t sizes_of_tables(const struct focalstage_projector* projector, const struct focalstage_lens_drive* drive);

uint32_t sizes_of_tables(const struct focalstage_projector* projector, const struct focalstage_lens_drive* drive) {
  return *(const uint32_t*)projector + *(const uint32_t*)drive;
}
