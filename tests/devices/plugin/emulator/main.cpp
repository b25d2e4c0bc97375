#include <chrono>
#include <csignal>
#include <cstdio>
#include <thread>

#include <CLI/CLI.hpp>

#include "tests/devices/plugin/emulator/optics.h"

namespace {

volatile std::sig_atomic_t asked_to_end = 0;

}  // namespace

int main(int argc, char** argv) {
  using namespace focalstage::wire_emulator;
  CLI::App app(
      "The optics at the other end of the plugin wire, triggered by a clock of its own, until it is interrupted");
  OpticsOptions options;
  OpticsFaults faults;
  app.add_option("SOCKET", options.socket, "the path that the plugin's option `socket` names")->required();
  app.add_option("--width", options.width_px, "in pixels")->capture_default_str();
  app.add_option("--height", options.height_px, "in pixels")->capture_default_str();
  app.add_flag("--deaf", faults.deaf, "takes nothing from the socket");
  app.add_flag("--mute", faults.mute, "tells no counts");
  app.add_flag("--no-answer", faults.no_answer, "to blanks");
  app.add_flag("--no-triggers", faults.no_triggers, "shows nothing");
  app.add_flag("--hang-up", faults.hang_up_at_frame, "in the middle of the next frame");
  CLI11_PARSE(app, argc, argv);

  const auto optics = Optics::start(options);
  if (!optics) {
    std::fprintf(stderr, "%s cannot be had as a socket\n", options.socket.c_str());
    return 1;
  }
  optics->misbehave(faults);
  std::signal(SIGINT, [](int) { asked_to_end = 1; });
  std::signal(SIGTERM, [](int) { asked_to_end = 1; });
  while (asked_to_end == 0) {
    std::this_thread::sleep_for(std::chrono::seconds(1));
    const OpticsRecord record = optics->record();
    std::printf("%s, %llu shown, %llu missed %s\n", record.triggers ? "started" : "dark",
                static_cast<unsigned long long>(record.shown), static_cast<unsigned long long>(record.missed),
                record.broken.c_str());
    std::fflush(stdout);
  }
  return 0;
}
