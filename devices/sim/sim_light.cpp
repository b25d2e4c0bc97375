#include "devices/sim/sim_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace focalstage {

namespace {

Fault unplugged() { return {"light.gone", "light sensor", "it was unplugged", "plug it in, then say go"}; }

double mean_of(const Picture& picture, const PictureForm& form, int width_px, const std::array<int, 4>& rectangle,
               int stride) {
  const auto full = std::exp2(form.bits) - 1.0;
  double sum = 0.0;
  double count = 0.0;
  for (int y = rectangle[1]; y < rectangle[1] + rectangle[3]; y += stride) {
    for (int x = rectangle[0]; x < rectangle[0] + rectangle[2]; x += stride) {
      const auto at = static_cast<std::size_t>((y * width_px + x) * form.channels);
      if (at >= picture.codes.size()) continue;
      sum += picture.codes[at] / full;
      count += 1.0;
    }
  }
  return count > 0.0 ? sum / count : 0.0;
}

}  // namespace

std::array<int, 4> line_rectangle_px(std::size_t line, Side eye, int width_px, int height_px) {
  const double place = (eye == Side::left ? 0.2 : 0.6) + 0.05 * static_cast<double>(line);
  return {static_cast<int>(place * width_px), height_px / 4, std::max(1, width_px / 128), std::max(1, height_px / 2)};
}

SimBrightness brightness_of(const Picture& picture, const PictureForm& form, int width_px, int height_px,
                            std::size_t lines) {
  SimBrightness bright;
  bright.line.resize(lines);
  if (picture.codes.empty()) return bright;
  bright.field = mean_of(picture, form, width_px, {0, 0, width_px, height_px}, std::max(1, height_px / 48));
  for (std::size_t k = 0; k < lines; ++k) {
    for (const Side eye : both_sides) {
      bright.line[k][eye] = mean_of(picture, form, width_px, line_rectangle_px(k, eye, width_px, height_px), 1);
    }
  }
  return bright;
}

DeviceState SimLightSensor::state() const {
  const std::lock_guard lock(mutex_);
  if (!plugged_) return {DevicePhase::lost, unplugged(), 0.0, {}};
  return {DevicePhase::ready, {}, 0.0, {}};
}

LightAbilities SimLightSensor::abilities() const { return {settings_.step_s, settings_.most_samples, settings_.bits}; }

Status SimLightSensor::arm(const LightRequest& request) {
  const std::lock_guard lock(mutex_);
  if (!plugged_) return unplugged();
  if (request.samples < 1 || request.samples > settings_.most_samples || !(request.after_edge_s >= 0.0)) {
    return Fault{"light.unable", "light sensor", "it cannot take such a record", "ask for fewer samples"};
  }
  armed_ = Armed{request, {}};
  done_.reset();
  return {};
}

Result<std::optional<LightRecord>> SimLightSensor::take() {
  const std::lock_guard lock(mutex_);
  if (!plugged_) return unplugged();
  return std::exchange(done_, std::nullopt);
}

void SimLightSensor::sync_edge(double time_s) {
  const std::lock_guard lock(mutex_);
  const double newest_s = edge_s_ ? time_s - *edge_s_ : 0.0;
  steady_ = newest_s > 0.0 && std::abs(newest_s - period_s_) < 0.02 * newest_s;
  period_s_ = newest_s;
  edge_s_ = time_s;
  if (armed_ && steady_ && !armed_->edge_s && armed_->request.edges_to_skip-- <= 0) armed_->edge_s = time_s;
}

void SimLightSensor::look(double time_s, const SimSeen& seen) {
  const std::lock_guard lock(mutex_);
  if (!armed_ || !armed_->edge_s) return;
  const double own_s = armed_->request.after_edge_s + armed_->request.samples * settings_.step_s;
  if (*armed_->edge_s + own_s * (1.0 + settings_.clock_off) > time_s) return;
  done_ = record(*armed_, seen);
  armed_.reset();
}

LightRecord SimLightSensor::record(const Armed& armed, const SimSeen& seen) {
  std::normal_distribution<double> noise(0.0, settings_.noise);
  const double codes = std::exp2(settings_.bits) - 1.0;
  LightRecord record{
      armed.request.eye, armed.request.after_edge_s, settings_.step_s, period_s_ / (1.0 + settings_.clock_off), {}};
  const bool left = (armed.request.eye == Side::left) != settings_.swapped;
  const Side behind = left ? Side::left : Side::right;
  for (int i = 0; i < armed.request.samples; ++i) {
    const double at_s =
        *armed.edge_s + (armed.request.after_edge_s + i * settings_.step_s) * (1.0 + settings_.clock_off);
    // A lag of the first order, at the nodes of Gauss and Laguerre.
    const double light = 0.711093009929173 * seen(behind, at_s - 0.415774556783479 * settings_.rise_s) +
                         0.278517733569241 * seen(behind, at_s - 2.294280360279042 * settings_.rise_s) +
                         0.010389256501586 * seen(behind, at_s - 6.289945082937479 * settings_.rise_s);
    const double hum = settings_.hum * std::sin(2.0 * std::numbers::pi * settings_.hum_hz * at_s);
    const double value = light + settings_.ambient + hum + noise(random_);
    record.light.push_back(std::round(std::clamp(value, 0.0, 1.0) * codes) / codes);
  }
  return record;
}

void SimLightSensor::unplug() {
  const std::lock_guard lock(mutex_);
  plugged_ = false;
  armed_.reset();
  done_.reset();
}

void SimLightSensor::plug() {
  const std::lock_guard lock(mutex_);
  plugged_ = true;
}

}  // namespace focalstage
