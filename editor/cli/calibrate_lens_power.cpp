#include <cstdio>

#include "core/base/number_words.h"
#include "editor/cli/output.h"
#include "editor/cli/viewer_sitting.h"
#include "editor/viewer/focus_chart.h"

namespace focalstage {
namespace {

void print_check(const ViewerOptions& options, const LensPowerCheck& check, const EqualityEstimate& found) {
  if (options.json) {
    print_json(Value::Object{{"eye", options.eye},
                             {"power_d", check.asked_d},
                             {"error_d", check.error_d},
                             {"uncertainty_d", check.uncertainty_d},
                             {"answers_uncertainty_d", check.answers_d},
                             {"focus_uncertainty_d", check.focus_d},
                             {"spread_d", found.spread},
                             {"answers", found.answers},
                             {"observer", observer_kind(options)},
                             {"differs", check.differs}});
    return;
  }
  std::printf(
      "%s lens, asked for %.2f D: true less asked %+.2f D, uncertain by %.2f D (one standard deviation: %.2f of "
      "%d answers%s, %.2f of the eye's focus)\n",
      options.eye.c_str(), check.asked_d, check.error_d, check.uncertainty_d, check.answers_d, found.answers,
      options.scripted ? " of a script" : "", check.focus_d);
  std::printf("%s\n", check.differs
                          ? "The lens has not the power it is asked for: measure it (focalstage rig self-test), "
                            "or see that the eye's focus is known."
                          : "That says nothing against the lens.");
}

ViewerSitting::Guide guide(const FocusCharts& charts) {
  const std::string focus = fixed_text(1.0 / charts.focus_d, 2) + " m (" + fixed_text(charts.focus_d, 2) + " D)";
  return {std::string("Close the ") + eye_word(other_eye(charts.eye)) + " eye. The other one must be focused " + focus +
          " before its lens and stay so: an eye that does not accommodate, or a camera in its place.\n"
          "Two charts of fine lines: press the up arrow (or u) where the upper one is sharper, the down arrow (or d) "
          "where the lower one is."};
}

Result<ExitStatus> measure(const ViewerOptions& options, ViewerSitting& sitting) {
  const auto charts = focus_charts(sitting.source(), sitting.eye(), options.focus_m);
  if (!charts) return charts.fault();
  const auto test = sitting.make("Making the charts", [&](const FrameProgress& progress) {
    return chart_test(*charts, sitting.folder(), progress, sitting.stop());
  });
  if (!test) return test.fault();
  const auto seen = [&](std::size_t level) -> Result<double> {
    const auto reader = ShowReader::open(test->shows[test->stimuli[level].show].show);
    if (!reader) return reader.fault();
    return seen_chart_difference(*reader, eye_at_charts(*charts, *options.scripted));
  };
  const auto found = sitting.ask(*test, guide(*charts), seen);
  if (!found) return found.fault();
  if (!found->inside && !options.despite_uncertainty) {
    return Fault{
        "viewer.outside", "lens-power",
        "the answers close in on no power within " + fixed_text(test->levels.back(), 2) + " D of the asked one",
        "see that the eye is focused where --focus-m says; if it is, the lens is off by more"};
  }
  const LensPowerCheck check = lens_power_check(*charts, *found, options.focus_uncertainty_d);
  print_check(options, check, *found);
  return check.differs ? ExitStatus::findings : ExitStatus::done;
}

}  // namespace

ExitStatus run_calibrate_lens_power(const ViewerOptions& options) {
  return run_sitting(options, [&](ViewerSitting& sitting) { return measure(options, sitting); });
}

}  // namespace focalstage
