#pragma once

#include <filesystem>
#include <string>

#include "core/base/result.h"
#include "editor/window/app/script.h"

namespace focalstage {

class Editor;

/// Plays a script into an editor: hands through its Input, commands and edits through its Session.
class ScriptPlayer {
 public:
  /// `folder`: where relative paths of the script's files begin.
  ScriptPlayer(Editor& editor, std::filesystem::path folder) : editor_(editor), folder_(std::move(folder)) {}

  /// Does one step and lets the window answer it. `where` ("FILE:LINE") stands in its fault.
  Status play(const ScriptStep& step, const std::string& where);

 private:
  Status act(const RunCommand& step);
  Status act(const ApplyEdit& step);
  Status act(const SelectThing& step);
  Status act(const WaitFor& step);
  Status act(const ScriptClick& step);
  Status act(const MovePointer& step);
  Status act(const HoldButton& step);
  Status act(const DragPointer& step);
  Status act(const ScrollWheel& step);
  Status act(const PressKey& step);
  Status act(const TypeText& step);
  Status act(const DropFiles& step);
  Status act(const ResizeWindow& step);
  Status act(const SetScale& step);
  Status act(const ExpectValue& step);
  Status act(const ExpectWidget& step);
  Status act(const ExpectColour& step);
  Status act(const ExpectPicture& step);
  Status act(const TakeScreenshot& step);
  Status act(const DrawFrames& step);
  Status act(const PrintValue& step);
  Status act(const PrintWidgets& step);

  /// Codes of a part of the window, three a pixel.
  struct Shot {
    glm::ivec2 size_px{0};
    std::vector<std::uint8_t> rgb;
  };
  Result<Shot> shoot(const std::vector<std::string>& widgets);

  Fault wrong(const std::string& what) const { return {"script.failed", where_, what, ""}; }
  Result<glm::vec2> pixel_of(const ScriptPlace& place);
  void hold_modifiers(const ScriptClick& click, bool down);
  /// Frames until what hands did has been taken and answered.
  void answer();
  /// Frames until the picture would not change any more.
  void settle();

  Editor& editor_;
  std::filesystem::path folder_;
  std::string where_;
};

/// The whole file; the first fault ends it.
Status play_script(Editor& editor, const std::filesystem::path& file);

}  // namespace focalstage
