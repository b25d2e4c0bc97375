#pragma once

#include <functional>
#include <memory>

#include "devices/display/display.h"
#include "devices/lightcrafter/link.h"
#include "devices/lightcrafter/settings.h"
#include "devices/roles/projector.h"

namespace focalstage {

using OpenReports = std::function<Result<std::unique_ptr<lightcrafter::Reports>>(const std::string& serial,
                                                                                 const std::string& address)>;

/// A TI DLP LightCrafter 4500: told over USB what to do, and given the pictures of each period as the bit planes of one
/// frame of a video output. Its clock is that output's. Pictures are 912 x 1140, on the lattice of its mirrors.
std::unique_ptr<ProjectorDevice> make_lightcrafter(const LightCrafterSettings& settings,
                                                   std::unique_ptr<Display> display,
                                                   OpenReports open_reports = lightcrafter::open_hid);

}  // namespace focalstage
