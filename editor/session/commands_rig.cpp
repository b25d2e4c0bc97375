#include <memory>
#include <utility>

#include "core/check/rig_differences.h"
#include "editor/pipeline/compile_show.h"
#include "editor/session/command_list.h"
#include "io/project/project_file.h"
#include "io/protocol/adopt.h"
#include "io/protocol/client.h"

namespace focalstage {
namespace {

using Phase = RigStatus::Phase;

std::string needs_rig(const Session& session) {
  return session.rig().status().phase == Phase::connected ? "" : "connect to a rig first";
}
std::string needs_rig_and_project(const Session& session) {
  if (std::string why = needs_project(session); !why.empty()) return why;
  return needs_rig(session);
}
std::string needs_idle_rig(const Session& session) {
  if (std::string why = needs_rig_and_project(session); !why.empty()) return why;
  return session.rig().status().pushing ? "a push is under way" : "";
}
std::string needs_push(const Session& session) {
  return session.rig().status().pushing ? "" : "nothing is being pushed";
}
std::string needs_link(const Session& session) {
  return session.rig().status().phase == Phase::none ? "no rig is connected" : "";
}

RigLink& link(Session& session) { return SessionAccess::of(session).rig; }

/// args: address, HOST:PORT
Status connect(Session& session, const Value& args) {
  link(session).connect(text_or(args, "address", default_rig_address));
  return {};
}

Status simulate(Session& session, const Value&) {
  link(session).simulate();
  return {};
}

Status disconnect(Session& session, const Value&) {
  link(session).disconnect();
  return {};
}

/// The show of the project as it is at this moment, compiled from a copy: edits may go on meanwhile.
MakeShow show_of(const Session::State& state) {
  const auto project = state.document->history().now();
  const auto folder = state.document->folder();
  const auto target = state.folders.state / "push";
  return [project, folder, target, models = state.models](const std::function<void(double)>& progress,
                                                          std::stop_token stop) -> Result<std::filesystem::path> {
    auto loaded = load_assets(*project, folder);
    if (!loaded) return loaded.fault();
    std::error_code problem;
    std::filesystem::create_directories(target, problem);
    if (problem) return Fault{"file.unwritable", target.string(), problem.message(), "free some space"};
    const Source source{*project, project_text(*project), std::move(*loaded), {}, *models};
    CompileJob job;
    job.show = target / "show.h5";
    const auto report = compile_show(
        source, job, [&](int done, int of) { progress(static_cast<double>(done) / of); }, std::move(stop));
    if (!report) return report.fault();
    return job.show;
  };
}

Status push(Session& session, const Value&) {
  link(session).push(show_of(SessionAccess::of(session)));
  return {};
}

Status cancel_push(Session& session, const Value&) {
  link(session).cancel_push();
  return {};
}

Status play(Session& session, const Value&) {
  link(session).play();
  return {};
}

Status hold(Session& session, const Value&) {
  link(session).hold();
  return {};
}

Status go(Session& session, const Value&) {
  link(session).go();
  return {};
}

Status blackout(Session& session, const Value&) {
  link(session).blackout();
  return {};
}

/// args: on
Status live(Session& session, const Value& args) {
  const bool on = flag_or(args, "on", !session.rig().status().live_wanted);
  link(session).live(on);
  return {};
}

Status adopt_rig(Session& session, const Value&) {
  const std::vector<Edit> edits = adopt(session.project(), session.rig().status().description);
  if (edits.empty()) {
    SessionAccess::of(session).say(LogLine::Kind::good, "The project is made for this rig already");
    return {};
  }
  return session.edit("Adopt the rig", edits);
}

}  // namespace

void add_rig_commands(CommandList& list) {
  const auto add = [&](Command command) { list.push_back(command); };
  add({"rig.simulate", "Start a simulated rig", "", "A rig on this machine that does what a real one would", "rig",
       true, always, simulate});
  add({"rig.connect", "Connect to a rig", "", "At HOST:PORT", "rig", true, always, connect});
  add({"rig.disconnect", "Disconnect", "", "What plays goes on", "", true, needs_link, disconnect});
  add({"rig.push", "Push", "Ctrl+Shift+P", "Compile the show, send it and make it the rig's", "push", true,
       needs_idle_rig, push});
  add({"rig.cancel-push", "Cancel the push", "", "What arrived stays for the next one", "", true, needs_push,
       cancel_push});
  add({"rig.play", "Play on the rig", "F6", "The rig shows its show", "play", true, needs_rig, play});
  add({"rig.hold", "Hold", "F7", "The rig stays at this frame", "pause", true, needs_rig, hold});
  add({"rig.live", "Live", "F8", "Edits go to the rig as they are made", "live", true, needs_rig_and_project, live});
  add({"rig.adopt", "Adopt the rig", "", "Make the project for what the rig measured of itself", "", true,
       needs_rig_and_project, adopt_rig});
  add({"rig.go", "Go", "", "Light again after darkness", "", true, needs_rig, go});
  add({"rig.blackout", "Blackout", "F12", "Dark at once, and dark until Go", "blackout", true, always, blackout});
}

}  // namespace focalstage
