#include "devices/roles/picture.h"

#include <algorithm>

namespace focalstage {

bool same_picture(const Picture& a, const Picture& b) {
  if (a.codes.size() != b.codes.size()) return false;
  return a.codes.data() == b.codes.data() || std::ranges::equal(a.codes, b.codes);
}

}  // namespace focalstage
