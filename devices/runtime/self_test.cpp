#include "devices/runtime/self_test.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>
#include <utility>

#include "core/rig_measure/light_edge.h"
#include "core/rig_measure/shutter_time.h"
#include "devices/roles/clock.h"

namespace focalstage {

namespace {

using Kind = MeasuringPicture::Kind;

/// Half a sweep and something: its light, when its eye's shutter is open for it, and when to look. The early one has
/// the rise of the power in it, the late one the fall; together they are the period.
struct Half {
  PeriodWindow light;
  PeriodWindow shutter;
  PeriodWindow look;
};
constexpr Half early_half{{0.01, 0.56}, {0.67, 1.575}, {0.0, 0.58}};
constexpr Half late_half{{0.44, 0.985}, {0.12, 0.99}, {0.42, 0.995}};
constexpr const Half& half_of(bool early) { return early ? early_half : late_half; }

// When a shutter is told to open and to close while that is measured: in its half, with light left to see it closed.
constexpr PerEye<PeriodWindow> moving{{0.06, 0.43}, {0.5, 0.87}};

constexpr PeriodWindow one_exposure{0.5, 0.58};
constexpr PeriodWindow around_it{0.45, 0.56};

constexpr double settled_within_s = 30.0;
constexpr double between_looks_s = 0.005;

std::string shutter_name(Side eye) { return eye == Side::left ? "left shutter" : "right shutter"; }
std::string lens_name(Side eye) { return eye == Side::left ? "left lens" : "right lens"; }
std::string eye_name(Side eye) { return eye == Side::left ? "left eye" : "right eye"; }
Side other(Side eye) { return eye == Side::left ? Side::right : Side::left; }

}  // namespace

Fault no_light_sensor() {
  return {"rig.no-light-sensor", "rig", "this rig has no light sensor to measure itself with",
          "wire one and name it in rig.json as devices.light_sensor (docs/self-test.md)"};
}

SelfTest::SelfTest(RigThread& rig, const RigSetup& setup, const RigLimits& limits, const SelfTestSettings& settings,
                   std::function<Status()> may_go_on, std::function<void(const std::string&, double)> tell)
    : rig_(rig),
      setup_(setup),
      limits_(limits),
      settings_(settings),
      others_may_(std::move(may_go_on)),
      tell_(std::move(tell)),
      period_s_(1.0 / settings.frequency_hz),
      nominal_(setup.describe(limits, settings.frequency_hz)),
      watch_(*setup.light_sensor, period_s_, [this] { return this->may_go_on(); }) {}

Result<RigMeasurement> SelfTest::run() {
  if (Status fit = ready(); !fit) return fit.fault();
  const std::shared_ptr<const LoadedShow> before = rig_.show();
  Result<RigMeasurement> measured = measure();
  rig_.end_measuring(before);
  return measured;
}

Status SelfTest::ready() const {
  const std::string now = rig_.state().state;
  if (now == "dark") return Fault{"rig.refused", "rig", "the rig is dark and stays so", "say go first"};
  if (now == "playing" || now == "holding") {
    return Fault{"rig.refused", "rig", "the rig is " + now, "black it out and say go first"};
  }
  return setup_.light_sensor->open();
}

/// Others may say no, and the rig may have gone dark. The latter is asked seldom: it takes the rig's lock.
Status SelfTest::may_go_on() const {
  if (Status may = others_may_(); !may) return may;
  const double now_s = monotonic_s();
  if (!playing_ || now_s - looked_s_ < between_looks_s) return {};
  looked_s_ = now_s;
  const RigState state = rig_.state();
  if (state.state != "dark") return {};
  return Fault{"measure.dark", "rig",
               state.fault.empty() ? "it was blacked out while it measured itself" : "it went dark: " + state.fault,
               "say go, then measure again"};
}

/// Without voltage shutters are open: whoever was never told is not closed yet. Darkness tells all.
Status SelfTest::begin_in_the_dark() {
  rig_.blackout();
  for (const double until_s = monotonic_s() + 2.0;;) {
    Status gone = rig_.go();
    if (gone || monotonic_s() > until_s) return gone;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

Status SelfTest::show(const MeasuringStep& step, const std::string& doing) {
  const auto drives = static_cast<double>(3 + 2 * (settings_.harmonics - 1));
  const double all = 18.0 + 4.0 * drives * static_cast<double>(setup_.light_targets.size());
  tell_(doing, std::min(1.0, steps_done_++ / all));
  const auto lit = std::make_shared<std::atomic<bool>>(false);
  rig_.present(measuring_show(step, nominal_, period_s_, [lit] { *lit = true; }));
  if (!playing_) {
    if (Status played = rig_.play(0); !played) return played;
    playing_ = true;
  }
  for (const double until_s = monotonic_s() + settled_within_s; monotonic_s() < until_s;) {
    if (*lit) return {};
    if (Status may = may_go_on(); !may) return may;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return Fault{"measure.dark", "rig", "what was to be measured did not come on", "look at the rig's log"};
}

Result<LightTraces> SelfTest::look(Side eye, const PeriodWindow& window, int traces) const {
  return watch_.traces({eye, window.from * period_s_, window.to * period_s_, traces});
}

/// The light of one half through the open shutter, and how dark it is without.
Result<FullLight> SelfTest::full_light(Side eye, bool early, const std::string& doing) {
  const Half& half = half_of(early);
  MeasuringStep step;
  step.light = half.light;
  step.shutter[eye] = half.shutter;
  if (Status shown = show(step, doing); !shown) return shown.fault();
  const Result<LightTraces> black = look(eye, half.look, settings_.traces);
  if (!black) return black.fault();
  const Result<DarkLight> dark = dark_light(*black);
  if (!dark) return dark.fault();
  dark_[eye] = *dark;
  step.picture.kind = Kind::white;
  if (Status shown = show(step, doing); !shown) return shown.fault();
  const Result<LightTraces> white = look(eye, half.look, settings_.traces);
  if (!white) return white.fault();
  Result<FullLight> full = FullLight::make(*white, dark_[eye], eye_name(eye));
  if (!full && full.fault().code != "measure.light") return full;
  if (Status sides = check_sides(eye, full ? full->swing() : 0.0); !sides) return sides.fault();
  return full;
}

/// The other eye's sensor, behind its closed shutter, must stay dark.
Status SelfTest::check_sides(Side eye, double own_swing) const {
  const Result<LightTraces> beside = look(other(eye), {0.45, 0.55}, 6);
  if (!beside) return beside.fault();
  double most = 0.0;
  for (const LightTrace& trace : *beside) {
    for (const double light : trace.light) most = std::max(most, light);
  }
  return own_side(own_swing, most - dark_[eye].level, shutter_name(eye));
}

Status SelfTest::measure_shutter(Side eye) {
  const bool early = eye == Side::left;
  const Result<FullLight> full = full_light(eye, early, shutter_name(eye));
  if (!full) return full.fault();
  if (Status rested = show({}, shutter_name(eye)); !rested) return rested;
  MeasuringStep step;
  step.picture.kind = Kind::white;
  step.light = half_of(early).light;
  step.shutter[eye] = moving[eye];
  if (Status shown = show(step, shutter_name(eye)); !shown) return shown;
  const Result<LightTraces> traces = look(eye, half_of(early).look, settings_.traces);
  if (!traces) return traces.fault();
  const std::vector<LightPoint> shares = full->shares(*traces);
  const double opened_s = moving[eye].from * period_s_;
  const double closed_s = moving[eye].to * period_s_;
  // How far the light really goes: a whole number of exposures, as late as the projector is.
  const double dark_s = shares.empty() ? closed_s : shares.back().time_s;
  const ShutterLook how{watch_.step_s(), full->level_spread(), delay_spread_s()};
  const Result<Estimate> opens = shutter_time_ms(shares, {true, opened_s, closed_s}, how, shutter_name(eye));
  if (!opens) return opens.fault();
  const Result<Estimate> closes = shutter_time_ms(shares, {false, closed_s, dark_s}, how, shutter_name(eye));
  if (!closes) return closes.fault();
  found_.eye[eye].shutter_open_ms = *opens;
  found_.eye[eye].shutter_close_ms = *closes;
  return {};
}

/// First of all: what the sensor's own delay may be is said by the rise of the light.
Status SelfTest::measure_latency() {
  const Result<FullLight> full = full_light(Side::left, false, "projector");
  if (!full) return full.fault();
  MeasuringStep step;
  step.picture.kind = Kind::white;
  step.light = one_exposure;
  step.one_exposure = true;
  step.shutter.left = late_half.shutter;
  if (Status shown = show(step, "projector"); !shown) return shown;
  const Result<LightTraces> traces = look(Side::left, around_it, settings_.traces);
  if (!traces) return traces.fault();
  const MeasuringLight light = measuring_light(step, nominal_, period_s_);
  const double trigger_s = light.start_s.at(0) - nominal_.projectors.at(0).latency_ms / 1e3;
  const Result<LightEdge> edge = light_edge(*traces, dark_.left, trigger_s, light.exposure_s);
  if (!edge) return edge.fault();
  found_.latency_ms = edge->latency_ms;
  found_.light_rise_ms = edge->rise_ms;
  return {};
}

double SelfTest::delay_spread_s() const { return 0.5e-3 * found_.light_rise_ms.value; }

std::vector<KnownPower> SelfTest::known_powers() const {
  std::vector<KnownPower> powers;
  for (const LightTargetConfig& target : setup_.light_targets) powers.push_back({target.power_d, target.spread_d});
  return powers;
}

Status SelfTest::look_through(Side eye, bool early, const LensFitTask& task, std::vector<LensLook>& looks) {
  const Half& half = half_of(early);
  const Result<FullLight> full = full_light(eye, early, lens_name(eye));
  if (!full) return full.fault();
  MeasuringStep step;
  step.picture.kind = Kind::rectangle;
  step.light = half.light;
  step.shutter[eye] = half.shutter;
  for (std::size_t drive = 0; drive < task.drives.size(); ++drive) {
    step.drive = task.drives[drive];
    for (std::size_t target = 0; target < task.targets.size(); ++target) {
      step.picture.rectangle_px = setup_.light_targets[target].rectangle_px[eye];
      if (Status shown = show(step, lens_name(eye)); !shown) return shown;
      const Result<LightTraces> traces = look(eye, half.look, settings_.lens_traces);
      if (!traces) return traces.fault();
      looks.push_back({drive, target, full->shares(*traces)});
    }
  }
  return {};
}

Status SelfTest::measure_lens(Side eye) {
  LensFitTask task;
  task.period_s = period_s_;
  task.step_s = watch_.step_s();
  task.targets = known_powers();
  task.nominal = nominal_.glasses.lens_response[eye];
  task.delay_spread_s = delay_spread_s();
  Result<std::vector<DriveTones>> drives =
      lens_drives(task.targets, task.nominal, settings_.harmonics, limits_.lens_current_max_a);
  if (!drives) return drives.fault();
  task.drives = std::move(*drives);
  std::vector<LensLook> looks;
  // The late half first: the early one's shutter is open over the period's end, and must have closed before another
  // pattern may follow.
  for (const bool early : {false, true}) {
    if (Status looked = look_through(eye, early, task, looks); !looked) return looked;
  }
  const Result<LensFit> fit = fit_lens(looks, task, lens_name(eye));
  if (!fit) return fit.fault();
  found_.eye[eye].rest_power_d = fit->rest_power_d;
  found_.eye[eye].lens = fit->lens;
  return show({}, lens_name(eye));
}

Result<RigMeasurement> SelfTest::measure() {
  found_.frequency_hz = settings_.frequency_hz;
  if (Status begun = begin_in_the_dark(); !begun) return begun.fault();
  if (Status done = measure_latency(); !done) return done.fault();
  for (const Side eye : both_sides) {
    if (Status done = measure_shutter(eye); !done) return done.fault();
  }
  for (const Side eye : both_sides) {
    if (Status done = measure_lens(eye); !done) return done.fault();
  }
  using namespace std::chrono;
  found_.unix_s = duration_cast<seconds>(system_clock::now().time_since_epoch()).count();
  tell_("done", 1.0);
  return found_;
}

}  // namespace focalstage
