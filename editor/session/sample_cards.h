#pragma once

#include <memory>
#include <string>
#include <vector>

#include "editor/preview/preview_values.h"

namespace focalstage {

/// A sample as the start screen offers it.
struct SampleCard {
  std::string name;                           ///< that "file.new" takes: "three-rabbits"
  std::string title;                          ///< "Three rabbits"
  std::string says;                           ///< what it shows, in a few words
  std::shared_ptr<const EyePicture> picture;  ///< null: not drawn yet
};

/// One for each sample, without their pictures; the simplest first.
std::vector<SampleCard> make_sample_cards();

}  // namespace focalstage
