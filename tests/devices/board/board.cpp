#include "tests/devices/board/board.h"

#include <simavr/avr_ioport.h>
#include <simavr/avr_timer.h>
#include <simavr/avr_uart.h>
#include <simavr/sim_avr.h>
#include <simavr/sim_elf.h>
#include <simavr/sim_irq.h>
#include <simavr/sim_time.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <utility>

namespace focalstage::test {

namespace {

constexpr Cycle byte_cycles = 1389;  // ten bits at 115200 baud
constexpr Cycle edge_cycles = 1600;  // how long a sync edge stays high

unsigned crc_of(std::string_view text) {
  unsigned crc = 0xFFFF;
  for (const char byte : text) {
    crc ^= static_cast<unsigned>(static_cast<unsigned char>(byte)) << 8;
    for (int bit = 0; bit < 8; ++bit) crc = ((crc << 1) ^ ((crc & 0x8000U) != 0 ? 0x1021U : 0U)) & 0xFFFFU;
  }
  return crc;
}

std::string with_sum(const std::string& body) {
  char sum[8];
  std::snprintf(sum, sizeof sum, "*%04X", crc_of(body));
  return body + sum;
}

void sleep_in_no_time(avr_t*, avr_cycle_count_t) {}

void say_nothing(avr_t*, const int, const char*, va_list) {}

}  // namespace

Board::Board() {
  elf_firmware_t firmware = {};
  if (elf_read_firmware(FOCALSTAGE_BINARY_DIR "/firmware/focalstage-uno.elf", &firmware) != 0) {
    throw std::runtime_error("no firmware to run");
  }
  avr_global_logger_set(say_nothing);
  firmware.frequency = 16000000;
  avr_ = avr_make_mcu_by_name("atmega328p");
  avr_init(avr_);
  avr_load_firmware(avr_, &firmware);
  avr_->frequency = 16000000;
  avr_->sleep = sleep_in_no_time;
  std::uint32_t flags = 0;
  avr_ioctl(avr_, AVR_IOCTL_UART_GET_FLAGS('0'), &flags);
  flags &= ~static_cast<std::uint32_t>(AVR_UART_FLAG_STDIO | AVR_UART_FLAG_POLL_SLEEP);
  avr_ioctl(avr_, AVR_IOCTL_UART_SET_FLAGS('0'), &flags);
  const auto listen = [this](avr_irq_t* irq, avr_irq_notify_t to) { avr_irq_register_notify(irq, to, this); };
  listen(avr_io_getirq(avr_, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_OUTPUT), heard);
  listen(avr_io_getirq(avr_, AVR_IOCTL_IOPORT_GETIRQ('B'), 1), trigger_changed);
  listen(avr_io_getirq(avr_, AVR_IOCTL_IOPORT_GETIRQ('D'), 4), left_changed);
  listen(avr_io_getirq(avr_, AVR_IOCTL_IOPORT_GETIRQ('D'), 5), right_changed);
}

Board::~Board() { avr_terminate(avr_); }

Cycle Board::now() const { return avr_->cycle; }

void Board::run_for(Cycle cycles) {
  const Cycle end = avr_->cycle + cycles;
  while (avr_->cycle < end) {
    const int state = avr_run(avr_);
    if (state == cpu_Done || state == cpu_Crashed) throw std::runtime_error("the chip stopped");
  }
}

void Board::raise_edge() {
  avr_raise_irq(avr_io_getirq(avr_, AVR_IOCTL_IOPORT_GETIRQ('B'), 0), 1);
  edges.push_back(avr_->cycle);
  avr_cycle_timer_register(avr_, edge_cycles, end_edge, this);
}

std::uint64_t Board::next_edge(avr_t*, std::uint64_t, void* self) {
  Board& board = *static_cast<Board*>(self);
  if (board.period_cycles_ <= 0.0) return 0;
  board.raise_edge();
  board.next_edge_ += board.period_cycles_;
  return static_cast<std::uint64_t>(std::llround(board.next_edge_));
}

std::uint64_t Board::end_edge(avr_t* avr, std::uint64_t, void*) {
  avr_raise_irq(avr_io_getirq(avr, AVR_IOCTL_IOPORT_GETIRQ('B'), 0), 0);
  return 0;
}

std::uint64_t Board::stray_edge(avr_t*, std::uint64_t, void* self) {
  static_cast<Board*>(self)->raise_edge();
  return 0;
}

void Board::sync_every(double cycles) {
  avr_cycle_timer_cancel(avr_, next_edge, this);
  period_cycles_ = cycles;
  if (cycles <= 0.0) return;
  next_edge_ = static_cast<double>(avr_->cycle) + cycles;
  avr_cycle_timer_register(avr_, static_cast<Cycle>(std::llround(cycles)), next_edge, this);
}

void Board::stray_edge_in(Cycle cycles) { avr_cycle_timer_register(avr_, cycles, stray_edge, this); }

void Board::send_raw(std::string_view bytes) {
  to_board_.insert(to_board_.end(), bytes.begin(), bytes.end());
  if (!byte_is_due_ && !to_board_.empty()) {
    byte_is_due_ = true;
    avr_cycle_timer_register(avr_, byte_cycles, next_byte, this);
  }
}

std::uint64_t Board::next_byte(avr_t* avr, std::uint64_t when, void* self) {
  Board& board = *static_cast<Board*>(self);
  const auto byte = static_cast<unsigned char>(board.to_board_.front());
  board.to_board_.pop_front();
  avr_raise_irq(avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_INPUT), byte);
  board.byte_is_due_ = !board.to_board_.empty();
  return board.byte_is_due_ ? when + byte_cycles : 0;
}

