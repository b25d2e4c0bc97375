#include "devices/firmware/light.h"

#include <avr/interrupt.h>
#include <avr/io.h>
#include <util/atomic.h>

#include "devices/firmware/chip.h"
#include "devices/firmware/engine.h"
#include "devices/firmware/period.h"

// The converter runs at 500 kHz: a conversion takes 13 of its clocks, and holds its input 1.5 after it began.
#define CONVERTER (1u << ADEN | 1u << ADPS2 | 1u << ADPS0)
#define FREE_RUNNING (CONVERTER | 1u << ADSC | 1u << ADATE | 1u << ADIF | 1u << ADIE)
// From the moment its input is held to the reading of the timer in the interrupt: 11.5 of those clocks and the
// interrupt's entry, as tests/devices/board finds it.
#define HELD_BEFORE_TICKS 50u
// From the order to begin to the first held input.
#define BEGIN_TICKS 10u
// An interrupt that is later than that has missed a sample.
#define LATE_TICKS 44u

static uint16_t sample[FS_LIGHT_SAMPLES_MAX];
static volatile uint8_t state;
static volatile uint16_t count;
static volatile uint16_t earliest;  // when the first sample was read, as the most punctual interrupt says
static uint16_t wanted;
static uint16_t begin_at;
static uint16_t edge;
static bool begun;

enum fs_error fs_light_look(uint16_t input, uint16_t after, uint16_t samples) {
  struct fs_status engine;
  fs_engine_status(&engine);
  if (engine.state != FS_SAFE) {
    return FS_NOT_NOW;
  }
  if (input >= FS_LIGHT_INPUTS || after > FS_PERIOD_MAX || samples == 0 || samples > FS_LIGHT_SAMPLES_MAX) {
    return FS_RANGE;
  }
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    // The first conversion is longer than the others: one for nothing.
    ADMUX = (uint8_t)(1u << REFS0 | input);
    ADCSRB = 0;
    DIDR0 = 0x3f;
    ADCSRA = CONVERTER | 1u << ADSC;
    edge = ICR1;
    begun = false;
    wanted = samples;
    begin_at = after > BEGIN_TICKS ? (uint16_t)(after - BEGIN_TICKS) : 0u;
    count = 0;
    state = FS_LIGHT_WAITING;
  }
  return FS_OK;
}

void fs_light_poll(void) {
  if (state != FS_LIGHT_WAITING || begun || (ADCSRA & 1u << ADSC)) {
    return;
  }
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    const uint16_t newest = ICR1;
    if (newest != edge && (uint16_t)(TCNT1 - newest) >= begin_at) {
      edge = newest;
      begun = true;
      ADCSRA = FREE_RUNNING;
    }
  }
}

bool fs_light_idle(void) { return state != FS_LIGHT_WAITING || begun; }

ISR(ADC_vect) {
  const uint16_t now = TCNT1;
  const uint16_t value = ADC;
  const uint16_t n = count;
  if (state != FS_LIGHT_WAITING) {
    return;
  }
  const uint16_t first = (uint16_t)(now - n * FS_LIGHT_TICKS);
  if (n == 0 || (int16_t)(first - earliest) < 0) {
    earliest = first;
  }
  sample[n] = value;
  count = n + 1u;
  const bool late = (uint16_t)(first - earliest) > LATE_TICKS;
  if (late || n + 1u == wanted) {
    ADCSRA = CONVERTER;
    state = late ? FS_LIGHT_LOST : FS_LIGHT_WHOLE;
  }
}

void fs_light_status(struct fs_light* light) {
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    light->state = state;
    light->after = count ? (uint16_t)(earliest - HELD_BEFORE_TICKS - edge) : 0u;
    light->samples = count;
  }
}

uint16_t fs_light_sample(uint16_t index) { return sample[index]; }
