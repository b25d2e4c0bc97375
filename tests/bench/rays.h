#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/base/result.h"
#include "tests/bench/scenes.h"

namespace focalstage::bench {

/// Baseline b: one Embree ray per pixel, eye and slice, as one would write it first, on all threads. The trees are
/// built before the clock runs; the projector's rays and those that ask whether an eye sees a point are traced every
/// frame.
class NaiveRays {
 public:
  static Result<std::shared_ptr<NaiveRays>> of(const BenchScene& scene);
  ~NaiveRays();

  void frame(std::vector<std::uint8_t>& codes) const;

 private:
  struct State;
  explicit NaiveRays(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace focalstage::bench
