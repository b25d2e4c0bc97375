#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace focalstage {

/// What a projector shows, one after the other, so that each place of a room tells which pixel lights it: Gray code
/// with inverses tells the stripe, a sine in steps the place in it (J. Salvi, J. Pagès, J. Batlle, "Pattern
/// codification strategies in structured light systems", Pattern Recognition 37(4), 2004). White and black come first
/// and once more last, to tell whether anything moved meanwhile.
struct PatternSet {
  int width_px = 0;    ///< of the projector
  int height_px = 0;   ///< of the projector
  double gamma = 1.0;  ///< of the projector: light = code^gamma
  int stripe_px = 4;   ///< the narrowest of the Gray code; 1 at least
  int period_px = 16;  ///< of the sine; four stripes at least
  int steps = 8;       ///< of the sine, over one period

  bool operator==(const PatternSet&) const = default;
};

enum class PatternKind { white, black, code, sine };
enum class PatternAxis { columns, rows };

struct Pattern {
  PatternKind kind = PatternKind::white;
  PatternAxis axis = PatternAxis::columns;
  int index = 0;  ///< of a code: its bit, the coarsest is 0; of a sine: its step; of white and black: 1 at the end
  bool inverse = false;  ///< of a code

  bool operator==(const Pattern&) const = default;
};

/// "stripes.set": a size, stripe, period or number of steps that cannot be.
Status check_set(const PatternSet& set);

/// How many bits tell a stripe along one axis.
int code_bits(const PatternSet& set, PatternAxis axis);

/// All patterns in the order in which they are shown.
std::vector<Pattern> patterns_of(const PatternSet& set);

/// "white", "black", "columns-code-3", "columns-code-3-inverse", "rows-sine-0", "white-again".
std::string name_of(const Pattern& pattern);

/// 8-bit codes from the top.
std::vector<std::uint8_t> picture_of(const PatternSet& set, const Pattern& pattern);

}  // namespace focalstage
