#pragma once

#include "core/base/result.h"
#include "core/retina/retina.h"

namespace focalstage {

/// What keeps an input or a view from meaning anything: a Fault "retina.input".
Status check_retina(const RetinaInput& input, const RetinaView& view);

}  // namespace focalstage
