#include <cstdio>
#include <filesystem>
#include <system_error>

#include "core/calibrate/charuco.h"
#include "editor/cli/calibrate_actions.h"
#include "editor/cli/calibrate_output.h"
#include "editor/cli/output.h"
#include "editor/cli/scan_file.h"
#include "io/files/files.h"
#include "io/image/png.h"

namespace focalstage {
namespace {

namespace fs = std::filesystem;

constexpr int board_square_px = 160;

/// A board to print: what scan.json tells of it is up to whoever measures the print.
CharucoBoard printed_board() { return {9, 7, 0.05, 0.03, "4x4_50"}; }

Status write_all(const PatternsFile& patterns, const fs::path& folder) {
  std::error_code problem;
  fs::create_directories(folder, problem);
  if (problem) return Fault{"file.unwritable", folder.string(), problem.message(), "choose another folder"};
  const PatternSet& set = patterns.set;
  const auto all = patterns_of(set);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const fs::path file = folder / (picture_name(set, i) + ".png");
    if (Status written = write_png(file, set.width_px, set.height_px, 1, picture_of(set, all[i])); !written) {
      return written;
    }
  }
  const auto board = picture_of_board(printed_board(), board_square_px);
  if (!board) return board.fault();
  if (Status written = write_png(folder / "board.png", board->width_px, board->height_px, 1, board->gray); !written) {
    return written;
  }
  return write_file_atomically(folder / patterns_file_name, patterns_text(patterns));
}

}  // namespace

ExitStatus run_calibrate_patterns(const CalibrateOptions& options) {
  const auto loaded = load_project(options.project);
  if (!loaded) return report(loaded.fault());
  const auto projector = projector_meant(*loaded, options.projector);
  if (!projector) return report(projector.fault());
  const PatternsFile patterns{projector->name,
                              {projector->width_px, projector->height_px, projector->gamma, options.stripe_px,
                               options.period_px, options.steps}};
  if (Status good = check_set(patterns.set); !good) return report(good.fault());
  if (Status written = write_all(patterns, options.output); !written) return report(written.fault());
  std::printf("%s: %zu patterns of %d x %d pixels for %s, and board.png to print\n", options.output.c_str(),
              patterns_of(patterns.set).size(), projector->width_px, projector->height_px, projector->name.c_str());
  return ExitStatus::done;
}

}  // namespace focalstage
