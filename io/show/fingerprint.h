#pragma once

#include "io/files/digest.h"
#include "io/show/show.h"

namespace focalstage {

/// Names everything that decides a show's bytes apart from its frames: the header, the form of the chunks and what
/// compresses them. Two runs with the same fingerprint may share a part.
Sha256Value fingerprint_of(const ShowHeader& header);

}  // namespace focalstage
