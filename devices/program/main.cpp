#include <csignal>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <pthread.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include "devices/runtime/configured_rig.h"
#include "devices/runtime/tracker_setup.h"
#include "devices/service/logs.h"
#include "devices/service/service.h"
#include "io/files/user_folders.h"

namespace focalstage {
namespace {

enum ExitStatus { done = 0, wrong_usage = 2, invalid = 3, environment = 4 };

struct Flags {
  std::string config;
  std::string rig;
  std::string listen;
  std::string store;
  bool virtual_time = false;
  bool once = false;
  std::string tracker;
  std::string record;  ///< file that what the tracker says is written to
  std::vector<double> tracker_pose;
};

std::filesystem::path default_store() { return user_state_folder() / "store"; }

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

int report(const Fault& fault, int status) {
  std::fprintf(stderr, "focalstage-runtime: %s\n", describe(fault).c_str());
  return status;
}

int serve(const RigConfig& config, const RuntimeOptions& options) {
  const sigset_t signals = ending_signals();
  const Logs logs(config.log_level, config.log_json);
  const auto service = Service::start(config, options, ServiceManager::from_environment());
  if (!service) {
    const std::string& code = service.fault().code;
    return report(service.fault(),
                  code == "runtime.address" || code == "runtime.not-loopback" ? wrong_usage : environment);
  }
  // The one line on stdout: whoever started us reads the port from it.
  std::printf("listening on %s\n", (*service)->runtime().address().c_str());
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

/// The tracker that the command line names, where the file names no other.
Status take_tracker(const Flags& flags, RigConfig& config) {
  if (flags.tracker.empty()) {
    if (flags.record.empty() || config.devices.tracker) return {};
    return Fault{"rig.config", "--record-tracker", "there is no tracker to record",
                 "name one with --tracker, or in rig.json"};
  }
  Result<TrackerConfig> named = tracker_named(flags.tracker);
  if (!named) return named.fault();
  named->world_from_tracker = pose_of(flags.tracker_pose);
  if (config.devices.tracker && *config.devices.tracker != *named) {
    return Fault{"rig.config", flags.config + ": /devices/tracker",
                 "the command line names another tracker, --tracker " + flags.tracker, "leave one of them out"};
  }
  config.devices.tracker = std::move(*named);
  return {};
}

/// The file's word where there is one, and the flags' over it.
Result<RigConfig> configuration(const Flags& flags) {
  RigConfig config;
  if (!flags.config.empty()) {
    Result<RigConfig> read = load_rig_config(flags.config);
    if (!read) return read.fault();
    config = std::move(*read);
  }
  if (!flags.rig.empty()) config.kind = RigKind::sim;
  if (!flags.listen.empty()) config.listen = flags.listen;
  if (!flags.store.empty()) config.store = flags.store;
  if (config.store.empty()) config.store = default_store();
  return config;
}

void declare(CLI::App& app, Flags& flags) {
  app.add_option("--config", flags.config,
                 "the rig's configuration, rig.json (docs/formats/rig.md); flags go before it")
      ->type_name("FILE");
  app.add_option("--rig", flags.rig, "which rig, whatever the file says: sim, the simulated one")
      ->check(CLI::IsMember({"sim"}));
  app.add_option("--listen", flags.listen, "HOST:PORT, 127.0.0.1:50371 by default; port 0 picks a free one");
  app.add_option("--store", flags.store, "folder for the shows that are pushed");
  app.add_flag("--virtual-time", flags.virtual_time, "play as fast as the machine can, exactly the same each time");
  app.add_flag("--once", flags.once, "hold the last frame at the end of a show instead of starting again");
  auto* tracked = app.add_option("--tracker", flags.tracker, "natnet:HOST, natnet-unicast:HOST or recording:FILE");
  app.add_option("--record-tracker", flags.record, "writes what the tracker says to this file");
  app.add_option("--tracker-pose", flags.tracker_pose, "world from tracker, in metres: X Y Z QX QY QZ QW")
      ->expected(7)
      ->needs(tracked);
}

int run(int argc, char** argv) {
  CLI::App app{"Plays shows on a rig; editors reach it over gRPC (io/protocol/focalstage/v1/rig.proto).",
               "focalstage-runtime"};
  Flags flags;
  declare(app, flags);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int status = app.exit(error);
    return status == 0 ? done : wrong_usage;
  }
  Result<RigConfig> config = configuration(flags);
  if (!config) return report(config.fault(), invalid);
  if (Status tracker = take_tracker(flags, *config); !tracker) return report(tracker.fault(), wrong_usage);
  Result<RuntimeOptions> options = runtime_options(*config);
  if (!options) return report(options.fault(), flags.tracker.empty() ? invalid : wrong_usage);
  if (!flags.record.empty()) options->tracker.tracker = recorded(options->tracker.tracker, flags.record);
  options->rig.clock = flags.virtual_time ? RigClock::virtual_time : RigClock::real_time;
  options->rig.at_end = flags.once ? AtEnd::hold : AtEnd::loop;
  return serve(*config, *options);
}

}  // namespace
}  // namespace focalstage

int main(int argc, char** argv) { return focalstage::run(argc, argv); }
