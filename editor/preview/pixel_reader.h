#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/base/sides.h"
#include "editor/preview/preview_values.h"

namespace focalstage {

/// What one slice does at a pixel.
struct SliceReading {
  double power_d = 0.0;
  int code = 0;           ///< of the image, its largest channel
  std::string object;     ///< that it shows there; empty: none
  double wanted_d = 0.0;  ///< the power that would put it where it is wanted
  double weight = 0.0;    ///< how much of it this slice carries
};

/// Everything about one pixel of the projector, for one eye.
struct PixelReading {
  glm::ivec2 pixel{0};      ///< of the full-size image
  std::string surface;      ///< that it lights; empty: none, and nothing else is known
  glm::dvec3 point_m{0.0};  ///< where, in the world
  bool seen = false;        ///< by the eye: no other surface hides it
  double surface_m = 0.0;   ///< d_p: axial, from the lens centre
  std::vector<SliceReading> slices;
};

/// Reads pixels behind the window by the chain of the reference, link by link: it shares no shortcut with the engine.
class PixelReader {
 public:
  explicit PixelReader(std::function<void()> wake);
  ~PixelReader();
  PixelReader(const PixelReader&) = delete;
  PixelReader& operator=(const PixelReader&) = delete;

  /// Asks about a pixel of `compiled`, in pixels of its images; the newest question is the only one.
  void ask(std::shared_ptr<const CompiledSlices> compiled, Side side, glm::ivec2 pixel);

  /// The answer to the last question, once there; null before.
  std::shared_ptr<const PixelReading> answer() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace focalstage
