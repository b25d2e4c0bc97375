#include <CLI/CLI.hpp>
#include <memory>
#include <utility>

#include "editor/cli/calibrate_actions.h"
#include "editor/cli/command_calibrate_viewer.h"
#include "editor/cli/command_list.h"

namespace focalstage {
namespace {

using Action = ExitStatus (*)(const CalibrateOptions&);

void add_project(CLI::App& app, CalibrateOptions& options) {
  app.add_option("PROJECT", options.project, "a NAME.focal, or the folder that holds it")->required()->type_name("");
  app.add_option("--projector", options.projector, "which one, where the project has several")->type_name("NAME");
}

/// What every result is asked for before it becomes part of a project.
void add_result(CLI::App& app, CalibrateOptions& options) {
  app.add_option("-o,--output", options.output, "where to save; the project itself by default")->type_name("OUT");
  app.add_option("--limit-px", options.limit_px, "refuse where half of the residuals are longer, or 5 % three times so")
      ->check(CLI::PositiveNumber.name(""))
      ->type_name("PX")
      ->capture_default_str();
  app.add_flag("--despite-residual", options.despite_residual, "apply it all the same");
  app.add_option("--picture", options.picture, "draw where points are and how far off, in the projector's picture")
      ->type_name("PNG");
  app.add_flag("--dry-run", options.dry_run, "save nothing");
  app.add_flag("--json", options.json, "one JSON object instead of words");
}

void declare_points(CLI::App& app, CalibrateOptions& options) {
  app.add_option("FILE", options.input, "places in the room and the pixels that light them")
      ->required()
      ->type_name("POINTS.json");
  add_project(app, options);
  app.add_option("--solve", options.solve, "pose alone, the focal length too, or the centre too")
      ->check(CLI::IsMember({"pose", "focal", "centre"}).name(""))
      ->type_name("pose|focal|centre")
      ->capture_default_str();
  add_result(app, options);
}

void declare_patterns(CLI::App& app, CalibrateOptions& options) {
  add_project(app, options);
  app.add_option("-o,--output", options.output, "the folder to write into")->required()->type_name("DIR");
  app.add_option("--stripe-px", options.stripe_px, "the narrowest stripes; wider ones for a camera out of focus")
      ->check(CLI::Range(1, 64).name(""))
      ->type_name("PX")
      ->capture_default_str();
  app.add_option("--period-px", options.period_px, "of the sine; four stripes at least")
      ->check(CLI::Range(4, 1024).name(""))
      ->type_name("PX")
      ->capture_default_str();
  app.add_option("--steps", options.steps, "of the sine; more bear more noise")
      ->check(CLI::Range(4, 32).name(""))
      ->type_name("N")
      ->capture_default_str();
}

void declare_scan(CLI::App& app, CalibrateOptions& options) {
  app.add_option("DIR", options.input, "the folder of captures, with patterns.json and scan.json")
      ->required()
      ->type_name("");
  add_project(app, options);
  app.add_option("--mesh", options.mesh, "write the scanned surface")->type_name("OUT.ply");
  add_result(app, options);
}

void declare_verify(CLI::App& app, CalibrateOptions& options) {
  add_project(app, options);
  app.add_option("-o,--output", options.output, "the picture to project")->required()->type_name("PNG");
}

}  // namespace

Command::Run declare_calibrate(CLI::App& app) {
  const auto options = std::make_shared<CalibrateOptions>();
  const auto chosen = std::make_shared<Command::Run>();
  const auto add = [&](const char* name, const char* help, Action run) {
    CLI::App* below = app.add_subcommand(name, help);
    below->callback([options, chosen, run] { *chosen = [options, run] { return run(*options); }; });
    return below;
  };
  declare_points(*add("points", "Pose, and lens if asked, from picked points.", run_calibrate_points), *options);
  declare_patterns(*add("patterns", "Write the patterns for a camera to see, and a board.", run_calibrate_patterns),
                   *options);
  declare_scan(*add("scan", "Lens, pose and surface, from camera pictures of the patterns.", run_calibrate_scan),
               *options);
  declare_verify(*add("verify", "Draw the model's edges as the projector must show them.", run_calibrate_verify),
                 *options);
  declare_calibrate_viewer(app, [chosen](Command::Run run) { *chosen = std::move(run); });
  app.require_subcommand(1);
  app.footer("docs/calibration.md says how points are picked and what is refused.");
  return [chosen] { return (*chosen)(); };
}

}  // namespace focalstage
