#include <CLI/CLI.hpp>
#include <chrono>
#include <memory>

#include "editor/cli/command_list.h"
#include "editor/cli/interrupt.h"
#include "editor/cli/output.h"
#include "editor/cli/progress.h"
#include "editor/cli/rig_link.h"
#include "editor/cli/self_test_output.h"

namespace focalstage {
namespace {

struct Options {
  std::string action;
  std::string cue;
  std::string rig;
  std::uint64_t sweeps = 0;
  double seconds = 0.0;
  double frequency_hz = 0.0;
  int harmonics = 0;
  bool dry_run = false;
  bool json = false;
};

/// A line a second until told to stop.
Status watch(RigClient& rig, double seconds) {
  using Clock = std::chrono::steady_clock;
  const auto started = Clock::now();
  return rig.watch(std::chrono::seconds(1), [&](const RigState& state) {
    std::printf("%s", state_line(state).c_str());
    std::fflush(stdout);
    return seconds <= 0.0 || std::chrono::duration<double>(Clock::now() - started).count() < seconds;
  });
}

/// Does what was asked; "state" is only the look at it that follows every action.
Status act(RigClient& rig, const Options& options) {
  if (options.action == "play") return rig.play(options.sweeps);
  if (options.action == "hold") return rig.hold();
  if (options.action == "blackout") return rig.blackout();
  if (options.action == "go") return rig.go();
  if (options.action == "cue") return rig.cue(options.cue);
  if (options.action == "next") return rig.next();
  if (options.action == "back") return rig.back();
  if (options.action == "watch") return watch(rig, options.seconds);
  return {};
}

/// The rig measures itself: a table, or one object, and nothing where it could not.
ExitStatus self_test(const Options& options) {
  Interrupt interrupt;
  const auto measured = [&]() -> Result<RigMeasurement> {
    auto rig = connect_to_rig(options.rig);
    if (!rig) return rig.fault();
    Progress bar("Measuring " + options.rig, Progress::Style::automatic);
    const auto seen = [&](const std::string&, double share) { bar.update(share, 1.0, ""); };
    return rig->self_test({options.frequency_hz, options.harmonics, options.dry_run}, seen, interrupt.token());
  }();
  if (!measured) {
    const ExitStatus status = report(measured.fault());
    interrupt.end_if_asked();
    return status;
  }
  if (options.json) {
    print_json(value_of(*measured));
    return ExitStatus::done;
  }
  std::printf("%s\n%s\n", measurement_table(*measured).c_str(),
              options.dry_run ? "a dry run: the rig says of itself what it said before"
                              : "the rig says so of itself from now on; focalstage adopt-rig PROJECT takes it over");
  return ExitStatus::done;
}

ExitStatus run(const Options& options) {
  if ((options.action == "cue") == options.cue.empty()) {
    std::fprintf(stderr, "focalstage rig: %s; see focalstage rig --help\n",
                 options.cue.empty() ? "cue needs the NAME of a cue" : "only cue takes a NAME");
    return ExitStatus::usage;
  }
  if (options.action == "self-test") return self_test(options);
  auto rig = connect_to_rig(options.rig);
  if (!rig) return report(rig.fault());
  if (const Status acted = act(*rig, options); !acted) return report(acted.fault());
  const auto state = rig->state();
  if (!state) return report(state.fault());
  if (options.json) {
    print_json(value_of(*state));
  } else {
    std::fputs(state_text(*state).c_str(), stdout);
  }
  return ExitStatus::done;
}

}  // namespace

Command::Run declare_rig(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option(
         "ACTION", options->action,
         "state, play, hold, blackout, go (lifts a blackout or fault), cue, next, back, watch, self-test (measures "
         "itself through its light sensor)")
      ->required()
      ->type_name("")
      ->check(CLI::IsMember({"state", "play", "hold", "blackout", "go", "cue", "next", "back", "watch", "self-test"})
                  .name(""));
  app.add_option("NAME", options->cue, "the cue to jump to")->type_name("");
  add_rig_option(app, options->rig);
  app.add_option("--sweeps", options->sweeps, "play: this many, then hold; on and on by default")->type_name("N");
  app.add_option("--seconds", options->seconds, "watch: this long; until Ctrl-C by default")->type_name("S");
  app.add_option("--frequency", options->frequency_hz, "self-test: of the sweep, 44 to 125; 60 by default")
      ->type_name("HZ");
  app.add_option("--harmonics", options->harmonics, "self-test: of the lenses, 1 to 24; 4 by default")->type_name("N");
  app.add_flag("--dry-run", options->dry_run, "self-test: tell what was found, and let the rig keep nothing");
  app.add_flag("--json", options->json, "print the state, or what was measured, as one JSON object");
  return [options] { return run(*options); };
}

}  // namespace focalstage
