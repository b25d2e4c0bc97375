#include "tests/devices/board/board.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <doctest/doctest.h>

// Records of the analogue inputs, by the firmware on a simulated chip.

using focalstage::test::Board;
using focalstage::uno_emulator::Cycle;

namespace {

constexpr double period_60_hz = 16e6 / 60.0;
constexpr Cycle ms = 16'000;

/// SEEN's numbers.
struct Seen {
  int state = -1;
  int after = 0;
  int samples = 0;
};

Seen seen(Board& board) {
  Seen found;
  const std::string answer = board.ask("SEEN");
  REQUIRE(std::sscanf(answer.c_str(), "OK %d %d %d", &found.state, &found.after, &found.samples) == 3);
  return found;
}

std::vector<int> data(Board& board, int samples) {
  std::vector<int> codes;
  while (static_cast<int>(codes.size()) < samples) {
    const std::string answer = board.ask("DATA " + std::to_string(codes.size()));
    REQUIRE(answer.rfind("OK ", 0) == 0);
    for (std::size_t i = 3; i + 2 < answer.size(); i += 3) codes.push_back(std::stoi(answer.substr(i, 3), nullptr, 16));
  }
  return codes;
}

/// A voltage that rises through the whole period: its code says when a sample was held.
struct Ramp {
  Board board;

  explicit Ramp(double period_cycles = period_60_hz) {
    board.set_analogue([this, period_cycles](int input, double cycle) {
      if (board.edges.empty()) return 0.0;
      const double since = (cycle - static_cast<double>(board.edges.back())) / period_cycles;
      return input == 1 ? since : 1.0 - since;
    });
    board.run_for(2 * ms);
    board.sync_every(period_cycles);
    board.run_for(100 * ms);
  }
};

TEST_CASE("a record begins about when it was asked to, and says when it really did") {
  for (const double period : {period_60_hz, 1.005 * period_60_hz, 0.995 * period_60_hz}) {
    Ramp ramp(period);
    for (const int after : {0, 100, 4001, 20000}) {
      CAPTURE(after);
      REQUIRE(ramp.board.ask("LOOK 1 " + std::to_string(after) + " 240") == "OK");
      ramp.board.run_for(45 * ms);
      const Seen found = seen(ramp.board);
      REQUIRE(found.state == 2);
      CHECK(found.samples == 240);
      CHECK(found.after >= after);
      // Right after an edge the main loop works out the period first.
      CHECK(found.after < std::max(after, 400) + 120);
      const std::vector<int> codes = data(ramp.board, 240);
      double worst_ticks = 0.0;
      for (std::size_t i = 0; i < codes.size(); ++i) {
        const double told = found.after + 52.0 * static_cast<double>(i);
        const double held = (codes[i] + 0.5) / 1023.0 * period / 8.0;
        worst_ticks = std::max(worst_ticks, std::abs(held - told));
      }
      // A code is 33 ticks wide; the stamp is good to two.
      CHECK(worst_ticks < 33.0 / 2.0 + 4.0);
    }
  }
}

TEST_CASE("the stamp of the first sample is good to two ticks") {
  Ramp ramp;
  double sum = 0.0;
  int count = 0;
  for (int n = 0; n < 6; ++n) {
    REQUIRE(ramp.board.ask("LOOK 1 " + std::to_string(3000 + 7 * n) + " 240") == "OK");
    ramp.board.run_for(45 * ms);
    const Seen found = seen(ramp.board);
    REQUIRE(found.state == 2);
    const std::vector<int> codes = data(ramp.board, 240);
    for (std::size_t i = 0; i < codes.size(); ++i) {
      sum += (codes[i] + 0.5) / 1023.0 * period_60_hz / 8.0 - found.after - 52.0 * static_cast<double>(i);
      ++count;
    }
  }
  // What is left of the codes' width over so many samples is far below a tick.
  MESSAGE("held ", sum / count, " ticks after its stamp");
  CHECK(std::abs(sum / count) < 2.0);
}

TEST_CASE("inputs are told apart, and requests that cannot be are refused") {
  Ramp ramp;
  Board& board = ramp.board;
  CHECK(board.ask("SEEN") == "OK 0 0 0");
  CHECK(board.ask("DATA 0") == "ERR 7");
  REQUIRE(board.ask("LOOK 0 1000 20") == "OK");
  CHECK(board.ask("DATA 0") == "ERR 7");
  board.run_for(40 * ms);
  const std::vector<int> falls = data(board, 20);
  CHECK(falls.front() > 900);
  CHECK(falls.back() < falls.front());
  CHECK(board.ask("DATA 20") == "ERR 3");
  CHECK(board.ask("DATA") == "ERR 1");
  CHECK(board.ask("LOOK 6 1000 20") == "ERR 3");
  CHECK(board.ask("LOOK 0 1000 241") == "ERR 3");
  CHECK(board.ask("LOOK 0 1000 0") == "ERR 3");
  CHECK(board.ask("LOOK 0 50000 20") == "ERR 3");
  CHECK(board.ask("LOOK 0 1000") == "ERR 1");
}

TEST_CASE("without edges nothing begins; while armed nothing is looked at") {
  Ramp ramp;
  Board& board = ramp.board;
  board.sync_every(0.0);
  board.run_for(40 * ms);
  REQUIRE(board.ask("LOOK 0 1000 20") == "OK");
  board.run_for(100 * ms);
  CHECK(seen(board).state == 1);
  board.sync_every(period_60_hz);
  board.run_for(100 * ms);
  CHECK(seen(board).state == 2);
  REQUIRE(board.ask("TABLE 33333 100") == "OK");
  REQUIRE(board.ask("TRIG 0 5000") == "OK");
  REQUIRE(board.ask("COMMIT 1") == "OK");
  REQUIRE(board.ask("ARM") == "OK");
  CHECK(board.ask("LOOK 0 1000 20") == "ERR 7");
  REQUIRE(board.ask("SAFE") == "OK");
  CHECK(board.ask("LOOK 0 1000 20") == "OK");
}

}  // namespace
