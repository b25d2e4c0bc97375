#pragma once

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// A line with its checksum and line feed is no longer than this.
#define FS_LINE_MAX 64u

/// Gathers bytes into lines. All zero is a fresh one.
struct fs_line_reader {
  char text[FS_LINE_MAX + 1];
  uint8_t length;
  bool too_long;
};

enum fs_line_event {
  FS_LINE_NONE,  ///< no line yet
  FS_LINE_OK,    ///< `text` is a line without its checksum, ended by a NUL, until the next byte
  FS_LINE_BAD    ///< a line that was too long, not text, or has no or a wrong checksum; it is gone
};

enum fs_line_event fs_line_push(struct fs_line_reader* reader, char byte);

/// A line being written; what does not fit is dropped, and fs_line_end then gives 0.
struct fs_line_writer {
  char text[FS_LINE_MAX];
  uint8_t length;
  bool too_long;
};

void fs_line_text(struct fs_line_writer* writer, const char* text);
void fs_line_number(struct fs_line_writer* writer, uint32_t number);
/// Adds checksum and line feed; gives the number of bytes to send.
uint8_t fs_line_end(struct fs_line_writer* writer);

/// Reads one word off a line, up to a space or the end, and steps over the one space behind it. NULL: there is none.
const char* fs_take_word(const char** at, uint8_t* length);
/// Reads one decimal number 0..65535 off a line, the same way.
bool fs_take_number(const char** at, uint16_t* number);

#ifdef __cplusplus
}
#endif
