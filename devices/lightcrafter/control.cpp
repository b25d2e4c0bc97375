#include "devices/lightcrafter/control.h"

#include <algorithm>
#include <string>
#include <vector>

#include "devices/lightcrafter/timing.h"
#include "devices/roles/clock.h"

namespace focalstage::lightcrafter {

namespace {

constexpr std::uint8_t leds_off = 0x00;
constexpr std::uint8_t leds_by_sequencer = 0x08;
constexpr std::uint8_t led_green = 0x02;
constexpr std::uint8_t no_delay = 0xBB;  ///< of a trigger output
constexpr double identify_brightness = 0.03;
constexpr double blink_s = 0.15;
constexpr int blinks = 3;

Fault fault(const char* code, const std::string& message, const std::string& remedy) {
  return {code, "LightCrafter 4500", message, remedy};
}

struct Step {
  Command command;
  Bytes payload;
};

}  // namespace

std::optional<Fault> trouble_with(const BoardState& board, bool meant_to_run) {
  const std::string trouble = trouble_in(board.hardware);
  if (!trouble.empty()) return fault("projector.hardware", trouble, "switch it off and on, then open it again");
  if (meant_to_run && !board.main.running) {
    return fault("projector.stopped", "its sequencer stopped by itself", "look at its video signal, then start again");
  }
  if (!meant_to_run && !board.dark()) {
    return fault("projector.hardware", "it was told to go dark and does not", "switch it off, and ask its maker");
  }
  return std::nullopt;
}

Control::Control(std::unique_ptr<Reports> reports, const LightCrafterSettings& settings, const std::atomic<bool>& hurry)
    : settings_(settings), hurry_(hurry), link_(std::move(reports), settings.answer_s, hurry) {}

Status Control::write(Command command, std::initializer_list<std::uint8_t> payload) {
  return link_.write(command, std::span(payload.begin(), payload.size()));
}

bool Control::dark() {
  const std::array<std::uint8_t, 1> zero{0};
  const Status lamps = link_.write_at_once(Command::led_enable, zero, settings_.dark_answer_s);
  const Status sequencer = link_.write_at_once(Command::pattern_run, zero, settings_.dark_answer_s);
  return lamps.ok() && sequencer.ok();
}

Status Control::make_ready() {
  const std::vector<Step> steps{{Command::led_enable, {leds_off}},
                                {Command::pattern_run, {0}},
                                {Command::power, {0}},
                                {Command::display_mode, {1}},
                                {Command::pattern_source, {0}},
                                {Command::led_current, led_current_bytes(0.0)}};
  for (const Step& step : steps) {
    if (const Status done = link_.write(step.command, step.payload); !done) return done;
  }
  const Result<BoardState> state = look();
  if (!state) return state.fault();
  if (const auto trouble = trouble_with(*state, false)) return *trouble;
  return {};
}

Status Control::set_up(const PatternPlan& plan) {
  const int entries = static_cast<int>(plan.entries.size());
  std::vector<Step> steps{{Command::led_enable, {leds_off}}, {Command::pattern_run, {0}}, {Command::power, {0}}};
  if (settings_.input_source) steps.push_back({Command::input_source, {*settings_.input_source}});
  for (Step step : std::vector<Step>{{Command::display_mode, {1}},
                                     {Command::pattern_source, {0}},
                                     {Command::variable_config, variable_config_bytes(entries, entries, 1, true)},
                                     {Command::trigger_mode, {4}},
                                     {Command::trigger_out_1, {0, no_delay, no_delay}},
                                     {Command::trigger_out_2, {0, no_delay}}}) {
    steps.push_back(std::move(step));
  }
  for (const Step& step : steps) {
    if (const Status done = link_.write(step.command, step.payload); !done) return done;
  }
  if (const Status written = write_entries(plan); !written) return written;
  return validate();
}

Status Control::write_entries(const PatternPlan& plan) {
  if (const Status opened = write(Command::mailbox_control, {3}); !opened) return opened;
  Status entered;
  for (std::size_t i = 0; i < plan.entries.size() && entered; ++i) {
    const PlanEntry& entry = plan.entries[i];
    entered =
        write(Command::variable_address, {static_cast<std::uint8_t>(i & 0xFFU), static_cast<std::uint8_t>(i >> 8)});
    if (!entered) break;
    entered = link_.write(Command::variable_data, variable_bytes(entry.lut, entry.exposure_us, entry.period_us));
  }
  const Status closed = write(Command::mailbox_control, {0});
  return entered ? closed : entered;
}

Status Control::validate() {
  const double until_s = monotonic_s() + settings_.validate_s;
  if (const Status begun = write(Command::validate, {0}); !begun) return begun;
  while (monotonic_s() < until_s) {
    const Result<Bytes> answer = link_.read(Command::validate);
    if (!answer) return answer.fault();
    const Validation result = validation(answer->front());
    if (result.busy) {
      sleep_until(monotonic_s() + 0.005);
      continue;
    }
    std::string wrong;
    if (result.bad_timing) wrong = "an exposure or a period is out of its range";
    if (result.bad_pattern) wrong = "a pattern number is invalid";
    if (settings_.warnings_are_faults) {
      if (result.trigger_overlap) wrong = "a trigger output overlaps black time";
      if (result.black_missing) wrong = "no black before an entry that waits for the video signal";
      if (result.short_gap) wrong = "less than 230 us between exposures";
    }
    if (wrong.empty()) return {};
    return fault("projector.validation", "its own check of the pattern table says: " + wrong,
                 "report the show and the firmware's version");
  }
  return fault("projector.validation", "its own check of the pattern table does not end",
               "switch it off and on, then open it again");
}

Status Control::start() {
  const double brightness = std::min(settings_.brightness, settings_.most_brightness);
  if (const Status set = link_.write(Command::led_current, led_current_bytes(brightness)); !set) return set;
  if (const Status lit = write(Command::led_enable, {leds_by_sequencer}); !lit) return lit;
  for (int tries = 0; tries < 2; ++tries) {
    if (const Status begun = write(Command::pattern_run, {2}); !begun) return begun;
    const double until_s = monotonic_s() + settings_.settle_s;
    do {
      const Result<BoardState> state = look();
      if (!state) return state.fault();
      if (state->main.running) return {};
      sleep_until(monotonic_s() + 0.01);
    } while (monotonic_s() < until_s);
  }
  (void)dark();
  return fault("projector.start", "it was told to start twice and does not run",
               "look whether its video signal arrives, then arm it again");
}

Result<BoardState> Control::look() {
  BoardState state;
  const Result<Bytes> hardware = link_.read(Command::hardware_status);
  if (!hardware) return hardware.fault();
  const Result<Bytes> main = link_.read(Command::main_status);
  if (!main) return main.fault();
  const Result<Bytes> leds = link_.read(Command::led_enable);
  if (!leds) return leds.fault();
  state.hardware = hardware_status(hardware->front());
  state.main = main_status(main->front());
  state.led_enable = leds->front();
  return state;
}

Status Control::check_signal() {
  const Result<Bytes> answer = link_.read(Command::video_signal);
  if (!answer) return answer.fault();
  const auto signal = video_signal(*answer);
  if (signal && signal->active_px == width_px && signal->active_lines == height_px) return {};
  const std::string size =
      signal ? std::to_string(signal->active_px) + " x " + std::to_string(signal->active_lines) : "nothing";
  return fault("projector.no-video", "it receives " + size + ", not 912 x 1140 pixels",
               "connect its HDMI input to the display that this rig feeds, in a mode of 912 x 1140");
}

Status Control::lamp(bool on) {
  const Status current = link_.write(Command::led_current, led_current_bytes(on ? identify_brightness : 0.0));
  const Status enabled = write(Command::led_enable, {on ? led_green : leds_off});
  return current ? enabled : current;
}

Status Control::blink() {
  for (int i = 0; i < 2 * blinks; ++i) {
    if (const Status told = lamp(i % 2 == 0); !told) return told;
    const double until_s = monotonic_s() + blink_s;
    while (!hurry_ && monotonic_s() < until_s) sleep_until(monotonic_s() + 0.005);
  }
  return {};
}

Status Control::standby() {
  (void)dark();
  return write(Command::power, {1});
}

}  // namespace focalstage::lightcrafter
