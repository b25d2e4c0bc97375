#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "io/show/reader.h"

namespace focalstage {

/// Writes a show for other tools into `folder`: a PNG per frame and image (`frame-0000-left-+0.50D.png`),
/// `schedule.csv`, `waveform.csv` and `timing.vcd` (opens in GTKWave).
Status export_show(const ShowReader& show, const std::filesystem::path& folder);

}  // namespace focalstage
