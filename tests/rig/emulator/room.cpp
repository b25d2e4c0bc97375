#include "tests/rig/emulator/room.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace focalstage::rig_emulator {

namespace {

constexpr double chip_hz = 16e6;
constexpr int logic_high = 2048;  ///< of a converter of 12 bits and 5 V: above the Uno's threshold
constexpr int looks = 16;         ///< of an exposure, for the least and the most power in it
constexpr double remembered_s = 0.2;

uno_emulator::Options board_options(const RoomSettings& settings) {
  uno_emulator::Options options;
  options.firmware_elf = settings.firmware_elf;
  return options;
}

}  // namespace

Room::Room(const RoomSettings& settings, std::unique_ptr<mcc1208_emulator::Emulator> generator)
    : settings_(settings),
      board_hz_(chip_hz * (1.0 + 1e-6 * settings.board_clock_ppm)),
      generator_(std::move(generator)),
      board_(board_options(settings)),
      optics_(settings.optics),
      lens_(settings.lens),
      shutter_{SimShutter(SimShutterSettings{}), SimShutter(SimShutterSettings{})},
      report_(std::fopen(settings.report.c_str(), "w")) {
  if (report_ == nullptr) {
    std::perror(settings.report.c_str());
    std::abort();
  }
  if (!settings.photodiodes.board_link.empty()) {
    photodiodes_.emplace(settings.photodiodes, [this](Side eye, double time_s) {
      return BeforeDiode{lens_.power_d(time_s), shutter_[eye].at(time_s)};
    });
  }
  board_.set_link(settings.board_link);
  generator_->on_output([this](const mcc1208_emulator::Output& output) { hear(output); });
  generator_->plug_in();
  lens_.step(0.0, 0.0);
  for (const Side eye : both_sides) shutter_[eye].command(ShutterLevel::closed, 0.0);
}

Room::~Room() { std::fclose(report_); }

void Room::advance_to(double time_s, double monotonic_s) {
  generator_->advance_to(time_s);
  board_.run_until(cycles(time_s));
  heed_pins();
  if (photodiodes_) photodiodes_->advance_to(time_s);
  time_s_ = time_s;
  optics_.advance_to(time_s, monotonic_s);
  end_exposures();
}

void Room::hear(const mcc1208_emulator::Output& output) {
  set_current(output.time_s, output.codes[0]);
  const bool rises = sync_code_ < logic_high && output.codes[1] >= logic_high;
  sync_code_ = output.codes[1];
  if (!rises) return;
  board_.chip().edge_at(cycles(output.time_s));
  if (photodiodes_) photodiodes_->edge_at(output.time_s);
}

void Room::set_current(double time_s, int code) {
  const auto pins = generator_->pins(settings_.enable_bit / 8);
  const bool enabled = pins && (*pins >> (settings_.enable_bit % 8) & 1) != 0;
  const double volts = (code - settings_.zero_code) * 5.0 / 4096.0;
  lens_.step(time_s, enabled ? volts * settings_.amperes_per_volt : 0.0);
}

void Room::heed_pins() {
  uno_emulator::Chip& chip = board_.chip();
  for (const uno_emulator::Cycle edge : chip.edges) {
    edge_s_ = seconds(edge);
    ++edges_;
  }
  const auto move = [this](Side eye, const std::vector<uno_emulator::PinChange>& changes) {
    for (const uno_emulator::PinChange& change : changes) {
      if (closed_[eye] == change.high) continue;
      closed_[eye] = change.high;
      shutter_[eye].command(change.high ? ShutterLevel::closed : ShutterLevel::open, seconds(change.at));
    }
  };
  move(Side::left, chip.left);
  move(Side::right, chip.right);
  for (const uno_emulator::PinChange& change : chip.trigger) {
    if (!change.high) continue;
    const auto begun = optics_.trigger(seconds(change.at));
    if (!begun) continue;
    lit_.push_back(*begun);
    if (photodiodes_) photodiodes_->lit(*begun);
  }
  chip.forget();
}

void Room::end_exposures() {
  while (!lit_.empty() && lit_.front().start_s + lit_.front().exposure_s < time_s_) {
    const Begun& light = lit_.front();
    const double end_s = light.start_s + light.exposure_s;
    double least_d = INFINITY;
    double most_d = -INFINITY;
    for (int i = 0; i <= looks; ++i) {
      const double power_d = lens_.power_d(std::lerp(light.start_s, end_s, static_cast<double>(i) / looks));
      least_d = std::min(least_d, power_d);
      most_d = std::max(most_d, power_d);
    }
    const Transmission left = shutter_.left.during(light.start_s, end_s);
    const Transmission right = shutter_.right.during(light.start_s, end_s);
    std::fprintf(report_,
                 "{\"start_s\":%.9f,\"exposure_s\":%.9f,\"edge_s\":%.9f,\"edges\":%llu,\"dark\":%s,\"crc\":%u,"
                 "\"power_d\":%.6f,\"least_d\":%.6f,\"most_d\":%.6f,\"left\":[%.4f,%.4f],\"right\":[%.4f,%.4f]}\n",
                 light.start_s, light.exposure_s, edge_s_, static_cast<unsigned long long>(edges_),
                 light.dark ? "true" : "false", light.crc, lens_.power_d(0.5 * (light.start_s + end_s)), least_d,
                 most_d, left.least, left.most, right.least, right.most);
    lit_.pop_front();
  }
  for (const Side eye : both_sides) shutter_[eye].forget_before(time_s_ - remembered_s);
  std::fflush(report_);
}

std::string Room::look() const {
  char text[160];
  std::snprintf(text, sizeof text, "{\"time_s\":%.6f,\"power_d\":%.6f,\"closed\":[%s,%s]}", time_s_,
                lens_.power_d(time_s_), closed_.left ? "true" : "false", closed_.right ? "true" : "false");
  return text;
}

bool Room::unplug(const std::string& device) {
  if (device == "lens") {
    generator_->unplug();
    lens_.step(time_s_, 0.0);  // its enable line falls
  } else if (device == "board") {
    board_.unplug();
  } else if (device == "projector") {
    optics_.unplug();
  } else {
    return false;
  }
  return true;
}

bool Room::plug_in(const std::string& device) {
  if (device == "lens") {
    generator_->plug_in();
  } else if (device == "board") {
    board_.plug_in();
  } else if (device == "projector") {
    optics_.plug_in();
  } else {
    return false;
  }
  return true;
}

}  // namespace focalstage::rig_emulator
