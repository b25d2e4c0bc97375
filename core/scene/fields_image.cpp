#include "core/scene/fields_image.h"

#include "core/scene/sequence.h"

namespace focalstage {

bool Table<ImageAppearance>::check(Reading& reading, const ImageAppearance& image) {
  if (image.count <= 0 || has_number_place(image.file)) return true;
  return reading.fail_at("file", "project.range", "does not say where the numbers of the pictures go",
                         "write one run of # for them, as in fire_####.png");
}

}  // namespace focalstage
