#include "tests/devices/input/emulator/spacemouse_host.h"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <mutex>
#include <optional>
#include <thread>

#include "tests/support/hidraw_node.h"

namespace focalstage::spacemouse_emulator {

namespace {

using Bytes = std::vector<std::uint8_t>;

// A multi-axis controller of the generic desktop: reports 1 and 2 of three axes, 3 of buttons, 4 of the lamp.
const std::string report_descriptor =
    "05010908A101A100850116A2FE265E010930093109327510950381"
    "06C0"
    "A1008502093309340935751095038106C0"
    "A10285030509190129021500250175019502810295"
    "0E8103C0"
    "A10285040508094B15002501950175019102950175079103C0C0";

void append(Bytes& bytes, int counts) {
  const auto word = static_cast<std::uint16_t>(static_cast<std::int16_t>(counts));
  bytes.push_back(static_cast<std::uint8_t>(word & 0xffU));
  bytes.push_back(static_cast<std::uint8_t>(word >> 8U));
}

support::HidIdentity identity_of(const SpaceMouseKind& kind) {
  return {kind.vendor, kind.product, "3Dconnexion", "SpaceMouse", kind.serial, report_descriptor};
}

class Host final : public SpaceMouseHost {
 public:
  Host(UMockdevTestbed* bed, const SpaceMouseKind& kind, int first_node)
      : combined_(kind.combined),
        node_(bed, identity_of(kind), first_node,
              [this](int descriptor, const std::stop_token& stop) { serve(descriptor, stop); }) {}

  std::string node() const override { return node_.path(); }
  void plug() override { node_.plug(); }
  void unplug() override { node_.unplug(); }

  void hold(const Hand& hand) override {
    const std::lock_guard lock(mutex_);
    hand_ = hand;
  }

  void let_go(bool last_report) override {
    const std::lock_guard lock(mutex_);
    hand_.reset();
    if (last_report) report_axes(Hand{});
  }

  void press(std::uint32_t buttons) override {
    const std::lock_guard lock(mutex_);
    to_send_.push_back({3, static_cast<std::uint8_t>(buttons), static_cast<std::uint8_t>(buttons >> 8U)});
  }

  void send(std::span<const std::uint8_t> report) override {
    const std::lock_guard lock(mutex_);
    to_send_.emplace_back(report.begin(), report.end());
  }

  std::vector<bool> lamp() const override {
    const std::lock_guard lock(mutex_);
    return lamp_;
  }

 private:
  void report_axes(const Hand& hand) {
    Bytes push{1};
    Bytes turn{2};
    for (int i = 0; i < 3; ++i) append(push, hand.counts[i]);
    for (int i = 3; i < 6; ++i) append(combined_ ? push : turn, hand.counts[i]);
    to_send_.push_back(push);
    if (!combined_) to_send_.push_back(turn);
  }

  /// One report in 8 ms: what stands in for the line is a stream, and two reports at once would be read as one.
  void serve(int descriptor, const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      Bytes next;
      {
        const std::lock_guard lock(mutex_);
        if (to_send_.empty() && hand_) report_axes(*hand_);
        if (!to_send_.empty()) {
          next = to_send_.front();
          to_send_.erase(to_send_.begin());
        }
      }
      if (!next.empty()) (void)!::write(descriptor, next.data(), next.size());
      take_lamp(descriptor);
      std::this_thread::sleep_for(std::chrono::milliseconds(8));
    }
  }

  void take_lamp(int descriptor) {
    pollfd polled{descriptor, POLLIN, 0};
    if (::poll(&polled, 1, 0) <= 0 || (polled.revents & POLLIN) == 0) return;
    std::array<std::uint8_t, 64> buffer{};
    const ssize_t got = ::read(descriptor, buffer.data(), buffer.size());
    const std::lock_guard lock(mutex_);
    for (ssize_t i = 0; i + 1 < got; i += 2) {
      const auto at = static_cast<std::size_t>(i);
      if (buffer[at] == 4) lamp_.push_back(buffer[at + 1] == 1);
    }
  }

  bool combined_;
  mutable std::mutex mutex_;
  std::optional<Hand> hand_;
  std::vector<Bytes> to_send_;
  std::vector<bool> lamp_;
  support::HidrawNode node_;  // last: it serves
};

}  // namespace

std::unique_ptr<SpaceMouseHost> SpaceMouseHost::start(UMockdevTestbed* bed, const SpaceMouseKind& kind,
                                                      int first_node) {
  return std::make_unique<Host>(bed, kind, first_node);
}

}  // namespace focalstage::spacemouse_emulator
