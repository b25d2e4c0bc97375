#pragma once

#include <cstdint>

namespace focalstage {

class Editor;

/// Random hands: keys, clicks, drags, wheel, text, drops of files that may not exist, sizes. The same seed does the
/// same. Draws every fiftieth frame only.
void play_monkey(Editor& editor, std::uint64_t seed, int events);

}  // namespace focalstage
