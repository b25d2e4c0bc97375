#pragma once

#include <filesystem>
#include <functional>
#include <stop_token>

#include "core/base/result.h"
#include "io/show/reader.h"

namespace focalstage {

/// Told after each frame: how many are written, of how many.
using ExportProgress = std::function<void(int done, int total)>;

/// Writes a show for other tools into `folder` (made if missing): a PNG per frame and image
/// (`frame-0000-left-+0.50D.png`), `schedule.csv`, `waveform.csv` and `timing.vcd` (opens in GTKWave). What
/// further projectors show goes into folders `projector-1` and up, in the same way. Each file is
/// replaced whole; the same show gives the same bytes. Faults: those of the show, "file.unwritable", "export.folder",
/// "export.cancelled".
Status export_show(const ShowReader& show, const std::filesystem::path& folder, const ExportProgress& progress = {},
                   std::stop_token stop = {});

}  // namespace focalstage
