#include "devices/lightcrafter/lightcrafter.h"

#include <mutex>
#include <string>

#include "devices/lightcrafter/command_thread.h"
#include "devices/lightcrafter/frame_feeder.h"
#include "devices/lightcrafter/probe.h"
#include "devices/lightcrafter/timing.h"
#include "devices/roles/clock.h"

namespace focalstage {

namespace {

using namespace lightcrafter;

constexpr int most_periods_ahead = 2;
constexpr double most_wait_s = 2.7;  ///< for what may take 3 s with darkness before it
constexpr double dark_within_s = 0.2;

Fault fault(const char* code, const std::string& message, const std::string& remedy) {
  return {code, "LightCrafter 4500", message, remedy};
}

class LightCrafter final : public ProjectorDevice {
 public:
  LightCrafter(LightCrafterSettings settings, std::unique_ptr<Display> display, OpenReports open_reports)
      : settings_(std::move(settings)),
        open_reports_(std::move(open_reports)),
        display_(std::move(display)),
        feeder_(*display_, most_periods_ahead) {}

  ~LightCrafter() override { close(); }

  Status open() override {
    const std::lock_guard calls(calls_);
    const DevicePhase phase = state().phase;
    if (phase == DevicePhase::ready || phase == DevicePhase::running) return {};
    end();
    const Status opened = open_all();
    if (!opened) {
      end();
      const std::string& code = opened.fault().code;
      const bool may_come = code == "projector.absent" || code == "projector.lost" || code == "projector.silent" ||
                            code == "display.absent";
      set(may_come ? DevicePhase::lost : DevicePhase::refused, opened.fault());
      return opened;
    }
    set(DevicePhase::ready, std::nullopt);
    return {};
  }

  void close() override {
    const std::lock_guard calls(calls_);
    end();
    set(DevicePhase::off, std::nullopt);
  }

  DeviceId id() const override {
    const std::lock_guard lock(mutex_);
    return id_;
  }

  DeviceState state() const override {
    const std::lock_guard lock(mutex_);
    return state_;
  }

  Status identify() override {
    const std::lock_guard calls(calls_);
    const auto commands = commands_now();
    if (!commands || state().phase != DevicePhase::ready) return not_ready();
    return commands->run([](Control& control) { return control.blink(); }, 2.0);
  }

  ProjectorAbilities abilities() const override {
    return {width_px, height_px, Pacing::master, 0.0, most_periods_ahead};
  }

  Status arm(const Exposures& exposures) override {
    const std::lock_guard calls(calls_);
    const auto commands = commands_now();
    if (!commands || !usable()) return not_ready();
    Result<PatternPlan> plan = plan_patterns(exposures, display_->mode().interval_s, settings_.plan);
    if (!plan) return plan.fault();
    rest();
    set(DevicePhase::ready, std::nullopt);
    if (!commands->dark(dark_within_s)) return not_ready();
    if (const Status packing = feeder_.arm(plan->pack); !packing) return packing;
    const Status done = commands->run(
        [plan = *plan, check = settings_.check_signal](Control& control) -> Status {
          if (check) {
            if (const Status signal = control.check_signal(); !signal) return signal;
          }
          return control.set_up(plan);
        },
        most_wait_s);
    const std::lock_guard lock(mutex_);
    armed_ = done.ok();
    lead_s_ = plan->lead_s;
    per_period_ = exposures.start_s.size();
    return done;
  }

  Status start() override {
    const std::lock_guard calls(calls_);
    const auto commands = commands_now();
    if (!commands || !usable()) return not_ready();
    if (state().phase == DevicePhase::running) return {};
    {
      const std::lock_guard lock(mutex_);
      if (!armed_) return fault("projector.idle", "it was not armed", "arm it first");
    }
    const std::uint64_t darks = darks_;
    {
      const std::lock_guard lock(mutex_);
      starting_ = true;
    }
    const Status started = commands->run([](Control& control) { return control.start(); }, most_wait_s);
    const Status running = started ? begin(darks) : started;
    if (!running) (void)commands->dark(dark_within_s);
    const std::lock_guard lock(mutex_);
    starting_ = false;
    return running;
  }

  Status post(std::vector<Picture> pictures) override {
    {
      const std::lock_guard lock(mutex_);
      if (state_.phase == DevicePhase::lost) return *state_.fault;
      if (!armed_) return fault("projector.idle", "it was not armed", "arm it first");
    }
    return feeder_.post(std::move(pictures));
  }

  bool dark() noexcept override {
    ++darks_;
    rest();
    std::shared_ptr<CommandThread> commands;
    {
      const std::lock_guard lock(mutex_);
      stop_counting();
      if (state_.phase == DevicePhase::running) state_.phase = DevicePhase::ready;
      commands = commands_;
      if (!commands) return state_.phase == DevicePhase::off;
    }
    const bool told = commands->dark(dark_within_s - 0.01);
    // What it went dark for by itself is over; what is still wrong is found by the next look.
    const std::lock_guard lock(mutex_);
    if (told && state_.phase == DevicePhase::ready) state_.fault.reset();
    return told;
  }

  ProjectorReport report() const override {
    const DisplayReport shown = display_->report();
    const std::lock_guard lock(mutex_);
    ProjectorReport report;
    if (shown.newest_vblank_s) {
      report.newest_period_s = *shown.newest_vblank_s + settings_.light_after_vblank_s - lead_s_;
    }
    if (!begun_) return report;
    const DisplayReport now = ended_.value_or(shown);
    report.periods = now.vblanks - begun_->vblanks;
    report.exposures = (now.shown - begun_->shown) * per_period_;
    report.missed = (now.silent - begun_->silent + now.repeated - begun_->repeated) * per_period_;
    return report;
  }

