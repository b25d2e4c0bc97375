#include "devices/runtime/light_watch.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <thread>
#include <utility>

#include "core/base/number_words.h"
#include "devices/roles/clock.h"

namespace focalstage {

namespace {

constexpr double silent_s = 3.0;
// A ceramic resonator is off by half a hundredth; more is another signal.
constexpr double most_off = 0.02;
// Pieces of one window overlap, so that nothing is lost between them.
constexpr int overlap = 6;

Fault silent() {
  return {"light.silent", "light sensor", "it delivered nothing for three seconds",
          "see its cable, and the sync edge at its input"};
}

}  // namespace

Result<LightTrace> LightWatch::trace(const LightRequest& request) const {
  if (Status armed = sensor_.arm(request); !armed) return armed.fault();
  for (const double until_s = monotonic_s() + silent_s; monotonic_s() < until_s;) {
    Result<std::optional<LightRecord>> record = sensor_.take();
    if (!record) return record.fault();
    if (*record) {
      const double scale = period_s_ / (*record)->period_s;
      if (!(std::abs(scale - 1.0) < most_off)) {
        return Fault{"light.unsynced", "light sensor",
                     "its sync edges come every " + short_text(1e3 * (*record)->period_s, 5) + " ms, the rig's every " +
                         short_text(1e3 * period_s_, 5) + " ms",
                     "wire the rig's own sync edge to it"};
      }
      return LightTrace{(*record)->after_edge_s * scale, (*record)->step_s * scale, std::move((*record)->light)};
    }
    if (Status may = may_go_on_(); !may) return may.fault();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return silent();
}

Result<LightTraces> LightWatch::traces(const LightTask& task) const {
  const LightAbilities abilities = sensor_.abilities();
  const int whole = static_cast<int>((task.to_s - task.from_s) / abilities.step_s);
  // In no step with anything: hum of 50 and 100 Hz comes round every third and sixth sweep of 60 Hz.
  std::minstd_rand chance(1);
  LightTraces found;
  for (int first = 0; first < whole; first += abilities.most_samples - overlap) {
    const int samples = std::min(abilities.most_samples, whole - first);
    if (samples <= overlap && first > 0) break;
    for (int k = 0; k < task.traces; ++k) {
      const double shift = static_cast<double>(k) / task.traces;
      Result<LightTrace> one = trace({task.eye, task.from_s + (first + shift) * abilities.step_s, samples,
                                      static_cast<int>(chance() >> 8 & 0xFF) % 3});
      if (!one) return one.fault();
      found.push_back(std::move(*one));
    }
  }
  return found;
}

}  // namespace focalstage
