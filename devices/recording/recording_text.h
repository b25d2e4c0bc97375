#pragma once

#include <istream>
#include <ostream>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "devices/roles/tracker.h"

namespace focalstage {

/// What a tracker said, frame by frame, in the order of arrival (docs/formats/tracking.md).
using TrackerRecording = std::vector<TrackedFrame>;

/// The two lines that a recording begins with.
std::string recording_head();

/// The lines of one frame. Numbers come back to the last bit.
std::string recording_lines(const TrackedFrame& frame);

/// "recording.format", with the line and the reason; `name` is what faults call the text. A recording holds a frame at
/// least.
Result<TrackerRecording> read_recording(std::istream& text, const std::string& name);

/// The same from a file; "recording.unreadable".
Result<TrackerRecording> read_recording_file(const std::string& path);

}  // namespace focalstage
