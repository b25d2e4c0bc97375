#include "tests/rig/emulator/photodiodes.h"

#include <cmath>
#include <utility>

namespace focalstage::rig_emulator {

namespace {

constexpr double chip_hz = 16e6;
constexpr double remembered_s = 0.1;

uno_emulator::Options board_options(const PhotodiodesSettings& settings) {
  uno_emulator::Options options;
  options.firmware_elf = settings.firmware_elf;
  return options;
}

/// Of a line as wide as the slit, each point of which is spread evenly over `widths` of it: the share that goes
/// through.
double through_slit(double widths) { return widths < 2.0 ? 1.0 - widths / 4.0 : 1.0 / widths; }

}  // namespace

Photodiodes::Photodiodes(const PhotodiodesSettings& settings, Look look)
    : settings_(settings), look_(std::move(look)), board_(board_options(settings)) {
  board_.set_link(settings_.board_link);
  board_.chip().set_analogue([this](int input, double cycle) { return share(input, cycle / board_hz()); });
}

double Photodiodes::board_hz() const { return chip_hz * (1.0 + 1e-6 * settings_.board_clock_ppm); }

std::vector<PixelRectangle> Photodiodes::regions(const PhotodiodesSettings& settings) {
  std::vector<PixelRectangle> regions;
  for (const LineOnCard& line : settings.lines) {
    for (const Side eye : both_sides) regions.push_back(line.rectangle_px[eye]);
  }
  return regions;
}

void Photodiodes::edge_at(double time_s) {
  board_.chip().edge_at(static_cast<uno_emulator::Cycle>(time_s * board_hz()));
}

void Photodiodes::advance_to(double time_s) {
  board_.run_until(static_cast<uno_emulator::Cycle>(time_s * board_hz()));
  board_.chip().forget();
  while (!lit_.empty() && lit_.front().start_s + lit_.front().exposure_s < time_s - remembered_s) lit_.pop_front();
}

double Photodiodes::share(int input, double time_s) {
  std::normal_distribution<double> noise(0.0, settings_.noise);
  double share = settings_.ambient + noise(random_);
  if (input > 1) return share;
  const Side eye = input == 0 ? Side::left : Side::right;
  for (const Begun& light : lit_) {
    if (time_s < light.start_s || time_s >= light.start_s + light.exposure_s || light.levels.empty()) continue;
    const BeforeDiode before = look_(eye, time_s);
    double reaches = settings_.white * light.mean_level;
    for (std::size_t i = 0; i < settings_.lines.size(); ++i) {
      const double widths = std::abs(before.power_d - settings_.lines[i].power_d) / settings_.slit_d;
      reaches += settings_.line * light.levels[2 * i + (eye == Side::left ? 0 : 1)] * through_slit(widths);
    }
    share += before.transmission * reaches;
  }
  return share;
}

}  // namespace focalstage::rig_emulator
