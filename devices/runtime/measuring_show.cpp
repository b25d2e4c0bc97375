#include "devices/runtime/measuring_show.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace focalstage {

namespace {

constexpr double most_exposures = 30.0;
constexpr std::size_t drive_samples = 1024;
// Exposures that follow each other without a gap must not come a rounding too early for the projector.
constexpr double a_little_longer = 1.0 + 1e-6;
// A trigger board wants its first trigger so long after the edge.
constexpr double least_trigger_s = 100e-6;

std::shared_ptr<FrameImages> images_of(const MeasuringPicture& picture, const Projector& projector) {
  auto images = std::make_shared<FrameImages>();
  *images = {1, projector.width_px, projector.height_px, 1, {}};
  const auto full = static_cast<std::uint8_t>((1 << projector.bits) - 1);
  const bool white = picture.kind == MeasuringPicture::Kind::white;
  images->codes.assign(images->bytes_per_image(), white ? full : std::uint8_t{0});
  if (picture.kind != MeasuringPicture::Kind::rectangle) return images;
  const auto [left, top, width, height] = picture.rectangle_px;
  for (int y = top; y < std::min(top + height, projector.height_px); ++y) {
    for (int x = left; x < std::min(left + width, projector.width_px); ++x) {
      images->codes[static_cast<std::size_t>(y * projector.width_px + x)] = full;
    }
  }
  return images;
}

SweepPlan plan_of(const MeasuringStep& step, const MeasuringLight& light, const Projector& projector, double period_s) {
  SweepPlan plan;
  plan.period_s = period_s;
  plan.exposure_s = light.exposure_s;
  plan.form = {1, projector.bits};
  plan.drive_step_s = period_s / static_cast<double>(drive_samples);
  plan.drive_a.left = plan.drive_a.right = step.drive.samples(drive_samples);
  for (const double start_s : light.start_s) {
    plan.trigger_s.push_back(start_s - projector.latency_ms / 1e3);
    plan.image.push_back(0);
  }
  for (const Side eye : both_sides) {
    const auto& window = step.shutter[eye];
    if (!window) continue;
    plan.shutters.push_back({eye, ShutterLevel::open, window->from * period_s});
    plan.shutters.push_back({eye, ShutterLevel::closed, window->to * period_s});
  }
  std::ranges::stable_sort(plan.shutters, {}, &ShutterCommand::time_s);
  return plan;
}

}  // namespace

MeasuringLight measuring_light(const MeasuringStep& step, const RigDescription& rig, double period_s) {
  const Projector& projector = rig.projectors.at(0);
  MeasuringLight light;
  const double longest_s = 0.56 * period_s;
  light.exposure_s = std::max(a_little_longer / projector.frames_per_second, longest_s / most_exposures);
  if (!step.light) return light;
  const double from_s = std::max(step.light->from * period_s, projector.latency_ms / 1e3 + least_trigger_s);
  const double until_s = step.light->to * period_s;
  for (int i = 0; from_s + (i + 1) * light.exposure_s <= until_s; ++i) {
    light.start_s.push_back(from_s + i * light.exposure_s);
    if (step.one_exposure) break;
  }
  return light;
}

std::shared_ptr<const LoadedShow> measuring_show(const MeasuringStep& step, const RigDescription& rig, double period_s,
                                                 std::function<void()> on_light) {
  const Projector& projector = rig.projectors.at(0);
  const MeasuringLight light = measuring_light(step, rig, period_s);
  auto show = std::make_shared<LoadedShow>();
  show->plan = plan_of(step, light, projector, period_s);
  show->header.frequency_hz = show->header.rate_hz = 1.0 / period_s;
  show->header.frames_per_second = 1.0 / light.exposure_s;
  show->header.width_px = projector.width_px;
  show->header.height_px = projector.height_px;
  show->header.images.resize(1);
  show->header.schedule.period_s = period_s;
  for (std::size_t i = 0; i < light.start_s.size(); ++i) {
    show->header.schedule.slots.push_back(
        {0, Side::left, light.start_s[i], light.exposure_s, show->plan.trigger_s[i], 0.0, 0.0});
  }
  show->frames = std::make_unique<OneFrame>(images_of(step.picture, projector));
  show->on_light = [told = std::move(on_light)](std::uint64_t, double) { told(); };
  return show;
}

}  // namespace focalstage
