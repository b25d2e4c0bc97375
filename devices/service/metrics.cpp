#include "devices/service/metrics.h"

#include <array>
#include <charconv>
#include <cmath>

namespace focalstage {

namespace {

constexpr std::array<const char*, 5> states{"empty", "ready", "playing", "holding", "dark"};

std::string number(double value) {
  if (std::isinf(value)) return value > 0 ? "+Inf" : "-Inf";
  std::array<char, 32> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() ? std::string(text.data(), end) : "NaN";
}

/// As the format wants a label's value.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '\n') {
      result += "\\n";
      continue;
    }
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\"";
}

class Page {
 public:
  void begin(const char* name, const char* type, const char* help) {
    name_ = std::string("focalstage_") + name;
    text_ += "# HELP " + name_ + " " + help + "\n# TYPE " + name_ + " " + type + "\n";
  }
  void add(double value, const std::string& labels = "", const char* ending = "") {
    text_ += name_ + ending + (labels.empty() ? "" : "{" + labels + "}") + " " + number(value) + "\n";
  }
  void one(const char* name, const char* type, const char* help, double value) {
    begin(name, type, help);
    add(value);
  }
  std::string take() { return std::move(text_); }

 private:
  std::string name_;
  std::string text_;
};

/// Buckets are cumulative there, apart here. What was measured is no more than its bin.
void add_lateness(Page& page, const std::vector<LatenessBin>& bins) {
  page.begin("sweep_lateness_seconds", "histogram", "How much later than planned sweeps were handed over.");
  std::uint64_t sweeps = 0;
  for (const LatenessBin& bin : bins) {
    sweeps += bin.sweeps;
    page.add(static_cast<double>(sweeps), "le=\"" + number(bin.up_to_us / 1e6) + "\"", "_bucket");
  }
  page.add(static_cast<double>(sweeps), "", "_count");
}

}  // namespace

std::string metrics_text(const RuntimeFigures& figures) {
  const RigState& state = figures.state;
  Page page;
  page.begin("state", "gauge", "1 for the state that the rig is in.");
  for (const char* name : states) page.add(state.state == name, "state=" + quoted(name));
  page.one("fault_latched", "gauge", "1 while a fault keeps the rig dark.", !state.fault.empty());
  page.one("held", "gauge", "1 while an editor holds the rig.", !state.holder.empty());
  page.one("sweeps_total", "counter", "Sweeps handed over.", static_cast<double>(state.sweeps));
  page.one("missed_exposures_total", "counter", "Exposures that were due and did not come.",
           static_cast<double>(state.missed_exposures));
  page.one("late_sweeps_total", "counter", "Sweeps that were not ready when they began.",
           static_cast<double>(state.late_sweeps));
  add_lateness(page, state.lateness);
  page.begin("temperature_celsius", "gauge", "Of a part of the rig.");
  for (const Temperature& part : state.temperatures) page.add(part.celsius, "part=" + quoted(part.part));
  page.one("push_bytes_total", "counter", "Bytes of shows that arrived.", static_cast<double>(figures.push_bytes));
  page.one("watchers", "gauge", "Open watch streams and live links.", figures.watchers);
  page.one("connections", "gauge", "Open connections of clients.", figures.connections);
  page.one("connections_turned_away_total", "counter", "Connections beyond the bound, closed at once.",
           static_cast<double>(figures.turned_away));
  page.begin("faults_total", "counter", "Darkness and refusals, by the fault's code.");
  for (const auto& [code, count] : figures.faults) page.add(static_cast<double>(count), "code=" + quoted(code));
  return page.take();
}

}  // namespace focalstage
