#include "devices/firmware/engine.h"

#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/wdt.h>
#include <util/atomic.h>

#include "devices/firmware/chip.h"
#include "devices/firmware/period.h"

#define TRIGGER_PIN (1u << PB1)
#define LEFT_PIN (1u << PD4)
#define RIGHT_PIN (1u << PD5)
#define SHUTTER_PINS (LEFT_PIN | RIGHT_PIN)
#define LAMP_PIN (1u << PB5)
#define LENS_PIN (1u << PD2)

// From an edge at the lens pin to the reading of the timer, as tests/devices/board finds it.
#define LENS_LATENCY_TICKS 3u

#define LOST_TICKS (25u * FS_TICKS_PER_MS)
#define SILENT_TICKS (500ul * FS_TICKS_PER_MS)
#define BLINK_TICKS (125ul * FS_TICKS_PER_MS)
#define BLINK_TURNS 10u

// The tables and who may touch them: `in_use` belongs to the interrupts, the other one to the main loop until it is
// `committed`.
static struct fs_table tables[2];
static volatile uint8_t in_use;
static volatile bool committed;
static volatile uint16_t taken;

static volatile uint8_t state;
static volatile uint8_t reason;
static volatile bool unsaid;
static uint8_t opens_high;

// From the capture interrupt to the main loop.
static volatile uint16_t edge;
static volatile uint16_t edges;
static volatile uint16_t measured;
static volatile bool fresh;
static volatile bool has_edge;
// And back.
static volatile uint16_t shortest;
static volatile uint16_t longest;
static volatile int16_t ratio[2];
static volatile bool ratio_known[2];
static volatile bool alive;

// From the lens interrupt.
static volatile uint16_t lens_after;
static volatile uint16_t lens_edges;

// This period's, of the interrupts alone.
static int16_t ratio_now;
static uint8_t next_trigger;
static bool pulse;
static uint8_t next_change;
static uint16_t change_due;

static struct fs_period period;
static uint16_t polled;
static uint32_t silence;
static uint32_t since_turn;
static uint8_t turns_left;

// ---- pins; interrupts are off ----

static void write_shutters(uint8_t open) {
  const uint8_t wanted = (uint8_t)((open & 1u ? LEFT_PIN : 0u) | (open & 2u ? RIGHT_PIN : 0u));
  PORTD = (uint8_t)((PORTD & ~SHUTTER_PINS) | (~(wanted ^ opens_high) & SHUTTER_PINS));
}

// The compare unit's own level must be low before it gets the pin, or every pulse would be its opposite: cleared by a
// forced match while the pin is an input.
static void connect_trigger(void) {
  DDRB &= (uint8_t)~TRIGGER_PIN;
  TCCR1A = 1 << COM1A1;
  TCCR1C = 1 << FOC1A;
  TCCR1A = 1 << COM1A0;
  PORTB &= (uint8_t)~TRIGGER_PIN;
  DDRB |= TRIGGER_PIN;
}

static void disconnect_trigger(void) {
  TIMSK1 &= (uint8_t) ~(1 << OCIE1A);
  TCCR1A = 0;
  PORTB &= (uint8_t)~TRIGGER_PIN;
}

static void go_dark(enum fs_reason why) {
  disconnect_trigger();
  TIMSK1 &= (uint8_t) ~(1 << OCIE1B);
  write_shutters(0);
  if (state != FS_SAFE) {
    state = FS_SAFE;
    reason = (uint8_t)why;
    unsaid = why != FS_TOLD;
  }
}

// ---- the period as it runs; interrupts are off ----

static bool in_time(uint16_t target) { return (int16_t)(target - TCNT1) > 2; }

static void await_trigger(const struct fs_table* table) {
  if (next_trigger == table->triggers) {
    TIMSK1 &= (uint8_t) ~(1 << OCIE1A);
    return;
  }
  const uint16_t target = (uint16_t)(edge + fs_scale(table->trigger[next_trigger], ratio_now));
  OCR1A = target;
  if (!in_time(target)) {
    go_dark(FS_LATE);
  }
}

static void await_change(const struct fs_table* table) {
  while (next_change < table->changes) {
    change_due = (uint16_t)(edge + fs_scale(table->change_at[next_change], ratio_now));
    OCR1B = change_due;
    if (in_time(change_due)) {
      return;
    }
    write_shutters(table->change_to[next_change++]);
  }
  TIMSK1 &= (uint8_t) ~(1 << OCIE1B);
}

