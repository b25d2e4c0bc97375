#include "devices/firmware/line.h"

#include "devices/firmware/crc16.h"

// "*" and four digits
#define CHECKSUM_LENGTH 5u

static uint16_t crc_of(const char* text, uint8_t length) {
  uint16_t crc = FS_CRC16_START;
  for (uint8_t i = 0; i < length; ++i) {
    crc = fs_crc16(crc, (uint8_t)text[i]);
  }
  return crc;
}

static char hex_digit(uint16_t value) {
  value &= 15u;
  return (char)(value < 10 ? '0' + value : 'A' + (value - 10));
}

static bool strip_checksum(struct fs_line_reader* reader) {
  if (reader->length <= CHECKSUM_LENGTH) {
    return false;
  }
  const uint8_t body = (uint8_t)(reader->length - CHECKSUM_LENGTH);
  const uint16_t crc = crc_of(reader->text, body);
  const char* sum = reader->text + body;
  if (sum[0] != '*' || sum[1] != hex_digit(crc >> 12) || sum[2] != hex_digit(crc >> 8) ||
      sum[3] != hex_digit(crc >> 4) || sum[4] != hex_digit(crc)) {
    return false;
  }
  reader->text[body] = '\0';
  return true;
}

enum fs_line_event fs_line_push(struct fs_line_reader* reader, char byte) {
  if (byte == '\n') {
    const bool good = !reader->too_long && strip_checksum(reader);
    reader->length = 0;
    reader->too_long = false;
    return good ? FS_LINE_OK : FS_LINE_BAD;
  }
  if (byte < ' ' || byte > '~' || reader->length + 1u >= FS_LINE_MAX) {
    reader->too_long = true;
    return FS_LINE_NONE;
  }
  reader->text[reader->length++] = byte;
  return FS_LINE_NONE;
}

static void put(struct fs_line_writer* writer, char byte) {
  // Room for the checksum and the line feed stays free.
  if (writer->length + CHECKSUM_LENGTH + 1u >= FS_LINE_MAX) {
    writer->too_long = true;
    return;
  }
  writer->text[writer->length++] = byte;
}

void fs_line_text(struct fs_line_writer* writer, const char* text) {
  while (*text) {
    put(writer, *text++);
  }
}

void fs_line_number(struct fs_line_writer* writer, uint32_t number) {
  char digits[10];
  uint8_t count = 0;
  do {
    digits[count++] = (char)('0' + number % 10u);
    number /= 10u;
  } while (number);
  while (count) {
    put(writer, digits[--count]);
  }
}

uint8_t fs_line_end(struct fs_line_writer* writer) {
  if (writer->too_long) {
    return 0;
  }
  const uint16_t crc = crc_of(writer->text, writer->length);
  char* at = writer->text + writer->length;
  *at++ = '*';
  for (uint8_t shift = 16; shift; shift = (uint8_t)(shift - 4u)) {
    *at++ = hex_digit((uint16_t)(crc >> (shift - 4u)));
  }
  *at = '\n';
  return (uint8_t)(writer->length + CHECKSUM_LENGTH + 1u);
}

const char* fs_take_word(const char** at, uint8_t* length) {
  const char* begin = *at;
  const char* end = begin;
  while (*end && *end != ' ') {
    ++end;
  }
  if (end == begin) {
    return 0;
  }
  *length = (uint8_t)(end - begin);
  *at = *end ? end + 1 : end;
  return begin;
}

bool fs_take_number(const char** at, uint16_t* number) {
  uint8_t length = 0;
  const char* digits = fs_take_word(at, &length);
  if (!digits || length > 5u) {
    return false;
  }
  uint32_t value = 0;
  for (uint8_t i = 0; i < length; ++i) {
    if (digits[i] < '0' || digits[i] > '9') {
      return false;
    }
    value = value * 10u + (uint32_t)(digits[i] - '0');
  }
  *number = (uint16_t)value;
  return value <= 65535u;
}
