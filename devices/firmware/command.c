#include "devices/firmware/command.h"

#include "devices/firmware/light.h"

static bool is_word(const char* word, uint8_t length, const char* expected) {
  for (uint8_t i = 0; i < length; ++i) {
    if (word[i] != expected[i]) {
      return false;
    }
  }
  return expected[length] == '\0';
}

// One letter of two, as a word of its own: 0 or 1; 2 if it is neither.
static uint8_t take_choice(const char** at, char first, char second) {
  uint8_t length = 0;
  const char* word = fs_take_word(at, &length);
  if (!word || length != 1u) {
    return 2;
  }
  return *word == first ? 0 : *word == second ? 1 : 2;
}

static bool take_two(const char** at, uint16_t* first, uint16_t* second) {
  return fs_take_number(at, first) && fs_take_number(at, second) && **at == '\0';
}

static enum fs_error begin_table(struct fs_conversation* talk, const char* at) {
  uint16_t period = 0;
  uint16_t width = 0;
  if (!take_two(&at, &period, &width)) {
    return FS_UNKNOWN;
  }
  struct fs_table* table = fs_engine_begin();
  if (!table) {
    return FS_NOT_NOW;
  }
  talk->writing = table;
  talk->committed = false;
  fs_table_begin(talk->writing, period, width);
  return FS_OK;
}

static enum fs_error set_trigger(struct fs_conversation* talk, const char* at) {
  uint16_t index = 0;
  uint16_t time = 0;
  if (!take_two(&at, &index, &time)) {
    return FS_UNKNOWN;
  }
  return talk->writing ? fs_table_trigger(talk->writing, index, time) : FS_NO_TABLE;
}

static enum fs_error set_shutter(struct fs_conversation* talk, const char* at) {
  const uint8_t eye = take_choice(&at, 'L', 'R');
  uint16_t open = 0;
  uint16_t close = 0;
  if (eye > 1 || !take_two(&at, &open, &close)) {
    return FS_UNKNOWN;
  }
  return talk->writing ? fs_table_shutter(talk->writing, (enum fs_eye)eye, open, close) : FS_NO_TABLE;
}

static enum fs_error commit(struct fs_conversation* talk, const char* at) {
  uint16_t triggers = 0;
  if (!fs_take_number(&at, &triggers) || *at) {
    return FS_UNKNOWN;
  }
  if (!talk->writing) {
    // Said again because the answer was lost.
    return talk->committed && triggers == talk->committed_triggers ? FS_OK : FS_NO_TABLE;
  }
  const enum fs_error error = fs_table_check(talk->writing, triggers);
  if (error == FS_OK) {
    talk->writing = 0;
    talk->committed = true;
    talk->committed_triggers = triggers;
    fs_engine_commit();
  }
  return error;
}

static enum fs_error set_polarity(const char* at) {
  const uint8_t eye = take_choice(&at, 'L', 'R');
  const uint8_t level = take_choice(&at, 'L', 'H');
  return eye > 1 || level > 1 || *at ? FS_UNKNOWN : fs_engine_polarity((enum fs_eye)eye, level == 1);
}

static void tell_name(const struct fs_conversation* talk, struct fs_line_writer* answer) {
  fs_line_text(answer, "focalstage-uno ");
  fs_line_number(answer, FS_PROTOCOL);
  fs_line_text(answer, " ");
  fs_line_number(answer, talk->boot_cause);
}

static void tell_status(const struct fs_conversation* talk, struct fs_line_writer* answer) {
  struct fs_status status;
  fs_engine_status(&status);
  const uint16_t numbers[6] = {status.state,  status.reason, status.tables,
                               status.period, status.edges,  talk->bad_lines};
  for (uint8_t i = 0; i < 6; ++i) {
    fs_line_text(answer, i ? " " : "");
    fs_line_number(answer, numbers[i]);
  }
}

static enum fs_error look(const char* at) {
  uint16_t input = 0;
  uint16_t after = 0;
  uint16_t samples = 0;
  if (!fs_take_number(&at, &input) || !take_two(&at, &after, &samples)) {
    return FS_UNKNOWN;
  }
  return fs_light_look(input, after, samples);
}

static void tell_light(struct fs_line_writer* answer) {
  struct fs_light light;
  fs_light_status(&light);
  fs_line_text(answer, "OK ");
  fs_line_number(answer, light.state);
  fs_line_text(answer, " ");
  fs_line_number(answer, light.after);
  fs_line_text(answer, " ");
  fs_line_number(answer, light.samples);
}

// Up to 16 samples in one line, three hex digits each.
#define SAMPLES_PER_LINE 16u

