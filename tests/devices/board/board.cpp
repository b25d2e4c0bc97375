#include "tests/devices/board/board.h"

#include <cstdio>
#include <utility>

namespace focalstage::test {

namespace {

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

}  // namespace

Board::Board() : Chip(FOCALSTAGE_BINARY_DIR "/firmware/focalstage-uno.elf") {}

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
  const std::size_t star = line.rfind('*');
  if (star == std::string::npos || with_sum(line.substr(0, star)) != line) {
    ++damaged_lines;
  } else {
    lines_.push_back(line.substr(0, star));
  }
}

}  // namespace focalstage::test
