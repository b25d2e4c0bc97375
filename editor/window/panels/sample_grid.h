#pragma once

#include <map>
#include <memory>
#include <string>

#include "editor/window/base/picture.h"

namespace focalstage {

class Session;
struct SampleCard;

/// The samples as cards with a picture each, as many in a row as the region has room for.
class SampleGrid {
 public:
  void draw(Session& session);

 private:
  void draw_card(Session& session, const SampleCard& card, float width_px);
  Picture picture_of(const SampleCard& card);

  std::map<std::string, std::unique_ptr<CodesTexture>> textures_;
};

}  // namespace focalstage
