#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <thread>

#include <CLI/CLI.hpp>

#include "tests/devices/uno/emulator/paced_uno.h"

namespace {

volatile std::sig_atomic_t asked_to_end = 0;

using namespace focalstage::uno_emulator;

void add_faults(CLI::App& app, Misbehaviour& how) {
  app.add_flag("--silent", how.silent, "nothing that it says arrives");
  app.add_flag("--deaf", how.deaf, "nothing that it is told arrives");
  app.add_option("--damage-every", how.damage_every, "one line in so many that it says is damaged");
  app.add_option("--damage-requests-every", how.damage_requests_every,
                 "one line in so many that it is told is damaged");
  app.add_option("--lose-every", how.lose_every, "one line in so many that it says is lost");
  app.add_option("--wrong-number-every", how.wrong_number_every, "one answer in so many answers another request");
  app.add_flag("--stale", how.stale, "before each line the one before it comes again");
  app.add_flag("--refuse", how.refuse, "refuses everything");
  app.add_option("--delay", how.delay_s, "its lines come so many seconds late")->check(CLI::NonNegativeNumber);
  app.add_flag("--dribble", how.dribble, "what it says comes byte by byte");
  app.add_option("--unplug-after", how.unplug_after, "so many bytes said, its port is gone; back after 2 s");
}

void report(UnoEmulator& uno) {
  const Chip& chip = uno.chip();
  std::printf("%s: trigger %s, left %s, right %s, lamp %s\n", uno.plugged_in() ? uno.path().c_str() : "unplugged",
              chip.trigger_high ? "high" : "low", chip.left_high ? "high" : "low", chip.right_high ? "high" : "low",
              chip.lamp_high ? "on" : "off");
  std::fflush(stdout);
}

void run(PacedUno& uno, int replug_every_s) {
  for (int second = 0; asked_to_end == 0; ++second) {
    std::this_thread::sleep_for(std::chrono::seconds(1));
    uno.with([&](UnoEmulator& board) {
      if (replug_every_s > 0 && second % replug_every_s == replug_every_s - 1) board.unplug();
      report(board);
    });
    if (uno.with([](UnoEmulator& board) { return board.plugged_in(); })) continue;
    std::this_thread::sleep_for(std::chrono::seconds(2));
    uno.with([](UnoEmulator& board) { board.plug_in(); });
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "A trigger board: the firmware on a simulated Arduino Uno, with sync edges of its own and a pty as its port, "
      "until it is interrupted");
  Options options;
  options.firmware_elf = FOCALSTAGE_FIRMWARE_ELF;
  Pace pace;
  pace.remembers = false;
  Misbehaviour how;
  std::string link;
  int replug_every_s = 0;
  app.add_option("--firmware", options.firmware_elf, "the program on the chip")->capture_default_str();
  app.add_option("--link", link, "a link of this name leads to the port, wherever it is");
  app.add_flag("--resets-when-opened", options.resets_when_opened, "opening the port resets it, as with a real Uno");
  app.add_option("--boot", options.boot_s, "how long it is deaf then, in seconds")->capture_default_str();
  app.add_option("--sync", pace.sync_hz, "sync edges per second; 0: none")->capture_default_str();
  app.add_option("--clock-ppm", pace.clock_ppm, "how much too fast its clock runs")->capture_default_str();
  app.add_option("--stray-every", pace.stray_every, "after so many edges comes one that should not");
  app.add_option("--replug-every", replug_every_s, "unplugged every so many seconds, for two");
  add_faults(app, how);
  CLI11_PARSE(app, argc, argv);

  std::signal(SIGINT, [](int) { asked_to_end = 1; });
  std::signal(SIGTERM, [](int) { asked_to_end = 1; });
  try {
    PacedUno uno(options, pace);
    uno.misbehave(how);
    uno.with([&](UnoEmulator& board) {
      if (!link.empty()) board.set_link(link);
    });
    std::printf("%s\n", uno.path().c_str());
    std::fflush(stdout);
    run(uno, replug_every_s);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