 private:
  Status open_all() {
    for (const DeviceId& id : probe_lightcrafter()) {
      if (settings_.serial.empty() || settings_.serial == id.serial) {
        const std::lock_guard lock(mutex_);
        id_ = id;
        break;
      }
    }
    Result<std::unique_ptr<Reports>> reports = open_reports_(settings_.serial, settings_.address);
    if (!reports) return reports.fault();
    auto commands = std::make_shared<CommandThread>(
        std::move(*reports), settings_, [this](const BoardState& board) { return looked(board); },
        [this](const Fault& why) { lose(why); });
    if (const Status ready = commands->run([](Control& control) { return control.make_ready(); }, most_wait_s);
        !ready) {
      return ready;
    }
    if (const Status shown = display_->open(); !shown) return shown;
    const VideoMode mode = display_->mode();
    if (mode.width_px != width_px || mode.height_px != height_px) {
      return fault("projector.unable",
                   "its display gives " + std::to_string(mode.width_px) + " x " + std::to_string(mode.height_px) +
                       ", not 912 x 1140 pixels",
                   "choose a mode of 912 x 1140");
    }
    const std::lock_guard lock(mutex_);
    commands_ = std::move(commands);
    state_.heard_s = monotonic_s();
    return {};
  }

  /// The board runs: so does this, unless it was told or came to grief meanwhile.
  Status begin(std::uint64_t darks) {
    const std::lock_guard lock(mutex_);
    if (darks != darks_) return fault("projector.hurried", "it was told to go dark instead", "");
    if (state_.phase != DevicePhase::ready) return state_.fault.value_or(fault("projector.lost", "it is lost", ""));
    state_.phase = DevicePhase::running;
    state_.fault.reset();
    begun_ = display_->report();
    ended_.reset();
    feeder_.go(true);
    return {};
  }

  /// With `mutex_` held: what was shown is counted no further.
  void stop_counting() {
    if (state_.phase == DevicePhase::running) ended_ = display_->report();
  }

  void end() {
    rest();
    std::shared_ptr<CommandThread> commands;
    {
      const std::lock_guard lock(mutex_);
      commands = std::move(commands_);
      commands_.reset();
      armed_ = false;
      begun_.reset();
    }
    commands.reset();  // says dark
    display_->close();
  }

  /// Black frames from now on.
  void rest() noexcept {
    feeder_.go(false);
    feeder_.forget();
  }

  std::shared_ptr<CommandThread> commands_now() const noexcept {
    const std::lock_guard lock(mutex_);
    return commands_;
  }

  bool usable() const {
    const DevicePhase phase = state().phase;
    return phase == DevicePhase::ready || phase == DevicePhase::running;
  }

  Status not_ready() const {
    const DeviceState now = state();
    if (now.fault) return *now.fault;
    return fault("projector.idle", std::string("it is ") + name_of(now.phase), "open it, and go dark, first");
  }

  void set(DevicePhase phase, const std::optional<Fault>& why) {
    const std::lock_guard lock(mutex_);
    stop_counting();
    state_.phase = phase;
    state_.fault = why;
  }

  /// In the command thread: whether what was seen is as it should be.
  bool looked(const BoardState& board) {
    const DisplayReport shown = display_->report();
    const std::lock_guard lock(mutex_);
    state_.heard_s = monotonic_s();
    const bool running = state_.phase == DevicePhase::running;
    std::optional<Fault> why = shown.fault ? shown.fault : trouble_with(board, running || (starting_ && !board.dark()));
    // One look may have begun before darkness was told.
    bright_looks_ = running || starting_ || board.dark() ? 0 : bright_looks_ + 1;
    if (bright_looks_ == 1) return true;
    if (!why) return false;
    stop_counting();
    if (state_.phase != DevicePhase::lost) state_.phase = shown.fault ? DevicePhase::lost : DevicePhase::ready;
    state_.fault = why;
    feeder_.go(false);
    feeder_.forget();
    return true;
  }

  void lose(const Fault& why) {
    set(DevicePhase::lost, why);
    rest();
  }

  LightCrafterSettings settings_;
  OpenReports open_reports_;
  std::unique_ptr<Display> display_;
  FrameFeeder feeder_;
  std::mutex calls_;  ///< one slow call at a time; never taken by `dark`, `post` or a look
  std::atomic<std::uint64_t> darks_ = 0;

  mutable std::mutex mutex_;  ///< held for moments only
  DeviceId id_{"lightcrafter", "LightCrafter 4500", "", ""};
  DeviceState state_;
  std::shared_ptr<CommandThread> commands_;
  bool armed_ = false;
  double lead_s_ = 0.0;
  std::size_t per_period_ = 0;
  std::optional<DisplayReport> begun_;  ///< as it was at the start
  std::optional<DisplayReport> ended_;  ///< and when it stopped
  bool starting_ = false;               ///< in another thread: the lamps are lit before the phase says so
  int bright_looks_ = 0;
};

}  // namespace

std::unique_ptr<ProjectorDevice> make_lightcrafter(const LightCrafterSettings& settings,
                                                   std::unique_ptr<Display> display, OpenReports open_reports) {
  return std::make_unique<LightCrafter>(settings, std::move(display), std::move(open_reports));
}

}  // namespace focalstage
