#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <deque>
#include <memory>
#include <thread>

#include "devices/lightcrafter/link.h"
#include "tests/devices/lightcrafter/emulator/board.h"

namespace focalstage::lightcrafter {

/// The emulated board without a transport: reports go straight to it. `plugged` is shared: a test pulls it.
class BoardReports final : public Reports {
 public:
  BoardReports(lightcrafter_emulator::Board& board, std::shared_ptr<std::atomic<bool>> plugged)
      : board_(board), plugged_(std::move(plugged)) {}

  bool write(const Report& report) override {
    if (!*plugged_) return false;
    const auto answers = board_.take(report);
    if (answers.gone) *plugged_ = false;
    const auto at =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(answers.delay_s));
    for (const auto& bytes : answers.reports) answers_.push_back({at, bytes});
    return true;
  }

  Got read(Report& report, int timeout_ms) override {
    const auto until = Clock::now() + std::chrono::milliseconds(timeout_ms);
    while (answers_.empty() || answers_.front().at > Clock::now()) {
      if (!*plugged_) return Got::gone;
      if (Clock::now() >= until) return Got::nothing;
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
    const auto bytes = std::move(answers_.front().bytes);
    answers_.pop_front();
    if (bytes.size() != report.size()) return Got::nothing;
    std::ranges::copy(bytes, report.begin());
    return Got::report;
  }

 private:
  using Clock = std::chrono::steady_clock;
  struct Coming {
    Clock::time_point at;
    lightcrafter_emulator::Bytes bytes;
  };
  lightcrafter_emulator::Board& board_;
  std::shared_ptr<std::atomic<bool>> plugged_;
  std::deque<Coming> answers_;
};

}  // namespace focalstage::lightcrafter
