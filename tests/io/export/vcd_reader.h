#pragma once

#include <cstdint>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

// A strict reader of the Value Change Dumps of IEEE 1364 (four-state), as far as ours go: it takes nothing that the
// standard does not allow, and stops at the first thing wrong.
namespace focalstage::vcd {

struct Signal {
  std::string type;
  int bits = 0;
  std::string name;
  std::map<std::int64_t, std::string> values;  ///< by tick; what it changes to

  /// What it is at `tick`.
  std::string at(std::int64_t tick) const {
    auto next = values.upper_bound(tick);
    return next == values.begin() ? "" : std::prev(next)->second;
  }
};

struct Document {
  std::string wrong;  ///< empty: none
  std::string timescale;
  std::int64_t end = 0;
  std::map<std::string, Signal> by_name;
};

class Reader {
 public:
  explicit Reader(const std::string& text) : in_(text) {}

  Document document() {
    if (wrong_.empty()) declarations();
    if (wrong_.empty()) changes();
    Document out{wrong_, timescale_, last_, {}};
    for (auto& [id, signal] : signals_) out.by_name[signal.name] = std::move(signal);
    if (out.wrong.empty() && out.by_name.size() != signals_.size()) out.wrong = "two signals of one name";
    return out;
  }

 private:
  std::string word() {
    std::string text;
    in_ >> text;
    return text;
  }
  void demand(bool holds, const std::string& what) {
    if (!holds && wrong_.empty()) wrong_ = what;
  }
  std::string until_end() {
    std::string all;
    for (std::string next = word(); next != "$end"; next = word()) {
      demand(!next.empty() && next[0] != '$', "a section without $end");
      if (!wrong_.empty()) break;
      all += (all.empty() ? "" : " ") + next;
    }
    return all;
  }

  void declarations() {
    int depth = 0;
    for (std::string key = word(); wrong_.empty(); key = word()) {
      if (key == "$version" || key == "$comment" || key == "$date") {
        until_end();
      } else if (key == "$timescale") {
        timescale_ = until_end();
      } else if (key == "$scope") {
        demand(until_end().rfind("module ", 0) == 0, "a scope that is no module");
        ++depth;
      } else if (key == "$upscope") {
        demand(until_end().empty() && depth-- > 0, "$upscope without a scope");
      } else if (key == "$var") {
        variable(depth);
      } else if (key == "$enddefinitions") {
        demand(until_end().empty() && depth == 0, "definitions end within a scope");
        return;
      } else {
        demand(false, "unknown declaration " + key);
      }
    }
  }

  void variable(int depth) {
    Signal signal;
    std::string id;
    signal.type = word();
    signal.bits = std::atoi(word().c_str());
    id = word();
    signal.name = word();
    demand(word() == "$end", "a variable without $end");
    demand(depth > 0, "a variable outside of a scope");
    demand((signal.type == "wire" && signal.bits > 0) || (signal.type == "real" && signal.bits == 64),
           "a variable's type");
    for (const char c : id) demand(c >= '!' && c <= '~', "an identifier that is not printable");
    demand(!id.empty() && signals_.emplace(id, signal).second, "an identifier used twice");
  }

  void changes() {
    bool dumping = false;
    bool dumped = false;
    for (std::string token = word(); !token.empty() && wrong_.empty(); token = word()) {
      if (token[0] == '#') {
        const std::int64_t tick = std::atoll(token.c_str() + 1);
        demand(tick > last_ || (tick == 0 && last_ < 0), "time does not grow at " + token);
        demand(token == "#" + std::to_string(tick), "a time that is no number: " + token);
        last_ = tick;
      } else if (token == "$dumpvars") {
        demand(!dumped && last_ == 0, "$dumpvars not at the start");
        dumping = dumped = true;
      } else if (token == "$end") {
        demand(dumping, "$end of nothing");
        dumping = false;
        for (const auto& [id, signal] : signals_) demand(signal.values.size() == 1, "no first value of " + signal.name);
      } else {
        change(token);
      }
    }
    demand(dumped && !dumping, "no $dumpvars");
  }

  void change(const std::string& token) {
    demand(last_ >= 0, "a change before the first time");
    const bool spaced = token[0] == 'b' || token[0] == 'r';
    const std::string id = spaced ? word() : token.substr(1);
    const std::string value = spaced ? token.substr(1) : token.substr(0, 1);
    const auto found = signals_.find(id);
    demand(found != signals_.end(), "a change of an unknown signal: " + token);
    if (!wrong_.empty()) return;
    Signal& signal = found->second;
    if (token[0] == 'r') {
      char* end = nullptr;
      std::strtod(value.c_str(), &end);
      demand(signal.type == "real" && !value.empty() && *end == '\0', "no real: " + token);
    } else {
      demand(signal.type == "wire" && value.find_first_not_of("01xz") == std::string::npos && !value.empty(),
             "no bits: " + token);
      demand(spaced ? static_cast<int>(value.size()) <= signal.bits : signal.bits == 1, "the wrong width: " + token);
    }
    demand(signal.values.emplace(last_, value).second, "two changes at one time of " + signal.name);
  }

  std::istringstream in_;
  std::string wrong_;
  std::string timescale_;
  std::int64_t last_ = -1;
  std::map<std::string, Signal> signals_;
};

inline Document read(const std::string& text) { return Reader(text).document(); }

}  // namespace focalstage::vcd
