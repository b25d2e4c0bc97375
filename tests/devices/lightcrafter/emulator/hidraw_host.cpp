#include "tests/devices/lightcrafter/emulator/hidraw_host.h"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <thread>

#include "tests/support/hidraw_node.h"

namespace focalstage::lightcrafter_emulator {

namespace {

support::HidIdentity identity_of(const std::string& serial) {
  return {0x0451,    0x6401, "Texas Instruments",
          "DLPC350", serial, "0600FF0901A1010901150026FF007508954081020901150026FF00750895409102C0"};
}

class Host final : public HidrawHost {
 public:
  Host(UMockdevTestbed* bed, Board& board, const std::string& serial, int first_node)
      : board_(board), node_(bed, identity_of(serial), first_node, [this](int descriptor, const std::stop_token& stop) {
          serve(descriptor, stop);
        }) {}

  std::string node() const override { return node_.path(); }
  void plug() override { node_.plug(); }
  void unplug() override { node_.unplug(); }

 private:
  void serve(int descriptor, const std::stop_token& stop) {
    Bytes bytes;
    while (!stop.stop_requested()) {
      pollfd polled{descriptor, POLLIN, 0};
      if (::poll(&polled, 1, 5) <= 0) continue;
      if ((polled.revents & POLLIN) == 0) {  // nobody has it open
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        continue;
      }
      std::array<std::uint8_t, 650> buffer{};
      const ssize_t got = ::read(descriptor, buffer.data(), buffer.size());
      if (got > 0) bytes.insert(bytes.end(), buffer.begin(), buffer.begin() + got);
      while (bytes.size() >= 65) {  // a report number that is none comes first
        const Answers answers = board_.take(std::span(bytes).subspan(1, 64));
        bytes.erase(bytes.begin(), bytes.begin() + 65);
        if (answers.gone) {
          node_.leave();
          return;
        }
        if (answers.delay_s > 0.0) std::this_thread::sleep_for(std::chrono::duration<double>(answers.delay_s));
        for (const Bytes& report : answers.reports) (void)!::write(descriptor, report.data(), report.size());
      }
    }
  }

  Board& board_;
  support::HidrawNode node_;  // last: it serves
};

}  // namespace

std::unique_ptr<HidrawHost> HidrawHost::start(UMockdevTestbed* bed, Board& board, const std::string& serial,
                                              int first_node) {
  return std::make_unique<Host>(bed, board, serial, first_node);
}

}  // namespace focalstage::lightcrafter_emulator
