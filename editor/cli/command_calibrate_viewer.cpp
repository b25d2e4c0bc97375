#include "editor/cli/command_calibrate_viewer.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "editor/cli/rig_link.h"
#include "editor/cli/viewer_actions.h"

namespace focalstage {
namespace {

void add_sitting(CLI::App& app, ViewerOptions& options) {
  app.add_option("PROJECT", options.project, "a NAME.focal, or the folder that holds it")->required()->type_name("");
  add_rig_option(app, options.rig);
  app.add_option("--questions", options.questions, "how many are asked")
      ->check(CLI::Range(5, 500).name(""))
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--answers", options.answers, "keep answers there, and go on after those that are there")
      ->type_name("FILE");
  app.add_option("--seed", options.seed, "of a simulated eye's noise")->type_name("N")->capture_default_str();
  app.add_flag("--json", options.json, "one JSON object instead of words");
}

void add_eye(CLI::App& app, ViewerOptions& options) {
  app.add_option("--eye", options.eye, "which one looks")
      ->check(CLI::IsMember({"left", "right"}).name(""))
      ->type_name("left|right")
      ->capture_default_str();
}

void add_result(CLI::App& app, ViewerOptions& options) {
  app.add_option("--limit-mm", options.limit_mm, "refuse what is more uncertain than this")
      ->check(CLI::PositiveNumber.name(""))
      ->type_name("MM")
      ->capture_default_str();
  app.add_flag("--despite-uncertainty", options.despite_uncertainty, "take it all the same");
  app.add_option("-o,--output", options.output, "where to save; the project itself by default")->type_name("OUT");
  app.add_flag("--dry-run", options.dry_run, "save nothing");
}

void add_script(CLI::App& app, ViewerOptions& options, const char* what, double least, double most, const char* unit,
                const char* noise, double usual_noise, const char* noise_unit) {
  app.add_option("--scripted", options.scripted, what)->check(CLI::Range(least, most).name(""))->type_name(unit);
  options.scripted_noise = usual_noise;
  app.add_option("--scripted-noise", options.scripted_noise, noise)
      ->check(CLI::NonNegativeNumber.name(""))
      ->type_name(noise_unit)
      ->capture_default_str();
}

void declare_lens_to_pupil(CLI::App& app, ViewerOptions& options) {
  add_sitting(app, options);
  add_eye(app, options);
  add_result(app, options);
  add_script(app, options, "no person: an eye whose lens stands so far away", 5.0, 40.0, "MM",
             "of that eye, as a share of the rings' size", 0.003, "SHARE");
}

void declare_lens_power(CLI::App& app, ViewerOptions& options) {
  add_sitting(app, options);
  add_eye(app, options);
  app.add_option("--focus-m", options.focus_m, "how far before its lens the eye is focused, without accommodating")
      ->check(CLI::Range(0.05, 1000.0).name(""))
      ->required()
      ->type_name("M");
  app.add_option("--focus-uncertainty-d", options.focus_uncertainty_d, "how well that is known, one standard deviation")
      ->check(CLI::NonNegativeNumber.name(""))
      ->type_name("D")
      ->capture_default_str();
  app.add_flag("--despite-uncertainty", options.despite_uncertainty,
               "say it even where the answers close in on nothing");
  add_script(app, options, "no person: an eye behind a lens that is off by so much", -1.0, 1.0, "D",
             "of that eye, as a share of contrast", 0.1, "SHARE");
}

void declare_interpupillary(CLI::App& app, ViewerOptions& options) {
  add_sitting(app, options);
  app.add_option("--thread-m", options.thread_m,
                 "how far before the pupils a thread hangs, straight before their middle")
      ->check(CLI::Range(0.05, 10.0).name(""))
      ->required()
      ->type_name("M");
  app.add_option("--thread-uncertainty-mm", options.thread_uncertainty_mm,
                 "how well that is known, one standard deviation")
      ->check(CLI::NonNegativeNumber.name(""))
      ->type_name("MM")
      ->capture_default_str();
  add_result(app, options);
  add_script(app, options, "no person: eyes so far apart", 40.0, 84.0, "MM", "of those eyes, in radians", 0.0003,
             "RAD");
}

void declare_tracker_offset(CLI::App& app, TrackerOffsetOptions& options) {
  app.add_option("FILE", options.sightings, "spots seen right behind a mark, and where the glasses' body was")
      ->required()
      ->type_name("SIGHTINGS.csv");
  app.add_option("--tracker-pose", options.tracker_pose, "where the tracker stands, as track-align prints it")
      ->expected(7)
      ->type_name("X Y Z QX QY QZ QW");
  app.add_option("--body-rotation", options.body_rotation, "how the viewer is turned in the body, as far as is known")
      ->expected(4)
      ->type_name("QX QY QZ QW");
  app.add_option("--limit-mm", options.limit_mm, "refuse where sightings pass the eyes farther than so")
      ->check(CLI::PositiveNumber.name(""))
      ->type_name("MM")
      ->capture_default_str();
  app.add_flag("--despite-residual", options.despite_residual, "take it all the same");
  app.add_flag("--json", options.json, "one JSON object instead of words");
}

}  // namespace

void declare_calibrate_viewer(CLI::App& calibrate, const std::function<void(Command::Run)>& choose) {
  CLI::App* viewer = calibrate.add_subcommand("viewer", "What belongs to who wears the glasses, by small tests.");
  const auto add = [&](const char* name, const char* help, void (*declare)(CLI::App&, ViewerOptions&),
                       ExitStatus (*run)(const ViewerOptions&)) {
    const auto options = std::make_shared<ViewerOptions>();
    CLI::App* action = viewer->add_subcommand(name, help);
    declare(*action, *options);
    action->callback([choose, options, run] { choose([options, run] { return run(*options); }); });
  };
  add("lens-to-pupil", "How far the lens stands from the pupil, by two half rings.", declare_lens_to_pupil,
      run_calibrate_lens_to_pupil);
  add("lens-power", "Whether the lens has the power it is asked for, by two charts of fine lines.", declare_lens_power,
      run_calibrate_lens_power);
  add("interpupillary", "How far the pupils are apart, by lines behind a thread.", declare_interpupillary,
      run_calibrate_interpupillary);
  const auto options = std::make_shared<TrackerOffsetOptions>();
  CLI::App* offset = viewer->add_subcommand("tracker-offset", "Where the eyes are in the axes of the tracked glasses.");
  declare_tracker_offset(*offset, *options);
  offset->callback([choose, options] { choose([options] { return run_calibrate_tracker_offset(*options); }); });
  viewer->require_subcommand(1);
  viewer->footer("docs/viewer-calibration.md says what to prepare and what the values are worth.");
}

}  // namespace focalstage
