#include "tests/bench/retina_view.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <vector>

#include "core/compile/compile.h"
#include "core/retina/retina.h"

namespace focalstage::bench {
namespace {

double median_ms(int rounds, const std::function<void(int)>& once) {
  std::vector<double> times_ms;
  for (int round = 0; round < rounds; ++round) {
    const auto start = std::chrono::steady_clock::now();
    once(round);
    times_ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  std::sort(times_ms.begin(), times_ms.end());
  return times_ms[times_ms.size() / 2];
}

/// An exposure over which the power changes by 0.2 D, as half a millisecond of a 3 D sweep does at its steepest.
std::vector<PowerShare> smeared(double power_d) {
  std::vector<PowerShare> powers;
  for (int i = 0; i < 32; ++i) powers.push_back({power_d + 0.2 * ((i + 0.5) / 32.0 - 0.5), 1.0 / 32.0});
  return powers;
}

/// The left eye's slices and, as the costliest thing that can be added, light on the whole surface.
RetinaInput input_of(const BenchScene& scene, const CompiledFrame& frame, const std::vector<std::uint8_t>& light) {
  RetinaInput input;
  input.stage = &scene.stage;
  input.projector = scene.settings.projector;
  for (std::size_t i = 0; i < scene.settings.images.size(); ++i) {
    const ImageSpec& spec = scene.settings.images[i];
    if (spec.eye == ImageEye::left) input.exposures.push_back({frame.images.image(i), smeared(spec.power_d)});
  }
  input.exposures.push_back({light, smeared(0.0)});
  return input;
}

}  // namespace

Result<RetinaTimes> time_retina(const BenchScene& scene, int width_px, int height_px, int rounds) {
  const auto frame = Compiler(scene.settings).frame(scene.stage);
  if (!frame) return frame.fault();
  const std::vector<std::uint8_t> light(frame->images.bytes_per_image(), 60);
  const RetinaInput input = input_of(scene, *frame, light);
  RetinaView view;
  view.width_px = width_px;
  view.height_px = height_px;
  Status worked;
  const auto see = [&](Retina& retina) {
    if (const auto image = retina.view(input, view); !image) worked = image.fault();
  };
  RetinaTimes times;
  times.first_ms = median_ms(rounds, [&](int) {
    Retina fresh(1);
    see(fresh);
  });
  Retina kept(1);
  times.head_ms = median_ms(rounds, [&](int round) {
    view.head_offset_m.x = 1e-3 * (round + 1);
    see(kept);
  });
  times.focus_ms = median_ms(rounds, [&](int round) {
    view.focus_d = 1.0 + 0.1 * (round % 20);
    see(kept);
  });
  if (!worked) return worked.fault();
  return times;
}

}  // namespace focalstage::bench