void Board::send(std::string_view body) {
  sequence_ = (sequence_ + 1) % 256;
  send_raw(with_sum(std::to_string(sequence_) + " " + std::string(body)) + "\n");
}

std::string Board::ask(std::string_view body) {
  send(body);
  const std::string number = std::to_string(sequence_) + " ";
  for (const Cycle end = now() + 800'000; now() < end;) {
    run_for(2000);
    for (const std::string& line : lines_) {
      if (line.rfind(number, 0) != 0) continue;
      const std::string answer = line.substr(number.size());
      lines_.clear();
      return answer;
    }
  }
  return {};
}

std::vector<std::string> Board::take_lines() { return std::exchange(lines_, {}); }

void Board::take_line() {
  const std::size_t star = said_.rfind('*');
  if (star == std::string::npos || with_sum(said_.substr(0, star)) != said_) {
    ++damaged_lines;
  } else {
    lines_.push_back(said_.substr(0, star));
  }
  said_.clear();
}

void Board::heard(avr_irq_t*, std::uint32_t value, void* self) {
  Board& board = *static_cast<Board*>(self);
  if (value == '\n') {
    board.take_line();
  } else {
    board.said_.push_back(static_cast<char>(value));
  }
}

void Board::changed(bool& high, std::vector<PinChange>& changes, std::uint32_t value) {
  // Compare outputs are told twice, once with bit 8 set.
  const bool now_high = (value & 1U) != 0;
  if (now_high == high) return;
  high = now_high;
  changes.push_back({avr_->cycle, now_high});
}

void Board::trigger_changed(avr_irq_t*, std::uint32_t value, void* self) {
  Board& board = *static_cast<Board*>(self);
  board.changed(board.trigger_high, board.trigger, value);
}

void Board::left_changed(avr_irq_t*, std::uint32_t value, void* self) {
  Board& board = *static_cast<Board*>(self);
  board.changed(board.left_high, board.left, value);
}

void Board::right_changed(avr_irq_t*, std::uint32_t value, void* self) {
  Board& board = *static_cast<Board*>(self);
  board.changed(board.right_high, board.right, value);
}

void Board::hang_main_loop() {
  while (avr_->state != cpu_Sleeping) run_for(1);
  // rjmp .-2, after the sleep
  avr_->flash[avr_->pc] = 0xFF;
  avr_->flash[avr_->pc + 1] = 0xCF;
}

}  // namespace focalstage::test
