#include "tests/devices/optotune/emulator/line.h"

#include <fcntl.h>
#include <pty.h>
#include <termios.h>
#include <unistd.h>

#include <chrono>
#include <mutex>
#include <thread>

namespace focalstage::optotune_emulator {

namespace {

constexpr int tick_ms = 2;

class LiveLine final : public Line {
 public:
  explicit LiveLine(const Options& options) : driver_(options) {
    plug_in();
    thread_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
  }
  ~LiveLine() override {
    thread_.request_stop();
    thread_.join();
    unplug();
  }

  bool good() const { return master_ >= 0; }

  std::string path() const override {
    const std::lock_guard lock(mutex_);
    return path_;
  }
  void misbehave(const Misbehaviour& how) override {
    const std::lock_guard lock(mutex_);
    how_ = how;
    answered_ = 0;
  }
  void heat(double celsius) override {
    const std::lock_guard lock(mutex_);
    driver_.celsius = celsius;
  }
  void reset() override {
    const std::lock_guard lock(mutex_);
    driver_.reset();
  }
  LensDriver snapshot() const override {
    const std::lock_guard lock(mutex_);
    return driver_;
  }
  void unplug() override {
    const std::lock_guard lock(mutex_);
    hang_up();
  }
  void plug_in() override {
    const std::lock_guard lock(mutex_);
    hang_up();
    int slave = -1;
    char name[128] = {};
    if (::openpty(&master_, &slave, name, nullptr, nullptr) != 0) return;
    termios raw{};
    ::tcgetattr(slave, &raw);
    ::cfmakeraw(&raw);
    ::tcsetattr(slave, TCSANOW, &raw);
    slave_ = slave;  // kept open, so that the line does not hang up while no program has it
    ::fcntl(master_, F_SETFL, O_NONBLOCK);
    path_ = name;
  }

 private:
  // With the lock.
  void hang_up() {
    if (master_ >= 0) ::close(master_);
    if (slave_ >= 0) ::close(slave_);
    master_ = slave_ = -1;
    driver_.reset();
  }

  void serve(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(tick_ms));
      Bytes out;
      double delay_s = 0.0;
      {
        const std::lock_guard lock(mutex_);
        std::uint8_t buffer[256];
        const ssize_t count = master_ >= 0 ? ::read(master_, buffer, sizeof buffer) : 0;
        if (count <= 0) continue;
        out = driver_.take(std::span(buffer, static_cast<std::size_t>(count)), how_);
        delay_s = how_.delay_s;
      }
      if (delay_s > 0.0) std::this_thread::sleep_for(std::chrono::duration<double>(delay_s));
      send(out);
    }
  }

  void send(const Bytes& bytes) {
    const std::lock_guard lock(mutex_);
    for (const std::uint8_t byte : bytes) {
      if (how_.hang_up_at && answered_ >= *how_.hang_up_at) return hang_up();
      if (master_ < 0 || ::write(master_, &byte, 1) != 1) return;
      ++answered_;
    }
  }

  mutable std::mutex mutex_;
  LensDriver driver_;
  Misbehaviour how_;
  std::size_t answered_ = 0;
  int master_ = -1;
  int slave_ = -1;
  std::string path_;
  std::jthread thread_;
};

}  // namespace

std::unique_ptr<Line> Line::open(const Options& options) {
  auto line = std::make_unique<LiveLine>(options);
  if (!line->good()) return nullptr;
  return line;
}

}  // namespace focalstage::optotune_emulator
