#include <cmath>
#include <cstdio>

#include "core/base/number_words.h"
#include "editor/cli/output.h"
#include "editor/cli/viewer_sitting.h"
#include "editor/viewer/thread_sights.h"
#include "io/json/json.h"

namespace focalstage {
namespace {

void print_found(const ViewerOptions& options, const InterpupillaryDistance& found, int answers, const Edit& edit,
                 double before_mm) {
  if (options.json) {
    print_json(Value::Object{{"interpupillary_mm", found.mm},
                             {"uncertainty_mm", found.uncertainty_mm},
                             {"answers_uncertainty_mm", found.answers_mm},
                             {"thread_uncertainty_mm", found.thread_mm},
                             {"middle_mm", found.middle_mm},
                             {"answers", answers},
                             {"observer", observer_kind(options)},
                             {"edits", Value::Array{value_from(edit)}},
                             {"applied", !options.dry_run}});
    return;
  }
  std::printf(
      "interpupillary distance: %.2f mm, uncertain by %.2f mm (one standard deviation: %.2f of %d answers%s, "
      "%.2f of the thread's distance); it was %.2f mm\n",
      found.mm, found.uncertainty_mm, found.answers_mm, answers, options.scripted ? " of a script" : "",
      found.thread_mm, before_mm);
  std::printf("the middle of the eyes stands %.1f mm %s of the thread\n", std::abs(found.middle_mm),
              found.middle_mm < 0.0 ? "left" : "right");
  std::printf("%s\n", write_json(value_from(edit), -1).c_str());
}

ViewerSitting::Guide guide(Side eye, double thread_m) {
  return {std::string("Keep the head still and close the ") + eye_word(other_eye(eye)) +
              " eye; look at the thread that hangs " + fixed_text(thread_m * 1e3, 0) +
              " mm before the eyes, dark before the light (not at its shadow).\nPress the left arrow (or l) "
              "where the bright line below lies left of the thread, the right arrow (or r) where it lies right of it.",
          {'l', 'r', SeatKey::nearer, SeatKey::farther}};
}

Result<ExitStatus> measure(const ViewerOptions& options, ViewerSitting& sitting) {
  PerEye<EqualityEstimate> eyes;
  std::optional<ThreadSights> sights;
  for (const Side eye : both_sides) {
    const std::string word = eye_word(eye);
    auto made = thread_sights(sitting.source(), eye, options.thread_m);
    if (!made) return made.fault();
    sights = *std::move(made);
    const auto show = sitting.folder() / (word + ".h5");
    const auto test = sitting.make("Making the lines for the " + word + " eye", [&](const FrameProgress& progress) {
      return thread_test(*sights, show, progress, sitting.stop());
    });
    if (!test) return test.fault();
    const auto reader = ShowReader::open(show);
    if (!reader) return reader.fault();
    const double scripted_x_mm = (eye == Side::left ? -0.5 : 0.5) * options.scripted.value_or(0.0);
    const auto seen = [&](std::size_t level) { return seen_thread_difference(*reader, level, *sights, scripted_x_mm); };
    const auto found = sitting.ask(*test, guide(eye, options.thread_m), seen, "." + word);
    if (!found) return found.fault();
    eyes[eye] = *found;
  }
  const InterpupillaryDistance found = interpupillary_distance(eyes, *sights, options.thread_uncertainty_mm);
  if (Status good = check_found(options, "interpupillary", eyes.left.inside && eyes.right.inside, found.mm,
                                found.uncertainty_mm, "40 to 84 mm");
      !good) {
    return good.fault();
  }
  const Edit edit{Edit::Kind::set, "viewer", "", "interpupillary_mm", std::round(found.mm * 100.0) / 100.0};
  if (Status saved = sitting.save(edit); !saved) return saved.fault();
  print_found(options, found, eyes.left.answers + eyes.right.answers, edit,
              sitting.source().project.viewer.interpupillary_mm);
  return ExitStatus::done;
}

}  // namespace

ExitStatus run_calibrate_interpupillary(const ViewerOptions& options) {
  return run_sitting(options, [&](ViewerSitting& sitting) { return measure(options, sitting); });
}

}  // namespace focalstage
