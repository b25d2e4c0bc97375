#include <sys/wait.h>
#include <umockdev.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>

#include <CLI/CLI.hpp>

#include "tests/devices/input/emulator/spacemouse_host.h"

int main(int argc, char** argv) {
  using namespace focalstage::spacemouse_emulator;
  CLI::App app(
      "A SpaceMouse that a hand turns and pushes in turn, for PROGRAM: umockdev-wrapper spacemouse-emulator PROGRAM");
  SpaceMouseKind kind;
  bool no_zero = false;
  std::vector<std::string> program;
  app.add_flag("--combined", kind.combined, "turns in report 1, as newer devices have them");
  app.add_flag("--no-last-report", no_zero, "the report that says that the hand is gone is lost");
  app.add_option("PROGRAM", program, "and its arguments")->required();
  app.positionals_at_end();
  CLI11_PARSE(app, argc, argv);

  UMockdevTestbed* bed = umockdev_testbed_new();
  auto host = SpaceMouseHost::start(bed, kind);
  std::vector<gchar*> words;
  for (std::string& word : program) words.push_back(word.data());
  words.push_back(nullptr);
  GPid child = 0;
  GError* error = nullptr;
  const auto flags =
      static_cast<GSpawnFlags>(G_SPAWN_SEARCH_PATH | G_SPAWN_DO_NOT_REAP_CHILD | G_SPAWN_CHILD_INHERITS_STDIN);
  if (g_spawn_async(nullptr, words.data(), nullptr, flags, nullptr, nullptr, &child, &error) == FALSE) {
    std::fprintf(stderr, "%s\n", error->message);
    return 1;
  }
  for (int tenth = 0; ::waitpid(child, nullptr, WNOHANG) == 0; ++tenth) {
    Hand hand;
    hand.counts[(tenth / 40) % 6] = static_cast<int>(200.0 * std::sin(tenth * 0.157));
    if (tenth % 40 < 30) host->hold(hand);
    if (tenth % 40 == 30) host->let_go(!no_zero);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  host.reset();
  g_object_unref(bed);
  return 0;
}
