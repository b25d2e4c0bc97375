#include "devices/uno/table.h"

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <optional>

namespace focalstage::uno {

namespace {

constexpr double tick_s = 0.5e-6;
constexpr double most_ticks = 65535.0;

Fault fault(const std::string& where, const std::string& message, const std::string& remedy) {
  return {"board.table", where, message, remedy};
}

std::string in_ms(double seconds) {
  char text[48];
  std::snprintf(text, sizeof text, "%.4g ms", seconds * 1e3);
  return text;
}

Result<long> ticks_of(double seconds, const std::string& where) {
  const double ticks = std::round(seconds / tick_s);
  if (ticks >= 0.0 && ticks <= most_ticks) return static_cast<long>(ticks);
  return fault(where, in_ms(seconds) + " is no time that the board can count", "it lies between 0 and 32.76 ms");
}

Result<std::string> shutter_command(const char* eye, const ShutterWindow& window, const BoardTable& table) {
  const std::string where = std::string(eye) == "L" ? "left shutter" : "right shutter";
  const double length_s = window.close_s - window.open_s;
  if (!(length_s > 2.0 * tick_s) || !(length_s < table.period_s - 2.0 * tick_s) || !(window.open_s >= 0.0) ||
      !(window.open_s < table.period_s)) {
    return fault(where, "it opens at " + in_ms(window.open_s) + " and closes at " + in_ms(window.close_s),
                 "open it within the period of " + in_ms(table.period_s) + " and for less than that");
  }
  const Result<long> period = ticks_of(table.period_s, where);
  const Result<long> open = ticks_of(window.open_s, where);
  const Result<long> close = ticks_of(std::fmod(window.close_s, table.period_s), where);
  if (!period) return period.fault();
  if (!open) return open.fault();
  if (!close) return close.fault();
  // Rounded up to the period's end is the next period's beginning.
  return std::string("OPEN ") + eye + " " + std::to_string(*open % *period) + " " + std::to_string(*close % *period);
}

std::string words_for(unsigned code) {
  switch (code) {
    case 3:
      return "the time is out of its range";
    case 4:
      return "both shutters would be open at once";
    case 6:
      return "the board has no table begun";
    case 8:
      return "the board got other triggers than were sent";
    default:
      return "the board refused it with error " + std::to_string(code);
  }
}

}  // namespace

Result<std::vector<std::string>> table_commands(const BoardTable& table) {
  const Result<long> period = ticks_of(table.period_s, "period");
  if (!period) return period.fault();
  const Result<long> pulse = ticks_of(table.pulse_s, "pulse");
  if (!pulse) return pulse.fault();
  std::vector<std::string> commands{"TABLE " + std::to_string(*period) + " " + std::to_string(*pulse)};
  for (std::size_t k = 0; k < table.trigger_s.size(); ++k) {
    const Result<long> at = ticks_of(table.trigger_s[k], "trigger " + std::to_string(k));
    if (!at) return at.fault();
    commands.push_back("TRIG " + std::to_string(k) + " " + std::to_string(*at));
  }
  const auto add = [&](const char* eye, const std::optional<ShutterWindow>& window) -> Status {
    if (!window) return {};
    Result<std::string> command = shutter_command(eye, *window, table);
    if (!command) return command.fault();
    commands.push_back(std::move(command).value());
    return {};
  };
  if (const Status left = add("L", table.shutter.left); !left) return left.fault();
  if (const Status right = add("R", table.shutter.right); !right) return right.fault();
  commands.push_back("COMMIT " + std::to_string(table.trigger_s.size()));
  return commands;
}

Fault table_fault(const std::string& command, unsigned code) {
  std::string remedy = "up to 32 triggers, 50 us or more after the edge, after each pulse, and before the next edge";
  if (command.starts_with("COMMIT")) remedy += "; pulses of 40 us to 1 ms; a period of 8 to 22.5 ms";
  if (code == 4) remedy = "close one shutter before the other opens";
  return fault(command, words_for(code), remedy);
}

}  // namespace focalstage::uno
