#pragma once

#include <string>
#include <vector>

namespace focalstage {

/// Something that runs behind the window and can be cancelled: an import, an export, a push.
struct Task {
  int id = 0;
  std::string title;    ///< "Import rabbit.glb"
  double share = -1.0;  ///< done, 0..1; negative: nobody knows
  std::string detail;   ///< "12 of 30 frames"
  bool quiet = false;   ///< not worth a person's notice
};

/// Something to decide before the editor goes on. The first choice is the default, the last is "Cancel".
struct Question {
  std::string title;
  std::string text;
  std::vector<std::string> choices;
};

/// A path that a command needs and the window is to ask for.
enum class FileWish { none, open, save_as, import_mesh };

}  // namespace focalstage
