#pragma once

#include <memory>

#include "devices/display/display.h"
#include "devices/display_kms/kms_output.h"

namespace focalstage {

/// A video output without a window system, through the kernel's mode setting. It is found by who the display says that
/// it is (EDID), never by a connector's number; no other program may hold the card's outputs.
std::unique_ptr<Display> make_kms_display(const KmsSettings& settings, DrmCalls& drm = kernel_drm());

}  // namespace focalstage
