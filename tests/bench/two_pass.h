#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/base/result.h"
#include "tests/bench/scenes.h"

namespace focalstage::bench {

/// The paper's two-pass rendering in OpenGL, with read-back. First pass: the objects from the eye, light and depth into
/// one float image of the projector's size over what the eye looks at (and the surfaces' depth where they can hide each
/// other). Second pass: the surfaces from the projector, which look up the eye's image along each slice's looks and
/// weigh what they find. Meshes are uploaded once; a frame begins with matrices and ends with bytes in memory.
class TwoPass {
 public:
  enum class Passes {
    paper,  ///< a1: both passes for every eye and slice
    fused,  ///< a3: the first pass once per eye, the second once per eye into as many targets as there are slices
  };

  static Result<std::shared_ptr<TwoPass>> of(const BenchScene& scene);
  ~TwoPass();

  void frame(Passes passes, std::vector<std::uint8_t>& codes) const;

 private:
  struct State;
  explicit TwoPass(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace focalstage::bench
