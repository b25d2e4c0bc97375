#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/base/result.h"
#include "tests/bench/scenes.h"

namespace focalstage::bench {

/// Baseline b: a ray of Embree per pixel, eye and slice, on all threads. The trees are built before the clock runs.
class NaiveRays {
 public:
  static Result<std::shared_ptr<NaiveRays>> of(const BenchScene& scene);
  ~NaiveRays();

  enum class Hits {
    anew,  ///< b: each eye and slice is an image of its own, from the projector's ray on; only what is hidden is kept
    kept,  ///< what the projector meets is traced once per eye and serves all its slices
  };

  void frame(Hits hits, std::vector<std::uint8_t>& codes) const;

 private:
  struct State;
  explicit NaiveRays(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace focalstage::bench
