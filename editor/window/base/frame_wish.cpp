#include "editor/window/base/frame_wish.h"

#include <algorithm>
#include <limits>

namespace focalstage {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
double wish_s = never;

}  // namespace

void want_frame_within(double seconds) { wish_s = std::min(wish_s, seconds); }

double take_frame_wish() {
  const double wish = wish_s;
  wish_s = never;
  return wish;
}

}  // namespace focalstage
