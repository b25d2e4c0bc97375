#pragma once

#include <string>

#include "core/base/result.h"
#include "devices/lightcrafter/lightcrafter.h"

namespace focalstage {

/// Makes the unit with this serial (empty: the only one, or the first) glow three times, without its video output, and
/// leaves it dark. Faults as those of its driver; "projector.busy" where this program has it open.
Status identify_lightcrafter(const std::string& serial, const OpenReports& open_reports = lightcrafter::open_hid);

}  // namespace focalstage
