#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <pthread.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

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
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int status = app.exit(error);
    return status == 0 ? done : wrong_usage;
  }
  options.store = store;
  options.rig.clock = virtual_time ? RigClock::virtual_time : RigClock::real_time;
  options.rig.at_end = once ? AtEnd::hold : AtEnd::loop;
  spdlog::set_default_logger(spdlog::stderr_logger_mt("runtime"));
  return serve(options);
}

}  // namespace
}  // namespace focalstage

int main(int argc, char** argv) { return focalstage::run(argc, argv); }
