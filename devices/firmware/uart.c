#include <avr/interrupt.h>
#include <avr/io.h>

#include "devices/firmware/chip.h"
#include "devices/firmware/line.h"

// Rings of a power of two; places wrap by themselves under the mask.
#define RING 128u

static volatile char received[RING];
static volatile uint8_t received_end;
static uint8_t received_begin;
static volatile char sending[RING];
static volatile uint8_t sending_begin;
static volatile uint8_t sending_end;

void fs_uart_start(void) {
  UCSR0A = 1 << U2X0;
  UBRR0 = 16;  // 117647 baud: 2.1 % off 115200, exactly what the Uno's USB bridge makes of it too
  UCSR0C = 1 << UCSZ01 | 1 << UCSZ00;
  UCSR0B = 1 << RXCIE0 | 1 << RXEN0 | 1 << TXEN0;
}

ISR(USART_RX_vect) {
  const char byte = (char)UDR0;
  const uint8_t end = received_end;
  // A ring that runs over overwrites its oldest: the checksum tells.
  received[end & (RING - 1u)] = byte;
  received_end = (uint8_t)(end + 1u);
}

bool fs_uart_take(char* byte) {
  if (received_begin == received_end) {
    return false;
  }
  *byte = received[received_begin & (RING - 1u)];
  ++received_begin;
  return true;
}

bool fs_uart_room(uint8_t bytes) { return (uint8_t)(sending_end - sending_begin) + bytes <= RING; }

void fs_uart_send(const char* bytes, uint8_t count) {
  uint8_t end = sending_end;
  for (uint8_t i = 0; i < count; ++i) {
    sending[end++ & (RING - 1u)] = bytes[i];
  }
  sending_end = end;
  UCSR0B |= 1 << UDRIE0;
}

ISR(USART_UDRE_vect) {
  const uint8_t begin = sending_begin;
  if (begin == sending_end) {
    UCSR0B &= (uint8_t) ~(1 << UDRIE0);
    return;
  }
  UDR0 = (uint8_t)sending[begin & (RING - 1u)];
  sending_begin = (uint8_t)(begin + 1u);
}

bool fs_uart_idle(void) { return received_begin == received_end || !fs_uart_room(FS_LINE_MAX); }
