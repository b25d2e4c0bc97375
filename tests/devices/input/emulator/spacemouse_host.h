#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

using UMockdevTestbed = struct _UMockdevTestbed;

namespace focalstage::spacemouse_emulator {

struct SpaceMouseKind {
  std::uint16_t vendor = 0x256f;
  std::uint16_t product = 0xc635;
  bool combined = false;  ///< turns come in report 1
  std::string serial = "SM-1";
};

/// Counts of its own axes: x right, y towards the user, z down, and the turns about them.
struct Hand {
  int counts[6] = {};
};

/// A SpaceMouse on umockdev's USB, whose reports come 60 times a second while a hand is on it. To be used in a program
/// that runs under umockdev-wrapper.
class SpaceMouseHost {
 public:
  static std::unique_ptr<SpaceMouseHost> start(UMockdevTestbed* bed, const SpaceMouseKind& kind, int first_node = 0);
  virtual ~SpaceMouseHost() = default;

  virtual void hold(const Hand& hand) = 0;
  /// `last_report`: whether it says that the hand is gone.
  virtual void let_go(bool last_report = true) = 0;
  virtual void press(std::uint32_t buttons) = 0;
  virtual void send(std::span<const std::uint8_t> report) = 0;  ///< anything
  virtual std::vector<bool> lamp() const = 0;                   ///< as it was told, in order

  virtual void unplug() = 0;
  virtual void plug() = 0;  ///< again, on another node
  virtual std::string node() const = 0;
};

}  // namespace focalstage::spacemouse_emulator
