#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "tests/rig/emulator/room.h"

namespace {

using focalstage::rig_emulator::Room;
using focalstage::rig_emulator::RoomSettings;
using Clock = std::chrono::steady_clock;

constexpr double longest_step_s = 0.004;
constexpr double small_step_s = 0.0005;
constexpr auto turn = std::chrono::milliseconds(4);  // a host that is alive looks each millisecond or so
constexpr auto patience = std::chrono::milliseconds(200);

/// This program again, where umockdev can show its devices to it and to its child.
int run_under_wrapper(char** argv) {
  std::vector<char*> words{const_cast<char*>("umockdev-wrapper")};
  for (; *argv != nullptr; ++argv) words.push_back(*argv);
  words.push_back(nullptr);
  ::execvp(words[0], words.data());
  std::perror("umockdev-wrapper");
  return 1;
}

/// Hardware does not wait for a busy machine: before others, where that is allowed. Threads begin as who starts them.
void prefer_this_process(bool prefer) { (void)::setpriority(PRIO_PROCESS, 0, prefer ? -15 : 0); }

pid_t start(const std::vector<std::string>& command) {
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  const pid_t child = ::fork();
  if (child != 0) return child;
  prefer_this_process(false);
  ::close(STDIN_FILENO);
  ::execvp(words[0], words.data());
  std::perror(words[0]);
  ::_exit(127);
}

/// What was typed, if anything was.
std::optional<std::string> typed() {
  pollfd input{STDIN_FILENO, POLLIN | POLLHUP, 0};
  if (::poll(&input, 1, 0) <= 0) return std::nullopt;
  std::string line;
  for (char c = 0; ::read(STDIN_FILENO, &c, 1) == 1 && c != '\n';) line.push_back(c);
  return line.empty() ? "quit" : line;
}

void obey(Room& room, const std::string& line) {
  const std::size_t space = line.find(' ');
  const std::string verb = line.substr(0, space);
  const std::string device = space == std::string::npos ? "" : line.substr(space + 1);
  bool known = true;
  if (verb == "unplug") {
    known = room.unplug(device);
  } else if (verb == "plug") {
    known = room.plug_in(device);
  } else if (verb == "lose-trigger") {
    room.lose_next_trigger();
  } else {
    known = verb == "time";
  }
  std::printf("%s %s\n", known ? "done" : "unknown", room.look().c_str());
  std::fflush(stdout);
}

/// Device time goes on by so much at most, and is now's for the host; in small steps, so that it sees what lies
/// between.
void step(Room& room, Clock::duration elapsed) {
  double left_s = std::min(std::chrono::duration<double>(elapsed).count(), longest_step_s);
  const double now_s = std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
  for (; left_s > 0.0; left_s -= small_step_s) {
    const double small_s = std::min(left_s, small_step_s);
    room.advance_to(room.time_s() + small_s, now_s - left_s + small_s);
  }
}

/// Where this machine was busy, device time waits with it: a step is short, and there is none, for a while, where the
/// host that has claimed the generator got no turn to refill it. So a busy machine makes no gaps, and a host that hangs
/// does.
void run(Room& room, pid_t child) {
  std::optional<std::uint64_t> looks;
  auto looked = Clock::now();
  for (auto before = looked; ::waitpid(child, nullptr, WNOHANG) == 0;) {
    std::this_thread::sleep_for(std::chrono::microseconds(500));
    if (const auto line = typed()) {
      if (*line == "quit") break;
      obey(room, *line);
    }
    const auto now = Clock::now();
    const auto looks_now = room.host_looks();
    if (!looks_now || looks_now != looks) looked = now;
    looks = looks_now;
    const auto unseen = now - looked;
    if (unseen < turn || unseen > patience) {
      step(room, now - before);
    }
    before = now;
  }
  ::kill(child, SIGTERM);
  for (int wait = 0; wait < 300 && ::waitpid(child, nullptr, WNOHANG) == 0; ++wait) {
    step(room, std::chrono::milliseconds(2));
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ::kill(child, SIGKILL);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Runs a command beside an emulated rig: USB-1208FS-Plus, Uno with its firmware, projector behind the plugin "
      "wire.\n"
      "On stdin: unplug|plug lens|board|projector, lose-trigger, time, quit; each is answered with what\n"
      "is then to be seen, as JSON.");
  RoomSettings settings;
  settings.firmware_elf = settings.photodiodes.firmware_elf = FOCALSTAGE_FIRMWARE_ELF;
  std::vector<std::string> command;
  app.add_option("--socket", settings.optics.socket, "where the projector listens")->required();
  app.add_option("--board", settings.board_link, "link to the board's port")->required();
  app.add_option("--light-sensor", settings.photodiodes.board_link, "link to the port of a board with photodiodes");
  app.add_option("--report", settings.report, "file for what was lit: JSON lines")->required();
  app.add_option("--clock-ppm", settings.board_clock_ppm, "by which the board's clock is fast")->capture_default_str();
  app.add_option("--lens-lag-s", settings.lens.lag_s, "of the lenses")->capture_default_str();
  app.add_option("--width", settings.optics.width_px, "of the projector's pictures")->capture_default_str();
  app.add_option("--height", settings.optics.height_px, "of the projector's pictures")->capture_default_str();
  app.add_option("command", command, "what to run")->required();
  CLI11_PARSE(app, argc, argv);
  if (!settings.photodiodes.board_link.empty()) {
    settings.optics.regions = focalstage::rig_emulator::Photodiodes::regions(settings.photodiodes);
  }
  prefer_this_process(true);
  auto generator = focalstage::mcc1208_emulator::Emulator::create();
  if (!generator) return run_under_wrapper(argv);
  Room room(settings, std::move(generator));
  const pid_t child = start(command);
  run(room, child);
  return 0;
}
