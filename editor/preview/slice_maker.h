#pragma once

#include <map>
#include <memory>
#include <optional>
#include <stop_token>

#include "core/compile/compile.h"
#include "editor/preview/preview_values.h"

namespace focalstage {

/// Compiles a stage at full, half or quarter size, with one engine kept for each, since an engine keeps what did not
/// change from one frame to the next.
class SliceMaker {
 public:
  explicit SliceMaker(int threads) : threads_(threads) {}

  enum class Variant { shown, uncompensated, conventional };

  /// The images of `stage` under the project's slices, those without breathing compensation, or the single slice at
  /// 0 D that a projection without focal sweep would show.
  Result<CompiledFrame> make(const Project& project, const Stage& stage, Variant variant, int divisor,
                             std::stop_token stop);

  /// Smaller sizes are for moving hands: one sample per pixel, and linear filtering for `optimal`.
  static CompileSettings settings_of(const Project& project, Variant variant, int divisor);

  /// The smallest of 1, 2 and 4 at which a compile probably takes no longer than `within_ms`.
  int divisor_within(double within_ms) const;

 private:
  struct Engine {
    CompileSettings settings;
    Compiler compiler;
  };
  Engine& engine(const CompileSettings& settings, Variant variant, int divisor);

  int threads_;
  std::map<std::pair<Variant, int>, Engine> engines_;
  std::map<int, double> took_ms_;  ///< by divisor, lately
};

}  // namespace focalstage
