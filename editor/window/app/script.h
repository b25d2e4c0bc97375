#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/base/result.h"
#include "core/scene/value.h"
#include "editor/window/app/keys.h"

namespace focalstage {

/// A place in the window: a widget by name, or the window itself where `name` is empty; `at` within it: shares 0..1 of
/// a widget (its centre by default), pixels of the window.
struct ScriptPlace {
  std::string name;
  glm::vec2 at{0.5f};
};

/// What is held while a button is pressed.
struct ScriptClick {
  ScriptPlace place;
  int button = 0;
  int times = 1;
  bool ctrl = false;
  bool shift = false;
  bool alt = false;
};

// One line of a script each.
struct RunCommand {
  std::string command;
  Value args;
};
struct ApplyEdit {
  Value edit;
};
struct SelectThing {
  std::string list;
  std::string name;
};
struct WaitFor {
  enum class What { compile, push, rig, seconds, tasks };
  What what = What::compile;
  std::string state;      ///< of the rig
  double seconds = 30.0;  ///< how long, or how long at most
};
struct MovePointer {
  ScriptPlace place;
};
struct HoldButton {
  std::optional<ScriptPlace> place;  ///< where the pointer goes first; none: where it is
  bool down = true;
  int button = 0;
};
struct DragPointer {
  ScriptClick from;
  ScriptPlace to;
  int steps = 8;
};
struct ScrollWheel {
  float steps = 0.0f;
};
struct PressKey {
  KeyChord chord;
};
struct TypeText {
  std::string text;
};
struct DropFiles {
  std::string path;
};
struct ResizeWindow {
  glm::ivec2 size_px{0};
};
struct SetScale {
  double scale = 1.0;
};
struct ExpectValue {
  std::string pointer;
  Value value;
  double tolerance = 0.0;
};
struct ExpectWidget {
  std::string name;
  bool absent = false;
};
struct ExpectColour {
  ScriptPlace place;
  glm::ivec3 rgb{0};
  int tolerance = 0;
};
struct TakeScreenshot {
  std::string path;
  std::vector<std::string> of;  ///< what of the window: around these widgets; none: all of it
};
/// The picture of a screenshot against one that a person has approved.
struct ExpectPicture {
  TakeScreenshot picture;  ///< the approved one; relative to the script
  double share = 0.02;     ///< of pixels that may differ visibly
};
struct DrawFrames {
  int count = 1;
};
struct PrintValue {
  std::string pointer;
};
struct PrintWidgets {};

using ScriptStep =
    std::variant<RunCommand, ApplyEdit, SelectThing, WaitFor, ScriptClick, MovePointer, HoldButton, DragPointer,
                 ScrollWheel, PressKey, TypeText, DropFiles, ResizeWindow, SetScale, ExpectValue, ExpectWidget,
                 ExpectColour, ExpectPicture, TakeScreenshot, DrawFrames, PrintValue, PrintWidgets>;

struct ScriptLine {
  int number = 0;
  bool timed = false;  ///< "timed STEP": says how long its frames took
  ScriptStep step;
};

/// One step. Fault "script.syntax" says what the line should have been.
Result<ScriptStep> parse_script_step(std::string_view line, const std::string& where);

/// A script whole: a step per line, `#` begins a comment line. Faults name `source:LINE`.
Result<std::vector<ScriptLine>> parse_script(std::string_view text, const std::string& source);

}  // namespace focalstage