static void begin_period(void) {
  const uint8_t now = in_use;
  const struct fs_table* table = &tables[now];
  if (!ratio_known[now]) {
    go_dark(FS_SYNC_LOST);
    return;
  }
  ratio_now = ratio[now];
  next_trigger = 0;
  pulse = false;
  next_change = 0;
  if (!table->triggers) {
    disconnect_trigger();
  } else {
    if (!TCCR1A) {
      connect_trigger();
    }
    TIMSK1 |= 1 << OCIE1A;
    TIFR1 = 1 << OCF1A;
    await_trigger(table);
  }
  if (state == FS_SAFE) {
    return;
  }
  state = FS_RUNNING;
  write_shutters(table->open_at_edge);
  TIMSK1 |= 1 << OCIE1B;
  TIFR1 = 1 << OCF1B;
  await_change(table);
}

ISR(TIMER1_CAPT_vect) {
  const uint16_t stamp = ICR1;
  const uint16_t ticks = (uint16_t)(stamp - edge);
  edge = stamp;
  ++edges;
  if (!has_edge) {
    has_edge = true;
    return;
  }
  measured = ticks;
  fresh = true;
  const bool late = state == FS_RUNNING && (pulse || next_trigger != tables[in_use].triggers);
  if (committed) {
    committed = false;
    in_use ^= 1u;
    ++taken;
  }
  if (state == FS_SAFE) {
    return;
  }
  if (ticks < shortest || ticks > longest) {
    go_dark(FS_SYNC_LOST);
  } else if (late) {
    go_dark(FS_LATE);
  } else {
    begin_period();
  }
  if (alive) {
    alive = false;
    wdt_reset();
  }
}

ISR(TIMER1_COMPA_vect) {
  const struct fs_table* table = &tables[in_use];
  pulse = !pulse;
  if (pulse) {
    const uint16_t target = (uint16_t)(OCR1A + table->width);
    OCR1A = target;
    if (!in_time(target) || !(PINB & TRIGGER_PIN)) {
      go_dark(FS_LATE);
    }
  } else if (PINB & TRIGGER_PIN) {
    go_dark(FS_LATE);
  } else {
    ++next_trigger;
    await_trigger(table);
  }
}

// First what is due, then the sums for the next.
ISR(TIMER1_COMPB_vect) {
  const struct fs_table* table = &tables[in_use];
  if (next_change < table->changes && !in_time(change_due)) {
    write_shutters(table->change_to[next_change++]);
  }
  await_change(table);
}

// Only a time: what it means is the host's to judge.
ISR(INT0_vect) {
  lens_after = (uint16_t)(TCNT1 - LENS_LATENCY_TICKS - edge);
  ++lens_edges;
}

// Wakes the main loop every 1.024 ms, to look for what did not happen.
EMPTY_INTERRUPT(TIMER0_OVF_vect)

// ---- the main loop's side ----

void fs_engine_start(void) {
  write_shutters(0);
  DDRD |= SHUTTER_PINS;
  PORTB &= (uint8_t)~TRIGGER_PIN;
  PORTB &= (uint8_t)~LAMP_PIN;
  DDRB |= TRIGGER_PIN | LAMP_PIN;
  TCCR1A = 0;
  TCCR1B = 1 << ICNC1 | 1 << ICES1 | 1 << CS11;  // noise filter, rising edge, clock / 8
  TIMSK1 = 1 << ICIE1;
  DDRD &= (uint8_t)~LENS_PIN;
  PORTD |= LENS_PIN;  // a pin that nothing is wired to stands still
  EICRA = 1 << ISC01 | 1 << ISC00;
  EIFR = 1 << INTF0;
  EIMSK = 1 << INT0;
  TCCR0B = 1 << CS01 | 1 << CS00;
  TIMSK0 = 1 << TOIE0;
  wdt_enable(WDTO_30MS);
}

static void update_ratio(uint8_t which) {
  int16_t value = 0;
  const bool known = fs_period_locked(&period) && fs_period_ratio(&period, tables[which].period, &value);
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    ratio[which] = value;
    ratio_known[which] = known;
  }
}

static void take_period(uint16_t ticks) {
  uint16_t low = 0;
  uint16_t high = 0;
  fs_period_measured(&period, ticks);
  fs_period_bounds(&period, &low, &high);
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    shortest = low;
    longest = high;
  }
  update_ratio(0);
  update_ratio(1);
}

