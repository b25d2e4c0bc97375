#include "tests/devices/board/board.h"

#include <utility>

#include "tests/devices/uno/emulator/line_sum.h"

namespace focalstage::test {

using uno_emulator::with_sum;
using uno_emulator::without_sum;

Board::Board() : Chip(FOCALSTAGE_FIRMWARE_ELF) {}

void Board::send(std::string_view body) {
  sequence_ = (sequence_ + 1) % 256;
  send_raw(with_sum(std::to_string(sequence_) + " " + std::string(body)) + "\n");
}

std::string Board::ask(std::string_view body) {
  send(body);
  const std::string number = std::to_string(sequence_) + " ";
  for (const auto end = now() + 800'000; now() < end;) {
    run_for(2000);
    hear();
    for (const std::string& line : lines_) {
      if (line.rfind(number, 0) != 0) continue;
      const std::string answer = line.substr(number.size());
      lines_.clear();
      return answer;
    }
  }
  return {};
}

std::vector<std::string> Board::take_lines() {
  hear();
  return std::exchange(lines_, {});
}

void Board::hear() {
  for (const char byte : take_bytes()) {
    if (byte == '\n') {
      take_line(std::exchange(said_, {}));
    } else {
      said_.push_back(byte);
    }
  }
}

void Board::take_line(const std::string& line) {
  const std::string body = without_sum(line);
  if (body.empty()) {
    ++damaged_lines;
  } else {
    lines_.push_back(body);
  }
}

}  // namespace focalstage::test