static enum fs_error tell_samples(const char* at, struct fs_line_writer* answer) {
  static const char digits[] = "0123456789ABCDEF";
  uint16_t from = 0;
  if (!fs_take_number(&at, &from) || *at) {
    return FS_UNKNOWN;
  }
  struct fs_light light;
  fs_light_status(&light);
  if (light.state != FS_LIGHT_WHOLE) {
    return FS_NOT_NOW;
  }
  if (from >= light.samples) {
    return FS_RANGE;
  }
  fs_line_text(answer, "OK ");
  for (uint16_t i = from; i < light.samples && i < from + SAMPLES_PER_LINE; ++i) {
    const uint16_t value = fs_light_sample(i);
    const char text[4] = {digits[value >> 8 & 15u], digits[value >> 4 & 15u], digits[value & 15u], '\0'};
    fs_line_text(answer, text);
  }
  return FS_OK;
}

static void tell_lens(struct fs_line_writer* answer) {
  struct fs_lens lens;
  fs_engine_lens(&lens);
  fs_line_text(answer, "OK ");
  fs_line_number(answer, lens.after);
  fs_line_text(answer, " ");
  fs_line_number(answer, lens.edges);
}

static void finish(struct fs_line_writer* answer, enum fs_error error) {
  if (error == FS_OK) {
    fs_line_text(answer, "OK");
    return;
  }
  fs_line_text(answer, "ERR ");
  fs_line_number(answer, error);
}

static enum fs_error arm(const char* at) { return *at ? FS_UNKNOWN : fs_engine_arm(); }

static void ask(const struct fs_conversation* talk, const char* name, uint8_t length, struct fs_line_writer* answer) {
  if (is_word(name, length, "HELLO")) {
    fs_line_text(answer, "OK ");
    tell_name(talk, answer);
  } else if (is_word(name, length, "STAT")) {
    fs_line_text(answer, "OK ");
    tell_status(talk, answer);
  } else if (is_word(name, length, "LENS")) {
    tell_lens(answer);
  } else if (is_word(name, length, "SEEN")) {
    tell_light(answer);
  } else if (is_word(name, length, "TEST")) {
    uint8_t failed = 0;
    const enum fs_error error = fs_engine_test(&failed);
    finish(answer, error);
    if (error == FS_OK) {
      fs_line_text(answer, " ");
      fs_line_number(answer, failed);
    }
  } else if (is_word(name, length, "BLINK")) {
    finish(answer, fs_engine_blink());
  } else {
    finish(answer, is_word(name, length, "PING") ? FS_OK : FS_UNKNOWN);
  }
}

void fs_command(struct fs_conversation* talk, const char* line, struct fs_line_writer* answer) {
  uint16_t sequence = 0;
  uint8_t length = 0;
  const char* at = line;
  const bool numbered = fs_take_number(&at, &sequence) && sequence <= 255u;
  const char* name = numbered ? fs_take_word(&at, &length) : 0;
  if (!name) {
    fs_line_text(answer, "! ");
    finish(answer, FS_UNKNOWN);
    return;
  }
  fs_line_number(answer, sequence);
  fs_line_text(answer, " ");
  if (is_word(name, length, "TABLE")) {
    finish(answer, begin_table(talk, at));
  } else if (is_word(name, length, "TRIG")) {
    finish(answer, set_trigger(talk, at));
  } else if (is_word(name, length, "OPEN")) {
    finish(answer, set_shutter(talk, at));
  } else if (is_word(name, length, "COMMIT")) {
    finish(answer, commit(talk, at));
  } else if (is_word(name, length, "ARM")) {
    finish(answer, arm(at));
  } else if (is_word(name, length, "POL")) {
    finish(answer, set_polarity(at));
  } else if (is_word(name, length, "LOOK")) {
    finish(answer, look(at));
  } else if (is_word(name, length, "DATA")) {
    const enum fs_error error = tell_samples(at, answer);
    if (error != FS_OK) {
      finish(answer, error);
    }
  } else if (is_word(name, length, "SAFE")) {
    fs_engine_dark(FS_TOLD);  // whatever else the line says
    finish(answer, FS_OK);
  } else {
    ask(talk, name, length, answer);
  }
}

void fs_bad_line(struct fs_conversation* talk, struct fs_line_writer* answer) {
  ++talk->bad_lines;
  fs_line_text(answer, "! ");
  finish(answer, FS_CHECKSUM);
}

void fs_banner(const struct fs_conversation* talk, struct fs_line_writer* answer) {
  fs_line_text(answer, "! BOOT ");
  tell_name(talk, answer);
}