static void lose_sync(void) {
  period.good = 0;
  update_ratio(0);
  update_ratio(1);
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    has_edge = false;
    go_dark(FS_SYNC_LOST);
  }
}

// One instruction each turn: interrupts write other pins of this port.
static void blink(uint16_t passed) {
  since_turn += passed;
  if (!turns_left || since_turn < BLINK_TICKS) {
    return;
  }
  since_turn = 0;
  --turns_left;
  PINB = LAMP_PIN;  // toggles it
}

void fs_engine_poll(void) {
  uint16_t now;
  uint16_t since_edge;
  uint16_t ticks;
  bool is_fresh;
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    now = TCNT1;
    since_edge = (uint16_t)(now - edge);
    ticks = measured;
    is_fresh = fresh;
    fresh = false;
  }
  if (is_fresh) {
    take_period(ticks);
  }
  if (has_edge && since_edge > LOST_TICKS) {
    lose_sync();
  }
  const uint16_t passed = (uint16_t)(now - polled);
  polled = now;
  blink(passed);
  silence += passed;
  if (silence > SILENT_TICKS) {
    silence = SILENT_TICKS;
    ATOMIC_BLOCK(ATOMIC_RESTORESTATE) { go_dark(FS_HOST_SILENT); }
  }
  alive = true;
  if (state == FS_SAFE) {
    wdt_reset();
  }
}

bool fs_engine_idle(void) { return !fresh && !unsaid; }

void fs_engine_heard_host(void) { silence = 0; }

uint8_t fs_engine_dark_unsaid(void) {
  uint8_t why = 0;
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    if (unsaid) {
      unsaid = false;
      why = reason;
    }
  }
  return why;
}

struct fs_table* fs_engine_begin(void) {
  struct fs_table* table = 0;
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    // Dropping the one that was armed for would begin with an older one, or with none.
    if (state != FS_WAITING || !committed) {
      committed = false;
      table = &tables[in_use ^ 1u];
    }
  }
  return table;
}

void fs_engine_commit(void) {
  update_ratio(in_use ^ 1u);
  committed = true;
}

enum fs_error fs_engine_arm(void) {
  enum fs_error error = FS_OK;
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    const uint8_t next = committed ? in_use ^ 1u : in_use;
    if (!committed && !taken) {
      error = FS_NO_TABLE;
    } else if (!ratio_known[next]) {
      error = FS_NOT_SYNCED;
    } else if (state == FS_SAFE) {
      state = FS_WAITING;
      wdt_reset();
    }
  }
  return error;
}

void fs_engine_dark(enum fs_reason why) {
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) { go_dark(why); }
}

enum fs_error fs_engine_polarity(enum fs_eye eye, bool high_opens) {
  if (state != FS_SAFE) {
    return FS_NOT_NOW;
  }
  const uint8_t pin = eye == FS_LEFT ? LEFT_PIN : RIGHT_PIN;
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    opens_high = (uint8_t)(high_opens ? opens_high | pin : opens_high & ~pin);
    write_shutters(0);
  }
  return FS_OK;
}

static uint8_t shutters_wrong(uint8_t open) {
  write_shutters(open);
  __asm__ volatile("nop\n nop");  // a pin is read two cycles after it was written
  return (uint8_t)((PIND ^ PORTD) & SHUTTER_PINS);
}

enum fs_error fs_engine_test(uint8_t* failed) {
  if (state != FS_SAFE) {
    return FS_NOT_NOW;
  }
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    uint8_t wrong = shutters_wrong(1);
    wrong |= shutters_wrong(2);
    wrong |= shutters_wrong(0);
    *failed = (uint8_t)((wrong & LEFT_PIN ? 1u : 0u) | (wrong & RIGHT_PIN ? 2u : 0u) | (PINB & TRIGGER_PIN ? 4u : 0u));
  }
  return FS_OK;
}

enum fs_error fs_engine_blink(void) {
  if (state != FS_SAFE) {
    return FS_NOT_NOW;
  }
  // An even number of turns: it ends as it began, dark.
  turns_left = (uint8_t)(BLINK_TURNS + (turns_left & 1u));
  return FS_OK;
}

void fs_engine_status(struct fs_status* status) {
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    status->state = state;
    status->reason = reason;
    status->tables = taken;
    status->edges = edges;
  }
  status->period = fs_period_locked(&period) ? (uint16_t)((period.mean_q8 + 128u) >> 8) : 0;
}

void fs_engine_lens(struct fs_lens* lens) {
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    lens->after = lens_after;
    lens->edges = lens_edges;
  }
}
