#include <algorithm>
#include <memory>
#include <utility>

#include "editor/session/command_list.h"
#include "editor/session/export_views.h"
#include "io/assets/assets.h"

namespace focalstage {
namespace {

constexpr int stills_width_px = 1280, stills_height_px = 960;
constexpr int pull_frames = 90;

std::string needs_slices(const Session& session) {
  if (std::string why = needs_project(session); !why.empty()) return why;
  return session.slices() ? "" : "nothing is compiled yet";
}

ViewExport export_of(const Session::State& state, const Value& args, const char* folder) {
  const ViewState& view = state.view;
  return {state.document->history().now(), state.stage, eye_wish(view, {stills_width_px, stills_height_px}),
          text_or(args, "path", (state.document->folder() / folder).string())};
}

/// Says where the files are, or why there are none.
Jobs::Finish told(Session::State& state, Result<std::vector<std::filesystem::path>> written) {
  auto kept = std::make_shared<Result<std::vector<std::filesystem::path>>>(std::move(written));
  return [&state, kept] {
    if (!*kept) {
      state.say(LogLine::Kind::fault, describe(kept->fault()));
    } else {
      state.say(LogLine::Kind::good,
                std::to_string((*kept)->size()) + " files in " + (**kept)[0].parent_path().string());
    }
  };
}

/// args: path, a folder; none: export/ beside the project
Status stereo(Session& session, const Value& args) {
  auto& state = SessionAccess::of(session);
  state.jobs.start("Export stereo pictures",
                   [&state, wanted = export_of(state, args, "export")](const Jobs::Progress&, std::stop_token stop) {
                     return told(state, export_stereo(wanted, std::move(stop)));
                   });
  return {};
}

/// args: path; from_d, to_d; frames
Status focal_pull(Session& session, const Value& args) {
  auto& state = SessionAccess::of(session);
  const double from_d = number_or(args, "from_d", 0.5), to_d = number_or(args, "to_d", 3.0);
  const int frames = static_cast<int>(std::clamp(number_or(args, "frames", pull_frames), 1.0, 10000.0));
  state.jobs.start("Export a focal pull", [&state, wanted = export_of(state, args, "export"), from_d, to_d, frames](
                                              const Jobs::Progress& progress, std::stop_token stop) {
    const auto share = [&](double done) {
      progress(done,
               std::to_string(static_cast<int>(done * frames + 0.5)) + " of " + std::to_string(frames) + " pictures");
    };
    return told(state, export_focal_pull(wanted, from_d, to_d, frames, share, std::move(stop)));
  });
  return {};
}

/// Everything the project refers to lies in its folder already; this says so of what cannot be found.
Status collect(Session& session, const Value&) {
  auto& state = SessionAccess::of(session);
  const std::vector<Finding> missing = state.document->shelf().findings(state.project());
  if (!missing.empty()) return Fault{missing[0].code, missing[0].where, missing[0].message, "import it again"};
  const std::size_t files = asset_files(state.project()).size();
  state.say(LogLine::Kind::good,
            "All " + std::to_string(files) + " files travel in " + state.document->folder().string());
  return {};
}

}  // namespace

void add_export_commands(CommandList& list) {
  const auto add = [&](Command command) { list.push_back(command); };
  add({"file.collect", "Collect files", "", "Check that all files of the project travel with it", "collect", true,
       needs_project, collect});
  add({"export.stereo", "Export stereo pictures", "", "What both eyes see, as PNG: each, side by side, red-cyan",
       "export", true, needs_slices, stereo});
  add({"export.focal-pull", "Export a focal pull", "", "Pictures of the eye's focus going from far to near and back",
       "movie", true, needs_slices, focal_pull});
}

}  // namespace focalstage
