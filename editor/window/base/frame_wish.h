#pragma once

namespace focalstage {

/// The window sleeps when nothing happens. What moves by itself (a spinner, a tooltip that waits for the hand to rest)
/// asks for the next frame here while it is drawn.
void want_frame_within(double seconds);

/// The soonest wish since the last call; infinite: none. The loop's.
double take_frame_wish();

}  // namespace focalstage
