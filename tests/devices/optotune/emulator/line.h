#pragma once

#include <memory>
#include <string>

#include "tests/devices/optotune/emulator/lens_driver.h"

namespace focalstage::optotune_emulator {

/// An emulated lens driver behind a pseudo terminal, in a thread of its own.
class Line {
 public:
  /// Null if no pseudo terminal can be had.
  static std::unique_ptr<Line> open(const Options& options = {});
  virtual ~Line() = default;

  virtual std::string path() const = 0;  ///< of the terminal that a program opens; another after each plugging in
  virtual void misbehave(const Misbehaviour& how) = 0;
  virtual void heat(double celsius) = 0;
  virtual void unplug() = 0;  ///< and without current
  virtual void plug_in() = 0;
  virtual void reset() = 0;  ///< as when its power failed for a moment
  virtual LensDriver snapshot() const = 0;
};

}  // namespace focalstage::optotune_emulator
