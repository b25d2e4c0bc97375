#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/result.h"

namespace focalstage {

/// One frame of a video output as it is to arrive, bit by bit: 0x00RRGGBB, rows from the top without padding. Null:
/// black.
using VideoFrame = std::shared_ptr<const std::vector<std::uint32_t>>;

struct VideoMode {
  int width_px = 0;
  int height_px = 0;
  double interval_s = 0.0;  ///< between vblanks, from the mode's own clock

  bool operator==(const VideoMode&) const = default;
};

/// What a display did since it was opened. Each vblank shows a frame that was posted, or black for want of one, or what
/// the one before showed.
struct DisplayReport {
  std::uint64_t vblanks = 0;
  std::uint64_t shown = 0;                ///< frames that were posted
  std::uint64_t dark = 0;                 ///< black frames that were posted
  std::uint64_t silent = 0;               ///< black, because nobody had posted
  std::uint64_t repeated = 0;             ///< the frame before, because this program came too late
  std::optional<double> newest_vblank_s;  ///< when the newest frame began, on the monotonic clock
  std::optional<Fault> fault;             ///< it is lost: nothing more is shown
};

/// A whole video output for prepared frames: no scaling, no colour management, no cursor. It works in a thread of its
/// own, which shows black whenever its feeder is silent for one frame, so that content that stops is dark. Calls may
/// come from any thread.
class Display {
 public:
  Display() = default;
  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;
  virtual ~Display() = default;

  /// Takes the output and shows black. Opening what is open changes nothing; opening again after a loss is `open`
  /// again.
  virtual Status open() = 0;
  /// Black first, then the output as it was before.
  virtual void close() = 0;

  /// As opened.
  virtual VideoMode mode() const = 0;

  /// The frame of the next vblank that has none yet. Does not wait: "display.full" where as many as it takes are
  /// waiting, "display.size" for another size than the mode's, "display.lost" where nothing is shown any more.
  virtual Status post(VideoFrame frame) = 0;
  virtual std::size_t waiting() const = 0;

  /// Forgets what is waiting: black from the next vblank but one on at the latest. Takes no lock that a copy holds.
  virtual void black() noexcept = 0;

  virtual DisplayReport report() const = 0;
};

}  // namespace focalstage
