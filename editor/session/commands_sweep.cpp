#include <memory>
#include <utility>

#include "core/base/number_words.h"
#include "core/schedule/shape_words.h"
#include "core/schedule/sweep_shape.h"
#include "editor/session/command_list.h"

namespace focalstage {
namespace {

std::string needs_shapeable(const Session& session) {
  if (std::string why = needs_project(session); !why.empty()) return why;
  const Project& project = session.project();
  if (project.projectors.empty()) return "add a projector first";
  return project.slices.powers_d.empty() ? "add a slice first" : "";
}

std::string smear_text(double smear_d) { return fixed_text(smear_d, smear_d < 0.01 ? 4 : 3) + " D"; }

std::string bounds_text(const SweepShape& shape) {
  std::string text;
  for (const ShapeBound& bound : shape.bounds) text += (text.empty() ? "" : "; ") + describe(bound);
  return text;
}

/// Puts the shape into the project it was found for, as one step; says what it is worth, or why there is none.
void take_shape(Session& session, const Project& asked, const Result<SweepShape>& shape) {
  auto& state = SessionAccess::of(session);
  if (!shape) return state.say(LogLine::Kind::fault, describe(shape.fault()));
  if (!session.has_document() || session.project() != asked) {
    return state.say(LogLine::Kind::fault, "The project changed while its sweep was shaped; shape it again");
  }
  if (!shape->better) {
    return state.say(LogLine::Kind::fault, "Nothing better than the sine: " + bounds_text(*shape));
  }
  const Status edited =
      session.edit("Shape the sweep", {{Edit::Kind::set, "sweep", "", "waveform", waveform_value(shape->waveform)}});
  if (!edited) return state.say(LogLine::Kind::fault, describe(edited.fault()));
  state.say(LogLine::Kind::good, "The slices smear by " + smear_text(worst_smear_d(shape->shaped)) +
                                     " at most, on the sine by " + smear_text(worst_smear_d(shape->sine)) + " (" +
                                     bounds_text(*shape) + ")");
}

/// args: max_harmonic; none: as many as were measured. Found behind the window, then one step.
Status shape(Session& session, const Value& args) {
  ShapeOptions options;
  if (args.find("max_harmonic")) {
    const auto highest = number_arg(args, "max_harmonic");
    if (!highest) return highest.fault();
    if (!(*highest >= 1.0 && *highest <= most_shaped_harmonics)) {
      return Fault{"command.argument", "max_harmonic", "is not from 1 to " + std::to_string(most_shaped_harmonics), ""};
    }
    options.max_harmonic = static_cast<int>(*highest);
  }
  SessionAccess::of(session).jobs.start(
      "Shape the sweep",
      [&session, project = session.project(), options](const Jobs::Progress&, std::stop_token) -> Jobs::Finish {
        auto found = std::make_shared<Result<SweepShape>>(shape_sweep(project, image_plan(project), options));
        return [&session, project, found] { take_shape(session, project, *found); };
      });
  return {};
}

}  // namespace

void add_sweep_commands(CommandList& list) {
  list.push_back({"sweep.shape", "Shape the sweep", "",
                  "Let the lenses dwell at the slices, within what was measured of them", "lens", true, needs_shapeable,
                  shape});
}

}  // namespace focalstage
