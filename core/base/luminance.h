#pragma once

namespace focalstage {

/// Luminance of linear RGB with Rec. 709's primaries (ITU-R BT.709), in the unit of its arguments.
template <class Number>
constexpr Number luminance(Number red, Number green, Number blue) {
  return Number(0.2126) * red + Number(0.7152) * green + Number(0.0722) * blue;
}

}  // namespace focalstage
