#include <cmath>
#include <cstdio>

#include "editor/cli/output.h"
#include "editor/cli/viewer_sitting.h"
#include "editor/viewer/breathing_rings.h"
#include "io/json/json.h"

namespace focalstage {
namespace {

void print_found(const ViewerOptions& options, const EqualityEstimate& found, const Edit& edit, double before_mm) {
  if (options.json) {
    print_json(Value::Object{{"lens_to_pupil_mm", found.value},
                             {"uncertainty_mm", found.uncertainty},
                             {"spread_mm", found.spread},
                             {"answers", found.answers},
                             {"observer", observer_kind(options)},
                             {"edits", Value::Array{value_from(edit)}},
                             {"applied", !options.dry_run}});
    return;
  }
  std::printf("lens to pupil: %.2f mm, uncertain by %.2f mm (one standard deviation, %d answers%s); it was %.2f mm\n",
              found.value, found.uncertainty, found.answers, options.scripted ? " of a script" : "", before_mm);
  std::printf("%s\n", write_json(value_from(edit), -1).c_str());
}

ViewerSitting::Guide guide(Side eye) {
  return {std::string("Close the ") + eye_word(other_eye(eye)) +
          " eye and look at the small square. Around it are two half rings: compare how far their left and right ends "
          "lie apart.\nPress the up arrow (or u) where the upper one is wider, the down arrow (or d) where the lower "
          "one is."};
}

Result<ExitStatus> measure(const ViewerOptions& options, ViewerSitting& sitting) {
  const auto rings = breathing_rings(sitting.source(), sitting.eye());
  if (!rings) return rings.fault();
  const auto show = sitting.folder() / "rings.h5";
  const auto test = sitting.make("Making the rings", [&](const FrameProgress& progress) {
    return ring_test(*rings, show, progress, sitting.stop());
  });
  if (!test) return test.fault();
  const auto reader = ShowReader::open(show);
  if (!reader) return reader.fault();
  const auto seen = [&](std::size_t level) {
    return seen_ring_difference(*reader, level, eye_at_rings(*rings, *options.scripted));
  };
  const auto found = sitting.ask(*test, guide(rings->eye), seen);
  if (!found) return found.fault();
  if (Status good =
          check_found(options, "lens-to-pupil", found->inside, found->value, found->uncertainty, "5 to 40 mm");
      !good) {
    return good.fault();
  }
  const Edit edit{Edit::Kind::set, "glasses", "", "lens_to_pupil_mm", std::round(found->value * 100.0) / 100.0};
  if (Status saved = sitting.save(edit); !saved) return saved.fault();
  print_found(options, *found, edit, sitting.source().project.glasses.lens_to_pupil_mm);
  return ExitStatus::done;
}

}  // namespace

ExitStatus run_calibrate_lens_to_pupil(const ViewerOptions& options) {
  return run_sitting(options, [&](ViewerSitting& sitting) { return measure(options, sitting); });
}

}  // namespace focalstage
