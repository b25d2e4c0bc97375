#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>

#include "tests/devices/mcc1208/emulator/emulator.h"
#include "tests/devices/mcc1208/emulator/real_time.h"

namespace {

namespace mcc = focalstage::mcc1208_emulator;

// What was put out since the last line.
struct Tally {
  std::atomic<std::uint64_t> scans = 0;
  std::atomic<std::uint64_t> edges = 0;
  std::atomic<int> least = std::numeric_limits<int>::max();
  std::atomic<int> most = -1;
  int sync = 0;

  void hear(const mcc::Output& output) {
    if (output.scan) ++scans;
    if (sync < 2048 && output.codes[1] >= 2048) ++edges;
    sync = output.codes[1];
    least = std::min(least.load(), output.codes[0]);
    most = std::max(most.load(), output.codes[0]);
  }

  void print(double device_s) {
    const int lowest = least.exchange(std::numeric_limits<int>::max());
    const int highest = most.exchange(-1);
    std::fprintf(stderr, "%.1f s: %llu scans, %llu edges", device_s, static_cast<unsigned long long>(scans.exchange(0)),
                 static_cast<unsigned long long>(edges.exchange(0)));
    if (highest >= 0) std::fprintf(stderr, ", channel 0 within %d to %d", lowest, highest);
    std::fputc('\n', stderr);
  }
};

// This program again, where umockdev can show the device to it and to its child.
int run_under_wrapper(char** argv) {
  std::vector<char*> words{const_cast<char*>("umockdev-wrapper")};
  for (; *argv != nullptr; ++argv) words.push_back(*argv);
  words.push_back(nullptr);
  ::execvp(words[0], words.data());
  std::perror("umockdev-wrapper");
  return 1;
}

int run_child(const std::vector<std::string>& command, mcc::Emulator& emulator, Tally& tally) {
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    ::execvp(words[0], words.data());
    std::perror(words[0]);
    ::_exit(127);
  }
  int status = 0;
  for (int tick = 1; ::waitpid(child, &status, WNOHANG) == 0; ++tick) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    if (tick % 10 == 0) tally.print(emulator.time_s());
  }
  tally.print(emulator.time_s());
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Runs a command to which a USB-1208FS-Plus is plugged in, and says each second what it puts out");
  mcc::Options options;
  mcc::Misbehaviour how;
  std::vector<std::string> command;
  std::uint64_t cut = 0;
  app.add_option("--serial", options.serial, "its serial number, 8 characters")->capture_default_str();
  app.add_option("--fifo", options.fifo_bytes, "bytes that it keeps")
      ->capture_default_str()
      ->check(CLI::Range(64, 1 << 20));
  app.add_option("--ppm", options.crystal_ppm, "by which its clock is fast")->capture_default_str();
  app.add_flag("--silent", how.silent, "answers nothing");
  app.add_flag("--starve", how.starve, "takes no samples, so that it runs dry");
  app.add_option("--stall", how.stalled, "requests that it refuses, by number");
  app.add_option("--status", how.status_bits, "bits set in each status");
  app.add_option("--delay", how.delay_s, "seconds before each answer");
  app.add_option("--cut-at-byte", cut, "unplugged after so many bytes of samples");
  app.add_option("command", command, "what to run")->required();
  CLI11_PARSE(app, argc, argv);
  if (cut > 0) how.cut_at_byte = cut;

  const auto emulator = mcc::Emulator::create(options);
  if (!emulator) return run_under_wrapper(argv);
  Tally tally;
  emulator->on_output([&tally](const mcc::Output& output) { tally.hear(output); });
  emulator->misbehave(how);
  emulator->plug_in();
  const mcc::RealTime real_time(*emulator);
  return run_child(command, *emulator, tally);
}
