#include "editor/preview/slice_maker.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace focalstage {

CompileSettings SliceMaker::settings_of(const Project& project, Variant variant, int divisor) {
  Project shown = project;
  if (variant == Variant::uncompensated) shown.slices.breathing = Breathing::off;
  if (variant == Variant::conventional) {
    shown.slices.powers_d = {0.0};
    for (Object& object : shown.objects) object.depth = {};
  }
  CompileSettings settings = compile_settings(shown);
  if (divisor > 1) {
    const auto part = [&](int pixels) { return std::max(1, pixels / divisor); };
    settings.projector =
        resized(settings.projector, part(settings.projector.width_px), part(settings.projector.height_px));
    settings.slices.samples_per_pixel = 1;
    // A drag is followed by linear filtering; what it leaves is solved at full size, when the hand rests.
    if (settings.slices.assignment == Assignment::optimal) settings.slices.assignment = Assignment::linear;
  }
  return settings;
}

SliceMaker::Engine& SliceMaker::engine(const CompileSettings& settings, Variant variant, int divisor) {
  const auto key = std::make_pair(variant, divisor);
  const auto found = engines_.find(key);
  if (found != engines_.end() && found->second.settings == settings) return found->second;
  engines_.erase(key);
  return engines_.emplace(key, Engine{settings, Compiler(settings, threads_)}).first->second;
}

Result<CompiledFrame> SliceMaker::make(const Project& project, const Stage& stage, Variant variant, int divisor,
                                       std::stop_token stop) {
  const auto begun = std::chrono::steady_clock::now();
  Engine& used = engine(settings_of(project, variant, divisor), variant, divisor);
  auto frame = used.compiler.frame(stage, std::move(stop));
  if (frame && variant == Variant::shown) {
    took_ms_[divisor] = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun).count();
  }
  return frame;
}

int SliceMaker::divisor_within(double within_ms) const {
  for (const int divisor : {1, 2, 4}) {
    const auto known = took_ms_.find(divisor);
    if (known != took_ms_.end() && known->second <= within_ms) return divisor;
    // Unknown: as its whole size says, in proportion to the pixels, with a fifth of it for what does not shrink.
    const auto whole = took_ms_.find(1);
    const double share = 0.2 + 0.8 / (divisor * divisor);
    if (known == took_ms_.end() && whole != took_ms_.end() && whole->second * share <= within_ms) return divisor;
  }
  return 4;
}

}  // namespace focalstage
