#include "editor/window/app/script.h"

#include <charconv>
#include <optional>

#include "editor/window/app/script_words.h"
#include "io/json/json.h"

namespace focalstage {
namespace {

using Step = Result<ScriptStep>;

/// What a line is parsed with: its words and where it stands, for faults.
struct Line {
  ScriptWords words;
  const std::string& where;

  Fault wrong(const std::string& form) const { return {"script.syntax", where, "this should read: " + form, ""}; }
};

Result<Value> json_rest(Line& line) {
  const std::string text = line.words.take_rest();
  if (text.empty()) return Value{};
  return parse_json(text, line.where);
}

/// NAME, NAME X Y (shares), or X Y (pixels).
std::optional<ScriptPlace> take_place(ScriptWords& words) {
  if (const auto x = words.take_number()) {
    const auto y = words.take_number();
    if (!y) return std::nullopt;
    return ScriptPlace{{}, {static_cast<float>(*x), static_cast<float>(*y)}};
  }
  ScriptPlace place;
  place.name = words.take();
  if (place.name.empty()) return std::nullopt;
  if (const auto x = words.take_number()) {
    const auto y = words.take_number();
    if (!y) return std::nullopt;
    place.at = {static_cast<float>(*x), static_cast<float>(*y)};
  }
  return place;
}

bool take_modifiers(ScriptWords& words, ScriptClick& click) {
  while (!words.at_end()) {
    if (words.take_if("right")) {
      click.button = 1;
    } else if (words.take_if("middle")) {
      click.button = 2;
    } else if (words.take_if("double")) {
      click.times = 2;
    } else if (words.take_if("ctrl")) {
      click.ctrl = true;
    } else if (words.take_if("shift")) {
      click.shift = true;
    } else if (words.take_if("alt")) {
      click.alt = true;
    } else {
      return false;
    }
  }
  return true;
}

Step run_step(Line& line) {
  RunCommand step;
  step.command = line.words.take();
  if (step.command.empty()) return line.wrong("run COMMAND [{args}]");
  const auto args = json_rest(line);
  if (!args) return args.fault();
  step.args = *args;
  return ScriptStep{step};
}

Step edit_step(Line& line) {
  const auto edit = json_rest(line);
  if (!edit) return edit.fault();
  if (edit->object() == nullptr && edit->array() == nullptr) return line.wrong("edit {edit} or edit [edits]");
  return ScriptStep{ApplyEdit{*edit}};
}

Step select_step(Line& line) {
  SelectThing step;
  step.list = line.words.take();
  step.name = line.words.take();
  if (!line.words.at_end()) return line.wrong("select LIST NAME, or select for nothing");
  return ScriptStep{step};
}

Step wait_step(Line& line) {
  const char* form = "wait compile|push|tasks|rig STATE [within SECONDS], or wait seconds N";
  WaitFor step;
  const std::string what = line.words.take();
  if (what == "seconds") {
    const auto seconds = line.words.take_number();
    if (!seconds) return line.wrong(form);
    return ScriptStep{WaitFor{WaitFor::What::seconds, {}, *seconds}};
  }
  if (what == "rig") {
    step.what = WaitFor::What::rig;
    step.state = line.words.take();
    if (step.state.empty()) return line.wrong(form);
  } else if (what == "push") {
    step.what = WaitFor::What::push;
  } else if (what == "tasks" || what == "task") {
    step.what = WaitFor::What::tasks;
  } else if (what != "compile") {
    return line.wrong(form);
  }
  if (line.words.take_if("within")) {
    const auto seconds = line.words.take_number();
    if (!seconds) return line.wrong(form);
    step.seconds = *seconds;
  }
  if (!line.words.at_end()) return line.wrong(form);
  return ScriptStep{step};
}

Step click_step(Line& line) {
  const char* form = "click NAME [X Y]|X Y [right|middle] [double] [ctrl] [shift] [alt]";
  ScriptClick click;
  const auto place = take_place(line.words);
  if (!place) return line.wrong(form);
  click.place = *place;
  if (!take_modifiers(line.words, click)) return line.wrong(form);
  return ScriptStep{click};
}

Step move_step(Line& line) {
  const auto place = take_place(line.words);
  if (!place || !line.words.at_end()) return line.wrong("move NAME [X Y]|X Y");
  return ScriptStep{MovePointer{*place}};
}

Step hold_step(Line& line, bool down) {
  const char* form = "press [PLACE] [right|middle], release [PLACE] [right|middle]";
  HoldButton step;
  step.down = down;
  const std::string first = line.words.peek();
  if (!line.words.at_end() && first != "right" && first != "middle") {
    step.place = take_place(line.words);
    if (!step.place) return line.wrong(form);
  }
  if (line.words.take_if("right")) step.button = 1;
  if (line.words.take_if("middle")) step.button = 2;
  if (!line.words.at_end()) return line.wrong(form);
  return ScriptStep{step};
}

Step drag_step(Line& line) {
  const char* form = "drag FROM -> TO [steps N] [right|middle] [ctrl] [shift] [alt]";
  DragPointer step;
  const auto from = take_place(line.words);
  if (!from || !line.words.take_if("->")) return line.wrong(form);
  const auto to = take_place(line.words);
  if (!to) return line.wrong(form);
  step.from.place = *from;
  step.to = *to;
  if (line.words.take_if("steps")) {
    const auto steps = line.words.take_number();
    if (!steps || *steps < 1.0 || *steps > 10000.0) return line.wrong(form);
    step.steps = static_cast<int>(*steps);
  }
  if (!take_modifiers(line.words, step.from)) return line.wrong(form);
  return ScriptStep{step};
}

Step scroll_step(Line& line) {
  const auto steps = line.words.take_number();
  if (!steps || !line.words.at_end()) return line.wrong("scroll STEPS");
  return ScriptStep{ScrollWheel{static_cast<float>(*steps)}};
}

Step key_step(Line& line) {
  const auto chord = chord_named(line.words.take());
  if (!chord || !line.words.at_end()) return line.wrong("key CHORD, such as Ctrl+Shift+S");
  return ScriptStep{PressKey{*chord}};
}

Step type_step(Line& line) {
  const std::string text = line.words.next_is_quoted() ? line.words.take() : line.words.take_rest();
  if (text.empty()) return line.wrong("type TEXT");
  return ScriptStep{TypeText{text}};
}

Step drop_step(Line& line) {
  const std::string path = line.words.take();
  if (path.empty() || !line.words.at_end()) return line.wrong("drop PATH");
  return ScriptStep{DropFiles{path}};
}

Step size_step(Line& line) {
  const auto width = line.words.take_number();
  const auto height = line.words.take_number();
  if (!width || !height || *width < 1.0 || *height < 1.0 || *width > 16384.0 || *height > 16384.0) {
    return line.wrong("size WIDTH HEIGHT");
  }
  return ScriptStep{ResizeWindow{{static_cast<int>(*width), static_cast<int>(*height)}}};
}

Step scale_step(Line& line) {
  const auto scale = line.words.take_number();
  if (!scale || *scale < 1.0 || *scale > 3.0) return line.wrong("scale S, from 1 to 3");
  return ScriptStep{SetScale{*scale}};
}

/// "/a/b VALUE within T": the value is JSON and may hold blanks.
Step expect_step(Line& line) {
  const char* form = "expect POINTER VALUE [within TOLERANCE]";
  ExpectValue step;
  step.pointer = line.words.take();
  std::string text = line.words.take_rest();
  if (const auto at = text.rfind(" within "); at != std::string::npos) {
    ScriptWords tail(std::string_view(text).substr(at + 8));
    const auto tolerance = tail.take_number();
    if (tolerance && tail.at_end()) {
      step.tolerance = *tolerance;
      text.resize(at);
    }
  }
  if (step.pointer.empty() || text.empty()) return line.wrong(form);
  const auto value = parse_json(text, line.where);
  if (!value) return value.fault();
  step.value = *value;
  return ScriptStep{step};
}

Step expect_widget_step(Line& line) {
  ExpectWidget step;
  step.name = line.words.take();
  step.absent = line.words.take_if("absent");
  if (step.name.empty() || !line.words.at_end()) return line.wrong("expect-widget NAME [absent]");
  return ScriptStep{step};
}

std::optional<glm::ivec3> colour_of(const std::string& text) {
  unsigned rgb = 0;
  if (text.size() != 7 || text[0] != '#') return std::nullopt;
  const auto [end, problem] = std::from_chars(text.data() + 1, text.data() + 7, rgb, 16);
  if (problem != std::errc{} || end != text.data() + 7) return std::nullopt;
  return glm::ivec3(rgb >> 16, (rgb >> 8) & 0xFFu, rgb & 0xFFu);
}

Step expect_colour_step(Line& line) {
  const char* form = "expect-color NAME [X Y]|X Y #rrggbb [within N]";
  const auto place = take_place(line.words);
  const auto rgb = colour_of(line.words.take());
  if (!place || !rgb) return line.wrong(form);
  ExpectColour step{*place, *rgb, 0};
  if (line.words.take_if("within")) {
    const auto tolerance = line.words.take_number();
    if (!tolerance) return line.wrong(form);
    step.tolerance = static_cast<int>(*tolerance);
  }
  return ScriptStep{step};
}

Step screenshot_step(Line& line) {
  TakeScreenshot step{line.words.take(), {}};
  if (step.path.empty()) return line.wrong("screenshot PATH [NAME...]");
  while (!line.words.at_end()) step.of.push_back(line.words.take());
  return ScriptStep{step};
}

Step expect_picture_step(Line& line) {
  const char* form = "expect-picture PATH [NAME...] [within SHARE]";
  ExpectPicture step;
  step.picture.path = line.words.take();
  if (step.picture.path.empty()) return line.wrong(form);
  while (!line.words.at_end() && !line.words.take_if("within")) step.picture.of.push_back(line.words.take());
  if (!line.words.at_end()) {
    const auto share = line.words.take_number();
    if (!share || *share < 0.0 || *share > 0.5 || !line.words.at_end()) return line.wrong(form);
    step.share = *share;
  }
  return ScriptStep{step};
}

Step frames_step(Line& line) {
  const auto count = line.words.take_number();
  if (!count || *count < 1.0 || *count > 1.0e6) return line.wrong("frames N");
  return ScriptStep{DrawFrames{static_cast<int>(*count)}};
}

struct Verb {
  std::string_view name;
  Step (*parse)(Line&);
};

constexpr Verb verbs[] = {
    {"run", run_step},
    {"edit", edit_step},
    {"select", select_step},
    {"wait", wait_step},
    {"click", click_step},
    {"move", move_step},
    {"press", [](Line& line) { return hold_step(line, true); }},
    {"release", [](Line& line) { return hold_step(line, false); }},
    {"drag", drag_step},
    {"scroll", scroll_step},
    {"key", key_step},
    {"type", type_step},
    {"drop", drop_step},
    {"size", size_step},
    {"scale", scale_step},
    {"expect", expect_step},
    {"expect-widget", expect_widget_step},
    {"expect-color", expect_colour_step},
    {"expect-picture", expect_picture_step},
    {"screenshot", screenshot_step},
    {"frames", frames_step},
    {"print", [](Line& line) { return Step(ScriptStep{PrintValue{line.words.take()}}); }},
    {"widgets", [](Line&) { return Step(ScriptStep{PrintWidgets{}}); }},
};

}  // namespace

Result<ScriptStep> parse_script_step(std::string_view text, const std::string& where) {
  Line line{ScriptWords(text), where};
  const std::string name = line.words.take();
  for (const Verb& verb : verbs) {
    if (verb.name == name) return verb.parse(line);
  }
  std::string known;
  for (const Verb& verb : verbs) known += (known.empty() ? "" : ", ") + std::string(verb.name);
  return Fault{"script.syntax", where, "\"" + name + "\" is nothing a script can do", "choose from " + known};
}

Result<std::vector<ScriptLine>> parse_script(std::string_view text, const std::string& source) {
  std::vector<ScriptLine> lines;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ' || line.back() == '\t')) line.remove_suffix(1);
    ScriptWords words(line);
    if (words.at_end() || words.rest().front() == '#') continue;
    const bool timed = words.take_if("timed");
    const auto step = parse_script_step(words.rest(), source + ":" + std::to_string(number));
    if (!step) return step.fault();
    lines.push_back({number, timed, *step});
  }
  return lines;
}

}  // namespace focalstage
