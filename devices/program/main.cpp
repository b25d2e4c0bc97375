#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <pthread.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include "devices/runtime/make_tracker.h"
#include "devices/runtime/runtime.h"

namespace focalstage {
namespace {

enum ExitStatus { done = 0, wrong_usage = 2, environment = 4 };

std::filesystem::path default_store() {
  if (const char* state = std::getenv("XDG_STATE_HOME"); state != nullptr && *state == '/') {
    return std::filesystem::path(state) / "focalstage" / "store";
  }
  const char* home = std::getenv("HOME");
  const std::filesystem::path base = home != nullptr && *home == '/' ? home : "/var/tmp";
  return base / ".local" / "state" / "focalstage" / "store";
}

/// Blocked in every thread, so that one place waits for them.
sigset_t ending_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGHUP);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  return signals;
}

int serve(const RuntimeOptions& options) {
  const sigset_t signals = ending_signals();
  const Result<Runtime> runtime = Runtime::start(options);
  if (!runtime) {
    std::fprintf(stderr, "focalstage-runtime: %s\n", describe(runtime.fault()).c_str());
    return runtime.fault().code == "runtime.address" || runtime.fault().code == "runtime.not-loopback" ? wrong_usage
                                                                                                       : environment;
  }
  // The one line on stdout: whoever started us reads the port from it.
  std::printf("listening on %s\n", runtime->address().c_str());
  std::fflush(stdout);
  int signal = 0;
  sigwait(&signals, &signal);
  spdlog::info("signal {}: going dark and leaving", signal);
  return done;
}

/// Where the tracker stands, from X Y Z QX QY QZ QW.
Rigid pose_of(const std::vector<double>& numbers) {
  if (numbers.empty()) return {};
  const glm::dquat turn(numbers[6], numbers[3], numbers[4], numbers[5]);
  return {{numbers[0], numbers[1], numbers[2]}, glm::normalize(turn)};
}

/// What the words on the command line make of a tracker.
Result<TrackerSetup> tracker_setup(const std::string& name, const std::string& record,
                                   const std::vector<double>& pose) {
  TrackerSetup setup;
  if (name.empty()) return setup;
  Result<std::shared_ptr<Tracker>> tracker = make_tracker(name);
  if (!tracker) return tracker.fault();
  setup.tracker = record.empty() ? *tracker : recorded(*tracker, record);
  setup.world_from_tracker = pose_of(pose);
  return setup;
}

int run(int argc, char** argv) {
  CLI::App app{"Plays shows on a rig; editors reach it over gRPC (io/protocol/focalstage/v1/rig.proto).",
               "focalstage-runtime"};
  RuntimeOptions options;
  std::string rig = "sim";
  std::string store = default_store().string();
  bool virtual_time = false;
  bool once = false;
  app.add_option("--rig", rig, "which rig: sim, the simulated one")
      ->check(CLI::IsMember({"sim"}))
      ->capture_default_str();
  app.add_option("--listen", options.listen, "HOST:PORT on this machine; port 0 picks a free one")
      ->capture_default_str();
  app.add_option("--store", store, "folder for the shows that are pushed")->capture_default_str();
  app.add_flag("--virtual-time", virtual_time, "play as fast as the machine can, exactly the same each time");
  app.add_flag("--once", once, "hold the last frame at the end of a show instead of starting again");
  std::string tracker;
  std::string record;
  std::vector<double> tracker_pose;
  auto* tracked = app.add_option("--tracker", tracker, "natnet:HOST, natnet-unicast:HOST or recording:FILE");
  app.add_option("--record-tracker", record, "writes what the tracker says to this file")->needs(tracked);
  app.add_option("--tracker-pose", tracker_pose, "world from tracker, in metres: X Y Z QX QY QZ QW")
      ->expected(7)
      ->needs(tracked);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int status = app.exit(error);
    return status == 0 ? done : wrong_usage;
  }
  Result<TrackerSetup> setup = tracker_setup(tracker, record, tracker_pose);
  if (!setup) {
    std::fprintf(stderr, "focalstage-runtime: %s\n", describe(setup.fault()).c_str());
    return wrong_usage;
  }
  options.tracker = std::move(*setup);
  options.store = store;
  options.rig.clock = virtual_time ? RigClock::virtual_time : RigClock::real_time;
  options.rig.at_end = once ? AtEnd::hold : AtEnd::loop;
  spdlog::set_default_logger(spdlog::stderr_logger_mt("runtime"));
  return serve(options);
}

}  // namespace
}  // namespace focalstage

int main(int argc, char** argv) { return focalstage::run(argc, argv); }
