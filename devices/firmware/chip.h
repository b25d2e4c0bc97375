#pragma once

#include <stdbool.h>
#include <stdint.h>

#include "devices/firmware/engine.h"

/// Pins, timer and watchdog, everything dark.
void fs_engine_start(void);
/// Once per turn of the main loop: period, silence, watchdog.
void fs_engine_poll(void);
/// Nothing to do before the next interrupt; asked with interrupts off.
bool fs_engine_idle(void);
void fs_engine_heard_host(void);
/// Once per darkness that was not told: its reason; else 0.
uint8_t fs_engine_dark_unsaid(void);

/// Begins what fs_light_look asked for, once its time has come; not idle while it waits for that.
void fs_light_poll(void);
bool fs_light_idle(void);

/// 115200 baud, a ring each way between interrupts and the main loop.
void fs_uart_start(void);
bool fs_uart_take(char* byte);
bool fs_uart_room(uint8_t bytes);
void fs_uart_send(const char* bytes, uint8_t count);
bool fs_uart_idle(void);
