#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "core/base/sides.h"
#include "tests/devices/uno/emulator/emulator.h"
#include "tests/rig/emulator/optics.h"

namespace focalstage::rig_emulator {

/// A line on a card, lit by its own pixels for each eye.
struct LineOnCard {
  double power_d = 0.0;  ///< of the lens, at which it is sharp on the slit
  PerEye<PixelRectangle> rectangle_px;
};

struct PhotodiodesSettings {
  std::string firmware_elf;
  std::string board_link;  ///< empty: there are none
  double board_clock_ppm = -700.0;
  std::vector<LineOnCard> lines{{-1.0, {{300, 200, 4, 300}, {620, 200, 4, 300}}},
                                {1.0, {{340, 200, 4, 300}, {660, 200, 4, 300}}}};
  double slit_d = 0.125;  ///< so far out of focus, a point is as wide as the slit
  // Shares of the converter's range.
  double white = 0.6;  ///< of the whole picture at full light
  double line = 0.4;   ///< of a line at full light, sharp
  double ambient = 0.03;
  double noise = 0.002;
};

/// What stands before a diode at an instant.
struct BeforeDiode {
  double power_d = 0.0;
  double transmission = 0.0;
};

/// The bench of docs/self-test.md: two photodiodes behind slits, in place of the eyes, at a second board of their own.
class Photodiodes {
 public:
  using Look = std::function<BeforeDiode(Side eye, double time_s)>;

  Photodiodes(const PhotodiodesSettings& settings, Look look);

  /// The pixels whose light must be told apart, in the order in which `Begun::levels` has them.
  static std::vector<PixelRectangle> regions(const PhotodiodesSettings& settings);

  /// The rig's sync edge, device time.
  void edge_at(double time_s);
  void lit(const Begun& light) { lit_.push_back(light); }
  /// To that device time, up to which all that is lit and what stands before the diodes is known.
  void advance_to(double time_s);

 private:
  double share(int input, double time_s);
  double board_hz() const;

  PhotodiodesSettings settings_;
  Look look_;
  uno_emulator::UnoEmulator board_;
  std::deque<Begun> lit_;
  std::mt19937 random_{11};
};

}  // namespace focalstage::rig_emulator
