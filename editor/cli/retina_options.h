#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/percept/seen_frame.h"
#include "core/retina/retina.h"
#include "editor/pipeline/focal_sweep.h"
#include "io/show/reader.h"

namespace CLI {
class App;
}

namespace focalstage {

/// What `focalstage retina` was asked for.
struct RetinaOptions {
  std::string show;
  std::string output;  ///< the picture; with a sweep the folder
  std::string eye;
  std::string size = "800x600";
  std::optional<double> focus_m;
  std::string sweep;
  double pupil_mm = 4.0;
  double fov_deg = 50.0;
  int frame = 0;
  std::string conflict;
  int rays = 0;
  double shutter_open_ms = -1.0;
  double shutter_close_ms = -1.0;
  bool diffraction = false;
  bool chromatic = false;
  bool json = false;
};

/// Adds the options to `app`; they are read into the result.
std::shared_ptr<RetinaOptions> declare_retina_options(CLI::App& app);

/// How the eye looks; its focus is left alone where a sweep is asked for. Faults mean wrong usage.
Result<RetinaView> view_of(const RetinaOptions& options);

/// "FROM:TO:COUNT" in dioptres: 0 (infinity) to 100 D, 2 to 1000 of them. Faults mean wrong usage.
Result<FocusRange> focus_range_of(const std::string& text);

/// The show's glasses, or slower or faster ones where the options say so.
Result<std::optional<WornGlasses>> worn(const RetinaOptions& options, const ShowReader& show);

}  // namespace focalstage
