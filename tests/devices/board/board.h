#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tests/devices/uno/emulator/chip.h"

namespace focalstage::test {

/// The chip, and a host that talks with it in the chip's own time.
class Board : public uno_emulator::Chip {
 public:
  Board();

  /// Queues a request with number and checksum.
  void send(std::string_view body);
  /// Sends, and waits for the answer to it: what follows the number. Empty: none within 50 ms.
  std::string ask(std::string_view body);
  /// The lines the board said, without their checksums, which were good.
  std::vector<std::string> take_lines();
  /// Lines whose checksum was not, up to the last asking.
  int damaged_lines = 0;

 private:
  void hear();
  void take_line(const std::string& line);

  std::string said_;
  std::vector<std::string> lines_;
  int sequence_ = 0;
};

}  // namespace focalstage::test
