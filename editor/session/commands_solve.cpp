#include <cmath>
#include <memory>
#include <utility>

#include "core/optics/image_plan.h"
#include "editor/session/command_list.h"
#include "editor/session/solve_offer.h"

namespace focalstage {
namespace {

constexpr const char* title = "Solve";

std::string needs_solvable(const Session& session) {
  if (std::string why = needs_project(session); !why.empty()) return why;
  if (session.project().projectors.empty()) return "the project has no projector";
  for (const Task& task : session.tasks()) {
    if (task.title == title) return "it is being solved already";
  }
  return {};
}

std::string needs_offer(const Session& session) {
  return session.solve_offer() ? "" : "there is no proposal; solve first";
}

std::string needs_edits(const Session& session) {
  const auto offer = session.solve_offer();
  if (!offer) return needs_offer(session);
  if (offer->solved() && offer->report.edits.empty()) return "nothing is to be changed";
  return offer->solved() || !offer->report.nearest.empty() ? "" : "there is nothing to apply";
}

Result<SolveWishes> wishes_of(const Value& args) {
  SolveWishes wishes;
  if (args.find("slices")) {
    const auto count = number_arg(args, "slices");
    if (!count) return count.fault();
    if (!(*count >= 1.0 && *count <= most_solved_slices)) {
      return Fault{"command.argument", "slices", "must be from 1 to " + std::to_string(most_solved_slices), ""};
    }
    wishes.slices = static_cast<int>(*count);
  }
  for (const auto& [key, wish] : {std::pair{"spacing_d", &wishes.spacing_d}, {"max_error_d", &wishes.max_error_d}}) {
    if (!args.find(key)) continue;
    const auto number = number_arg(args, key);
    if (!number) return number.fault();
    if (!(*number > 0.0)) return Fault{"command.argument", key, "must be above zero", ""};
    *wish = *number;
  }
  return wishes;
}

std::shared_ptr<const SolveOffer> offer_of(const Project& project, std::uint64_t revision, SolveReport report) {
  auto offer = std::make_shared<SolveOffer>();
  offer->revision = revision;
  offer->words = proposal_words(project, report.result);
  if (report.solved()) {
    if (const auto solved = apply_all(project, report.edits)) {
      offer->schedule = make_schedule(*solved, image_plan(*solved)).schedule;
    }
  } else {
    for (const Finding& finding : report.findings) offer->words.push_back(finding.message);
  }
  offer->report = std::move(report);
  return offer;
}

/// Puts the offer before the person, or says why there is none.
Jobs::Finish told(Session::State& state, std::uint64_t revision, Result<std::shared_ptr<const SolveOffer>> solved) {
  auto kept = std::make_shared<Result<std::shared_ptr<const SolveOffer>>>(std::move(solved));
  return [&state, revision, kept] {
    if (!*kept) {
      if (kept->fault().code != "solve.cancelled") state.say(LogLine::Kind::fault, describe(kept->fault()));
    } else if (state.revision() != revision) {
      state.say(LogLine::Kind::warning, "The project was edited while it was solved; solve it again");
    } else {
      state.solve_offer = **kept;
    }
  };
}

/// args: slices, spacing_d, max_error_d, as of `focalstage solve`
Status start(Session& session, const Value& args) {
  const auto wishes = wishes_of(args);
  if (!wishes) return wishes.fault();
  auto& state = SessionAccess::of(session);
  session.end_drag();
  state.solve_offer = nullptr;
  state.jobs.start(title, [&state, wishes = *wishes, project = state.document->history().now(),
                           assets = state.document->shelf().assets(), models = state.models,
                           revision = state.revision()](const Jobs::Progress& progress, std::stop_token stop) {
    auto report = solve_project(*project, assets, *models, wishes, progress, std::move(stop));
    if (!report) return told(state, revision, report.fault());
    return told(state, revision, offer_of(*project, revision, *std::move(report)));
  });
  return {};
}

/// args: nearest, which of the nearest settings where there is no proposal; none: the first
Status apply_offer(Session& session, const Value& args) {
  const auto offer = session.solve_offer();
  if (offer->solved()) return session.edit("Solve sweep and slices", offer->report.edits);
  const double index = number_or(args, "nearest", 0.0);
  const std::vector<NearestProposal>& nearest = offer->report.nearest;
  if (!(index >= 0.0 && index < static_cast<double>(nearest.size()))) {
    return Fault{"command.argument", "nearest", "there is no such setting", ""};
  }
  const NearestProposal& one = nearest[static_cast<std::size_t>(index)];
  return session.edit("Solve with " + one.words, one.edits);
}

Status discard(Session& session, const Value&) {
  SessionAccess::of(session).solve_offer = nullptr;
  return {};
}

}  // namespace

void add_solve_commands(CommandList& list) {
  const auto add = [&](Command command) { list.push_back(command); };
  add({"solve.start", "Solve sweep and slices", "Ctrl+L",
       "Find the smallest sweep and the slices that all frames need; nothing changes before it is applied", "gauge",
       true, needs_solvable, start});
  add({"solve.apply", "Apply the solution", "", "The proposed slices and sweep, as one step of undo", "apply", true,
       needs_edits, apply_offer});
  add({"solve.discard", "Discard the solution", "", "Leave slices and sweep as they are", "", true, needs_offer,
       discard});
}

}  // namespace focalstage
