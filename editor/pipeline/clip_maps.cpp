#include "editor/pipeline/clip_maps.h"

#include <algorithm>
#include <cmath>

#include "core/compile/compile.h"
#include "core/compile/surface_gain.h"
#include "core/stage/stage.h"

namespace focalstage {
namespace {

std::uint8_t marked(double share) {
  constexpr double least = 64.0;
  return share > 0.0 ? static_cast<std::uint8_t>(std::lround(least + (255.0 - least) * std::min(1.0, share))) : 0;
}

}  // namespace

std::vector<std::uint8_t> clip_picture(const ClipMap& map, double darkest) {
  std::vector<std::uint8_t> rgb(3 * map.bright.size(), 0);
  for (std::size_t i = 0; i < map.bright.size(); ++i) {
    const double over = map.bright[i], under = map.dark[i];
    rgb[3 * i] = marked(over / (1.0 + over));
    rgb[3 * i + 2] = marked(darkest > 0.0 ? under / darkest : 0.0);
  }
  return rgb;
}

double whole_leak(const CompileSettings& settings) {
  const int exposures = std::max(exposures_of(settings, Side::left), exposures_of(settings, Side::right));
  return settings.black_level * exposures / (1.0 - settings.black_level);
}

Status each_clip_map(const Source& source, FrameRange frames, const std::function<Status(int, const ClipMap&)>& take,
                     const FrameProgress& progress, const std::stop_token& stop) {
  Compiler compiler(compile_settings(source.project));
  FrameImages memory;
  for (int k = frames.begin; k < frames.end; ++k) {
    const auto staged = stage(source.project, source.loaded.assets, k / source.project.frames.rate_hz);
    if (!staged) return staged.fault();
    ClipMap map;
    auto made = compiler.frame(*staged, stop, std::move(memory), &map);
    if (!made) return made.fault();
    memory = std::move(made->images);
    if (Status taken = take(k, map); !taken) return taken;
    progress(k + 1 - frames.begin, frames.end - frames.begin);
  }
  return {};
}

}  // namespace focalstage
