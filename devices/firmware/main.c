#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/sleep.h>
#include <avr/wdt.h>

#include "devices/firmware/chip.h"
#include "devices/firmware/command.h"

static uint8_t boot_cause __attribute__((section(".noinit")));

// After a watchdog's reset it stays on, at its shortest: off first of all, before memory is even set up.
void fs_before_main(void) __attribute__((naked, used, section(".init3")));
void fs_before_main(void) {
  boot_cause = MCUSR;
  MCUSR = 0;
  wdt_disable();
}

static void send(struct fs_line_writer* line) { fs_uart_send(line->text, fs_line_end(line)); }

static void hear(struct fs_line_reader* reader, struct fs_conversation* talk) {
  char byte;
  // An answer needs room: until there is some, requests wait.
  if (!fs_uart_room(FS_LINE_MAX) || !fs_uart_take(&byte)) {
    return;
  }
  const enum fs_line_event event = fs_line_push(reader, byte);
  if (event == FS_LINE_NONE) {
    return;
  }
  struct fs_line_writer answer = {.length = 0};
  if (event == FS_LINE_OK) {
    fs_engine_heard_host();
    fs_command(talk, reader->text, &answer);
  } else {
    fs_bad_line(talk, &answer);
  }
  send(&answer);
}

static void tell_darkness(void) {
  if (!fs_uart_room(FS_LINE_MAX)) {
    return;
  }
  const uint8_t reason = fs_engine_dark_unsaid();
  if (reason) {
    struct fs_line_writer line = {.length = 0};
    fs_line_text(&line, "! DARK ");
    fs_line_number(&line, reason);
    send(&line);
  }
}

// Until the next interrupt. One that comes between the question and the sleep still wakes: sei lets one more
// instruction pass.
static void doze(void) {
  cli();
  if (fs_engine_idle() && fs_light_idle() && fs_uart_idle()) {
    sei();
    sleep_cpu();
  }
  sei();
}

int main(void) {
  static struct fs_line_reader reader;
  static struct fs_conversation talk;
  talk.boot_cause = boot_cause;
  fs_engine_start();
  fs_uart_start();
  set_sleep_mode(SLEEP_MODE_IDLE);
  sleep_enable();
  sei();
  struct fs_line_writer banner = {.length = 0};
  fs_banner(&talk, &banner);
  send(&banner);
  for (;;) {
    fs_engine_poll();
    fs_light_poll();
    hear(&reader, &talk);
    tell_darkness();
    doze();
  }
}
