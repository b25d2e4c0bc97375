#include <sys/wait.h>
#include <umockdev.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>

#include "tests/devices/lightcrafter/emulator/hidraw_host.h"

namespace {

/// A black video signal of 60 Hz and a look at what light comes of it, until the program ends.
int watch(focalstage::lightcrafter_emulator::Board& board, pid_t child) {
  using Clock = std::chrono::steady_clock;
  const std::vector<std::uint32_t> black(912 * 1140, 0);
  const auto begun = Clock::now();
  auto next = begun;
  std::uint64_t lights = 0;
  bool ran = false;
  int status = 0;
  board.video_frame(black, 0.0);
  while (::waitpid(child, &status, WNOHANG) == 0) {
    next += std::chrono::microseconds(16667);
    std::this_thread::sleep_until(next);
    board.vsync(std::chrono::duration<double>(Clock::now() - begun).count());
    lights += board.take_lights().size();
    if (board.running() != ran) {
      ran = !ran;
      std::fprintf(stderr, "the sequencer %s; %llu exposures so far\n", ran ? "runs" : "stopped",
                   static_cast<unsigned long long>(lights));
    }
  }
  std::fprintf(stderr, "%llu messages, %llu refused, %llu exposures\n",
               static_cast<unsigned long long>(board.messages()), static_cast<unsigned long long>(board.refusals()),
               static_cast<unsigned long long>(lights));
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace focalstage::lightcrafter_emulator;
  CLI::App app(
      "Runs a program beside an emulated LightCrafter 4500: umockdev-wrapper lightcrafter-emulator -- PROGRAM");
  Options options;
  Misbehaviour how;
  std::vector<std::string> program;
  bool lenient = false;
  std::uint16_t refuses = 0;
  app.add_flag("--lenient", lenient, "takes settings while it runs, and starts without a validation");
  app.add_flag("--start-twice", options.start_twice, "hears only the second start");
  app.add_option("--validation-polls", options.validation_polls, "that find it busy")->capture_default_str();
  app.add_option("--delay", how.delay_s, "seconds before each answer");
  app.add_flag("--silent", how.silent, "answers nothing");
  app.add_option("--refuse", refuses, "a command that it refuses, such as 0x1A24");
  app.add_flag("--wrong-sequence", how.wrong_sequence, "answers with other sequence numbers");
  app.add_flag("--short-read", how.short_read, "answers with three bytes");
  app.add_flag("--stale-first", how.stale_first, "an old answer before each right one");
  app.add_option("--hardware-bits", how.hardware_bits, "bits of the hardware status that differ from health");
  app.add_option("--validation-bits", how.validation_bits, "bits that a validation finds");
  app.add_flag("--validates-for-ever", how.validates_for_ever, "a validation never ends");
  app.add_flag("--never-runs", how.never_runs, "says yes to start and does not");
  std::size_t disconnect = 0;
  app.add_option("--disconnect-after", disconnect, "bytes after which it leaves the bus");
  app.add_option("program", program, "and its arguments")->required();
  CLI11_PARSE(app, argc, argv);
  options.strict = !lenient;
  if (refuses != 0) how.refuses = refuses;
  if (disconnect != 0) how.disconnect_after_bytes = disconnect;

  UMockdevTestbed* bed = umockdev_testbed_new();
  Board board(options);
  board.misbehave(how);
  int status = 1;
  {
    const auto host = HidrawHost::start(bed, board);
    std::fprintf(stderr, "a LightCrafter 4500 at %s\n", host->node().c_str());
    const pid_t child = ::fork();
    if (child == 0) {
      std::vector<char*> arguments;
      for (std::string& word : program) arguments.push_back(word.data());
      arguments.push_back(nullptr);
      ::execvp(arguments.front(), arguments.data());
      std::perror(arguments.front());
      ::_exit(127);
    }
    if (child > 0) status = watch(board, child);
  }
  g_object_unref(bed);
  return status;
}
