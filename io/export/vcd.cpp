#include "io/export/vcd.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "core/scene/number_text.h"
#include "io/export/image_name.h"

namespace focalstage {
namespace {

using Tick = std::int64_t;

constexpr double ticks_per_second = 1e7;
constexpr int periods = 2;
constexpr double trigger_s = 10e-6;

Tick tick_of(double time_s) { return std::llround(time_s * ticks_per_second); }

/// A stretch of time in which something is so, from its first tick to before its last.
struct Span {
  Tick begin = 0;
  Tick end = 0;
  int value = 1;
};

/// The stretch in every period that touches the dump: one that began before the dump, or before its period, is there
/// too.
std::vector<Span> repeated(double begin_s, double end_s, double period_s, int value) {
  std::vector<Span> out;
  for (int period = -1; period <= periods; ++period) {
    const double from_s = period * period_s;
    out.push_back({tick_of(from_s + begin_s), tick_of(from_s + end_s), value});
  }
  return out;
}

void append(std::vector<Span>& to, const std::vector<Span>& more) { to.insert(to.end(), more.begin(), more.end()); }

/// The value of the stretch that holds at `tick`, of several the one that began last; -1 where none does.
int value_at(const std::vector<Span>& spans, Tick tick) {
  const Span* latest = nullptr;
  for (const Span& span : spans)
    if (span.begin <= tick && tick < span.end && (!latest || span.begin >= latest->begin)) latest = &span;
  return latest ? latest->value : -1;
}

class Dump {
 public:
  explicit Dump(double period_s) : end_(tick_of(periods * period_s)) {}

  /// A wire that is 1 within `spans`.
  void wire(const std::string& name, const std::vector<Span>& spans) {
    each_change(declare("wire", 1, name), spans, [](int value) { return std::string(value >= 0 ? "1" : "0"); });
  }

  /// A number of `bits` that is the value of `spans`, and unknown outside of them.
  void vector(const std::string& name, int bits, const std::vector<Span>& spans) {
    each_change(declare("wire", bits, name), spans, [bits](int value) {
      std::string text = "b";
      for (int bit = bits; bit-- > 0;) text += value < 0 ? 'x' : (value >> bit & 1) ? '1' : '0';
      return text + " ";
    });
  }

  /// A real, sampled evenly over each period.
  void real(const std::string& name, const std::vector<double>& samples, double period_s) {
    const std::string id = declare("real", 64, name);
    if (samples.empty()) return change(0, "r0 " + id);
    const double step_s = period_s / static_cast<double>(samples.size());
    const std::size_t count = samples.size() * periods;
    for (std::size_t k = 0; k < count; ++k)
      change(tick_of(static_cast<double>(k) * step_s), "r" + number_text(samples[k % samples.size()]) + " " + id);
  }

  std::string text(const std::string& about) const {
    std::string out = "$version " + about + " $end\n$timescale 100 ns $end\n$scope module focalstage $end\n";
    out += declarations_ + "$upscope $end\n$enddefinitions $end\n";
    for (const auto& [tick, lines] : changes_) {
      out += "#" + std::to_string(tick) + "\n";
      out += tick == 0 ? "$dumpvars\n" + lines + "$end\n" : lines;
    }
    return out + "#" + std::to_string(end_) + "\n";
  }

 private:
  /// Identifiers are digits to the base of the 94 printable characters.
  std::string declare(const std::string& type, int bits, const std::string& name) {
    std::string id;
    for (int rest = signals_++;; rest = rest / 94 - 1) {
      id += static_cast<char>('!' + rest % 94);
      if (rest < 94) break;
    }
    declarations_ += "$var " + type + " " + std::to_string(bits) + " " + id + " " + name + " $end\n";
    return id;
  }

  void change(Tick tick, const std::string& line) {
    if (tick < end_) changes_[tick] += line + "\n";
  }

  template <class Text>
  void each_change(const std::string& id, const std::vector<Span>& spans, Text text_of) {
    std::vector<Tick> ticks{0};
    for (const Span& span : spans)
      for (const Tick tick : {span.begin, span.end})
        if (tick > 0) ticks.push_back(tick);
    std::sort(ticks.begin(), ticks.end());
    std::string last;
    for (const Tick tick : ticks) {
      const std::string text = text_of(value_at(spans, tick));
      if (text != last) change(tick, text + id);
      last = text;
    }
  }

  Tick end_;
  int signals_ = 0;
  std::string declarations_;
  std::map<Tick, std::string> changes_;
};

/// "left-+0.50D" as one word for waveform viewers: "image_3_left_p0_50D".
std::string wire_name(std::size_t image, const std::string& name) {
  std::string out = "image_" + std::to_string(image) + "_" + name;
  for (char& c : out)
    if (c == '.' || c == '-') c = '_';
  const std::size_t sign = name.find('-') + 1;  // behind the eye
  out[out.size() - name.size() + sign] = name[sign] == '-' ? 'm' : 'p';
  return out;
}

std::vector<Span> exposures(const Schedule& schedule, int image) {
  std::vector<Span> out;
  for (const Slot& slot : schedule.slots) {
    if (image >= 0 && slot.image != image) continue;
    append(out, repeated(slot.start_s, slot.start_s + slot.exposure_s, schedule.period_s, slot.image));
  }
  return out;
}

std::vector<Span> triggers(const Schedule& schedule) {
  std::vector<Span> out;
  for (const Slot& slot : schedule.slots)
    append(out, repeated(slot.trigger_s, slot.trigger_s + trigger_s, schedule.period_s, 1));
  return out;
}

/// A shutter that is told to close before it is told to open stays open over the period's end.
std::vector<Span> open(const ShutterTimes& shutter, double period_s) {
  const double close_s = shutter.close_s < shutter.open_s ? shutter.close_s + period_s : shutter.close_s;
  return repeated(shutter.open_s, close_s, period_s, 1);
}

}  // namespace

std::string timing_vcd(const ShowHeader& header) {
  const Schedule& schedule = header.schedule;
  Dump dump(schedule.period_s);
  dump.wire("exposing", exposures(schedule, -1));
  dump.vector("image", 16, exposures(schedule, -1));
  const std::vector<std::string> names = image_names(header.images);
  for (std::size_t i = 0; i < names.size(); ++i)
    dump.wire(wire_name(i, names[i]), exposures(schedule, static_cast<int>(i)));
  dump.wire("trigger", triggers(schedule));
  dump.wire("left_shutter", open(schedule.shutter.left, schedule.period_s));
  dump.wire("right_shutter", open(schedule.shutter.right, schedule.period_s));
  dump.real("left_power_d", schedule.lens_power_d.left, schedule.period_s);
  dump.real("right_power_d", schedule.lens_power_d.right, schedule.period_s);
  dump.real("left_drive_a", schedule.lens_drive_a.left, schedule.period_s);
  dump.real("right_drive_a", schedule.lens_drive_a.right, schedule.period_s);
  return dump.text(header.compiler);
}

}  // namespace focalstage
