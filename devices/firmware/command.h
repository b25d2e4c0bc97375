#pragma once

#include "devices/firmware/engine.h"
#include "devices/firmware/line.h"

#ifdef __cplusplus
extern "C" {
#endif

#define FS_PROTOCOL 1u

/// All that lies between two lines of a conversation.
struct fs_conversation {
  struct fs_table* writing;  ///< NULL: no table was begun
  bool committed;
  uint16_t committed_triggers;
  uint16_t bad_lines;
  uint8_t boot_cause;
};

/// Does what a good line says and writes the answer, without its end.
void fs_command(struct fs_conversation* talk, const char* line, struct fs_line_writer* answer);
/// Counts a bad one and says so.
void fs_bad_line(struct fs_conversation* talk, struct fs_line_writer* answer);
void fs_banner(const struct fs_conversation* talk, struct fs_line_writer* answer);

#ifdef __cplusplus
}
#endif
