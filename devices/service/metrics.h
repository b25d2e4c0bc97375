#pragma once

#include <string>

#include "devices/runtime/figures.h"

namespace focalstage {

/// Prometheus' text exposition format 0.0.4.
std::string metrics_text(const RuntimeFigures& figures);

}  // namespace focalstage
