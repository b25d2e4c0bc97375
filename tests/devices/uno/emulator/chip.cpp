#include "tests/devices/uno/emulator/chip.h"

#include <simavr/avr_adc.h>
#include <simavr/avr_ioport.h>
#include <simavr/avr_timer.h>
#include <simavr/avr_uart.h>
#include <simavr/avr_watchdog.h>
#include <simavr/sim_avr.h>
#include <simavr/sim_elf.h>
#include <simavr/sim_irq.h>
#include <simavr/sim_time.h>

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace focalstage::uno_emulator {

namespace {

constexpr Cycle byte_cycles = 10 * 136;  // start, 8 data, stop; UBRR 16 with U2X
constexpr Cycle edge_cycles = 1600;      // how long a sync edge stays high
constexpr double watchdog_hz = 128e3;
constexpr Cycle conversion_cycles = 416;  // 13 clocks of 32
constexpr double held_cycles = 48.0;      // 1.5 of them after it began

void sleep_in_no_time(avr_t*, avr_cycle_count_t) {}

void say_nothing(avr_t*, const int, const char*, va_list) {}

/// simavr's own state of one of the chip's parts; each begins with the part's head.
template <class T>
T* part(avr_t* avr, const char* kind) {
  for (avr_io_t* io = avr->io_port; io != nullptr; io = io->next) {
    if (std::strcmp(io->kind, kind) == 0) return reinterpret_cast<T*>(io);
  }
  throw std::runtime_error("the chip lacks a part");
}

}  // namespace

Chip::Chip(const std::string& firmware_elf) {
  avr_global_logger_set(say_nothing);
  elf_firmware_t firmware = {};
  if (elf_read_firmware(firmware_elf.c_str(), &firmware) != 0) {
    throw std::runtime_error(firmware_elf + " is no firmware to run");
  }
  firmware.frequency = 16000000;
  avr_ = avr_make_mcu_by_name("atmega328p");
  avr_init(avr_);
  avr_load_firmware(avr_, &firmware);
  avr_->frequency = 16000000;
  avr_->vcc = avr_->avcc = 5000;
  avr_->sleep = sleep_in_no_time;
  std::uint32_t flags = 0;
  avr_ioctl(avr_, AVR_IOCTL_UART_GET_FLAGS('0'), &flags);
  flags &= ~static_cast<std::uint32_t>(AVR_UART_FLAG_STDIO | AVR_UART_FLAG_POLL_SLEEP);
  avr_ioctl(avr_, AVR_IOCTL_UART_SET_FLAGS('0'), &flags);
  uart_ = part<avr_uart_t>(avr_, "uart");
  watchdog_ = part<avr_watchdog_t>(avr_, "watchdog");
  avr_->custom.data = this;
  own_reset_ = std::exchange(avr_->reset, was_reset);
  listen();
}

Chip::~Chip() { avr_terminate(avr_); }

void Chip::listen() {
  const auto on = [this](std::uint32_t of, int pin, avr_irq_notify_t tell) {
    avr_irq_register_notify(avr_io_getirq(avr_, of, pin), tell, this);
  };
  on(AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_OUTPUT, said);
  on(AVR_IOCTL_ADC_GETIRQ, ADC_IRQ_OUT_TRIGGER, converts);
  on(AVR_IOCTL_IOPORT_GETIRQ('B'), 1, trigger_changed);
  on(AVR_IOCTL_IOPORT_GETIRQ('B'), 5, lamp_changed);
  on(AVR_IOCTL_IOPORT_GETIRQ('D'), 4, left_changed);
  on(AVR_IOCTL_IOPORT_GETIRQ('D'), 5, right_changed);
}

Cycle Chip::now() const { return avr_->cycle; }

// A sleeping chip goes on to the next thing that is due: this is one, and stays it until the chip has stopped. A chip
// that falls asleep in the very cycle would go on to what comes after, and be ahead of the world.
std::uint64_t Chip::halt(avr_t*, std::uint64_t when, void*) { return when + 1; }

void Chip::run_until(Cycle at) {
  if (avr_->cycle >= at) return;
  halt_at_ = at;
  avr_cycle_timer_register(avr_, at - avr_->cycle, halt, this);
  while (avr_->cycle < at) {
    mend_timing();
    const int state = avr_run(avr_);
    if (state == cpu_Done || state == cpu_Crashed) throw std::runtime_error("the chip stopped");
  }
  avr_cycle_timer_cancel(avr_, halt, this);
}

// simavr 1.6 (to 1.8 at least) counts a parity bit into every frame, also where none is set: 11 bits of time instead of
// 10. Bytes that come as fast as a real line brings them then run over. And its watchdog knows no tolerance.
void Chip::mend_timing() {
  if (uart_->cycles_per_byte == byte_cycles / 10 * 11) uart_->cycles_per_byte = byte_cycles;
  if (watchdog_slowness_ == 1.0) return;
  const double cycles = 2048.0 * (1U << avr_regbit_get_array(avr_, watchdog_->wdp, 4));
  watchdog_->cycle_count = static_cast<avr_cycle_count_t>(cycles * watchdog_slowness_ * 16e6 / watchdog_hz);
}

// A reset, the watchdog's too, forgets all that is due, also what is not the chip's: the world outside goes on.
void Chip::was_reset(avr_t* avr) {
  Chip& chip = *static_cast<Chip*>(avr->custom.data);
  if (chip.own_reset_ != nullptr) chip.own_reset_(avr);
  if (chip.hung_at_) chip.swap_hang();
  chip.hung_at_.reset();
  const auto due = [&](Cycle at, avr_cycle_timer_t what) {
    avr_cycle_timer_register(avr, at > avr->cycle ? at - avr->cycle : 1, what, &chip);
  };
  due(chip.halt_at_, halt);
  if (chip.byte_is_due_) due(avr->cycle + byte_cycles, next_byte);
  if (chip.period_cycles_ > 0.0) due(static_cast<Cycle>(std::llround(chip.next_edge_)), next_edge);
  if (!chip.single_edges_.empty()) due(*chip.single_edges_.begin(), single_edge);
  due(avr->cycle + edge_cycles, end_edge);
  if (!chip.lens_edges_.empty()) due(*chip.lens_edges_.begin(), lens_edge);
}

void Chip::raise_edge() {
  avr_raise_irq(avr_io_getirq(avr_, AVR_IOCTL_IOPORT_GETIRQ('B'), 0), 1);
  edges.push_back(avr_->cycle);
  avr_cycle_timer_register(avr_, edge_cycles, end_edge, this);
}

std::uint64_t Chip::next_edge(avr_t*, std::uint64_t, void* self) {
  Chip& chip = *static_cast<Chip*>(self);
  if (chip.period_cycles_ <= 0.0) return 0;
  chip.raise_edge();
  chip.next_edge_ += chip.period_cycles_;
  return static_cast<std::uint64_t>(std::llround(chip.next_edge_));
}

std::uint64_t Chip::end_edge(avr_t* avr, std::uint64_t, void*) {
  avr_raise_irq(avr_io_getirq(avr, AVR_IOCTL_IOPORT_GETIRQ('B'), 0), 0);
  return 0;
}

std::uint64_t Chip::single_edge(avr_t*, std::uint64_t, void* self) {
  Chip& chip = *static_cast<Chip*>(self);
  chip.raise_edge();
  chip.single_edges_.erase(chip.single_edges_.begin());
  return chip.single_edges_.empty() ? 0 : *chip.single_edges_.begin();
}

void Chip::edge_at(Cycle at) {
  if (at <= now()) {
    raise_edge();
    return;
  }
  const auto place = single_edges_.insert(at);
  if (place == single_edges_.begin()) avr_cycle_timer_register(avr_, at - now(), single_edge, this);
}

// What stands at the pin is told to the port as well: else each writing of the port's other pins would show the pin's
// own pull-up for a moment, as an edge.
void Chip::set_lens_pin(bool high) {
  avr_ioport_external_t level{};
  level.mask = 1U << 2;
  level.value = high ? 1U << 2 : 0;
  avr_ioctl(avr_, AVR_IOCTL_IOPORT_SET_EXTERNAL('D'), &level);
  avr_raise_irq(avr_io_getirq(avr_, AVR_IOCTL_IOPORT_GETIRQ('D'), 2), high ? 1 : 0);
}

std::uint64_t Chip::lens_edge(avr_t* avr, std::uint64_t, void* self) {
  Chip& chip = *static_cast<Chip*>(self);
  chip.set_lens_pin(true);
  avr_cycle_timer_register(avr, edge_cycles, end_lens_edge, &chip);
  chip.lens_edges_.erase(chip.lens_edges_.begin());
  return chip.lens_edges_.empty() ? 0 : *chip.lens_edges_.begin();
}

std::uint64_t Chip::end_lens_edge(avr_t*, std::uint64_t, void* self) {
  static_cast<Chip*>(self)->set_lens_pin(false);
  return 0;
}

void Chip::lens_edge_at(Cycle at) {
  at = std::max(at, now() + 1);
  const auto place = lens_edges_.insert(at);
  if (place == lens_edges_.begin()) avr_cycle_timer_register(avr_, at - now(), lens_edge, this);
}

void Chip::sync_every(double cycles) {
  avr_cycle_timer_cancel(avr_, next_edge, this);
  period_cycles_ = cycles;
  if (cycles <= 0.0) return;
  next_edge_ = static_cast<double>(avr_->cycle) + cycles;
  avr_cycle_timer_register(avr_, static_cast<Cycle>(std::llround(cycles)), next_edge, this);
}

void Chip::send_raw(std::string_view bytes) {
  to_chip_.insert(to_chip_.end(), bytes.begin(), bytes.end());
  if (!byte_is_due_ && !to_chip_.empty()) {
    byte_is_due_ = true;
    avr_cycle_timer_register(avr_, byte_cycles, next_byte, this);
  }
}

// simavr takes a byte when its first bit begins, and keeps 64. A real chip keeps two, and the one that is coming in: a
// fourth that begins is lost.
void Chip::receive(std::uint8_t byte) {
  const unsigned unread = (0U + uart_->input.write - uart_->input.read) % uart_fifo_fifo_size;
  if (unread > 2) ++overruns;
  avr_raise_irq(avr_io_getirq(avr_, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_INPUT), byte);
}

// simavr reads the voltage when the program reads the result, and by then the next conversion has begun: so it is given
// shortly before each end. Its conversions take a cycle too long; the world is looked at as a real chip would.
void Chip::converts(avr_irq_t*, std::uint32_t value, void* self) {
  Chip& chip = *static_cast<Chip*>(self);
  const Cycle at = chip.avr_->cycle;
  const bool follows = at - chip.newest_conversion_ < conversion_cycles + 8;
  chip.conversions_ = follows ? chip.conversions_ + 1 : 0;
  if (!follows) chip.first_conversion_ = at;
  chip.newest_conversion_ = at;
  chip.mux_ = value;
  avr_cycle_timer_register(chip.avr_, conversion_cycles - 8, converted, &chip);
}

std::uint64_t Chip::converted(avr_t* avr, std::uint64_t, void* self) {
  Chip& chip = *static_cast<Chip*>(self);
  avr_adc_mux_t mux{};
  std::memcpy(&mux, &chip.mux_, sizeof chip.mux_);
  const double held = static_cast<double>(chip.first_conversion_ + chip.conversions_ * conversion_cycles) + held_cycles;
  const double share = chip.analogue_ ? chip.analogue_(static_cast<int>(mux.src), held) : 0.0;
  const auto millivolts = static_cast<std::uint32_t>(std::lround(5000.0 * std::clamp(share, 0.0, 1.0)));
  avr_raise_irq(avr_io_getirq(avr, AVR_IOCTL_ADC_GETIRQ, ADC_IRQ_ADC0 + static_cast<int>(mux.src)), millivolts);
  return 0;
}

std::uint64_t Chip::next_byte(avr_t*, std::uint64_t when, void* self) {
  Chip& chip = *static_cast<Chip*>(self);
  const auto byte = static_cast<std::uint8_t>(chip.to_chip_.front());
  chip.to_chip_.pop_front();
  chip.receive(byte);
  chip.byte_is_due_ = !chip.to_chip_.empty();
  return chip.byte_is_due_ ? when + byte_cycles : 0;
}

std::string Chip::take_bytes() { return std::exchange(bytes_, {}); }

void Chip::said(avr_irq_t*, std::uint32_t value, void* self) {
  static_cast<Chip*>(self)->bytes_.push_back(static_cast<char>(value));
}

void Chip::changed(bool& high, std::vector<PinChange>& changes, std::uint32_t value) {
  // Compare outputs are told twice, once with bit 8 set.
  const bool now_high = (value & 1U) != 0;
  if (now_high == high) return;
  high = now_high;
  changes.push_back({avr_->cycle, now_high});
}

void Chip::trigger_changed(avr_irq_t*, std::uint32_t value, void* self) {
  Chip& chip = *static_cast<Chip*>(self);
  chip.changed(chip.trigger_high, chip.trigger, value);
}

void Chip::left_changed(avr_irq_t*, std::uint32_t value, void* self) {
  Chip& chip = *static_cast<Chip*>(self);
  chip.changed(chip.left_high, chip.left, value);
}

void Chip::right_changed(avr_irq_t*, std::uint32_t value, void* self) {
  Chip& chip = *static_cast<Chip*>(self);
  chip.changed(chip.right_high, chip.right, value);
}

void Chip::lamp_changed(avr_irq_t*, std::uint32_t value, void* self) {
  Chip& chip = *static_cast<Chip*>(self);
  chip.changed(chip.lamp_high, chip.lamp, value);
}

void Chip::reset() { avr_reset(avr_); }

void Chip::hang_main_loop() {
  while (avr_->state != cpu_Sleeping) run_for(1);
  hung_at_ = avr_->pc;
  swap_hang();
}

// rjmp .-2, after the sleep
void Chip::swap_hang() {
  std::swap(avr_->flash[*hung_at_], hang_[0]);
  std::swap(avr_->flash[*hung_at_ + 1], hang_[1]);
}

void Chip::forget() {
  edges.clear();
  trigger.clear();
  left.clear();
  right.clear();
  lamp.clear();
}

}  // namespace focalstage::uno_emulator
