#include "editor/window/app/script_player.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <glm/common.hpp>

#include "core/scene/edit.h"
#include "editor/window/app/editor.h"
#include "editor/window/base/widget_registry.h"
#include "io/files/files.h"

namespace focalstage {
namespace {

constexpr double tick_s = 0.005;

/// The characters of UTF-8 text.
std::vector<unsigned> characters_of(std::string_view text) {
  std::vector<unsigned> codes;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xC0u) == 0x80u && !codes.empty()) {
      codes.back() = (codes.back() << 6) | (byte & 0x3Fu);
    } else if (byte < 0x80u) {
      codes.push_back(byte);
    } else {
      codes.push_back(byte & (byte < 0xE0u ? 0x1Fu : byte < 0xF0u ? 0x0Fu : 0x07u));
    }
  }
  return codes;
}

void print_times(std::vector<double> times_ms) {
  if (times_ms.empty()) return;
  std::ranges::sort(times_ms);
  const auto at = [&](double share) {
    return times_ms[static_cast<std::size_t>(share * static_cast<double>(times_ms.size() - 1) + 0.5)];
  };
  std::printf("%zu frames: median %.1f ms, 95th percentile %.1f ms, longest %.1f ms\n", times_ms.size(), at(0.5),
              at(0.95), times_ms.back());
}

}  // namespace

Status ScriptPlayer::play(const ScriptStep& step, const std::string& where) {
  where_ = where;
  Status done = std::visit([this](const auto& what) { return act(what); }, step);
  if (done || done.fault().where == where) return done;
  Fault fault = done.fault();
  fault.where = where + (fault.where.empty() ? "" : ": " + fault.where);
  return fault;
}

void ScriptPlayer::answer() {
  // One frame at least, and two after the last event: ImGui answers a press in the frame after it.
  int quiet = 0;
  while (quiet < 2) {
    editor_.take_news(0.0);
    quiet = editor_.window().input().empty() ? quiet + 1 : 0;
    editor_.frame({});
  }
}

void ScriptPlayer::settle() {
  answer();
  for (int i = 0; i < 600 && editor_.unsettled(); ++i) {
    editor_.take_news(tick_s);
    editor_.frame({});
  }
}

Result<glm::vec2> ScriptPlayer::pixel_of(const ScriptPlace& place) {
  if (place.name.empty()) return place.at;
  const SeenWidget* widget = seen_widget(place.name);
  if (widget == nullptr) return wrong("there is no widget \"" + place.name + "\" (\"widgets\" lists them)");
  if (!widget->visible) return wrong("\"" + place.name + "\" is scrolled out of sight");
  return glm::floor(widget->min + place.at * (widget->max - widget->min)) + 0.5f;
}

void ScriptPlayer::hold_modifiers(const ScriptClick& click, bool down) {
  Input& input = editor_.window().input();
  if (click.ctrl) input.key(GLFW_KEY_LEFT_CONTROL, down);
  if (click.shift) input.key(GLFW_KEY_LEFT_SHIFT, down);
  if (click.alt) input.key(GLFW_KEY_LEFT_ALT, down);
}

Status ScriptPlayer::act(const RunCommand& step) {
  const Status done = editor_.session().run(step.command, step.args);
  answer();
  return done;
}

Status ScriptPlayer::act(const ApplyEdit& step) {
  std::vector<Edit> edits;
  const Value::Array one{step.edit};
  for (const Value& value : step.edit.array() != nullptr ? *step.edit.array() : one) {
    const auto edit = edit_from(value);
    if (!edit) return edit.fault();
    edits.push_back(*edit);
  }
  const Status done = editor_.session().edit("Scripted edit", std::move(edits));
  answer();
  return done;
}

Status ScriptPlayer::act(const SelectThing& step) {
  Session& session = editor_.session();
  const Thing thing{step.list, step.name};
  if (step.list.empty()) {
    session.select({});
  } else if (!exists(session.project(), thing)) {
    return wrong("the project has no " + step.list + " \"" + step.name + "\"");
  } else {
    session.select({thing});
  }
  answer();
  return {};
}

Status ScriptPlayer::act(const WaitFor& step) {
  const double end_s = seconds_now() + step.seconds;
  const Session& session = editor_.session();
  const auto text_of = [&](const char* member) {
    const Value state = session.described();
    const Value* rig = state.find("rig");
    const Value* text = rig != nullptr ? rig->find(member) : nullptr;
    return text != nullptr && text->text() != nullptr ? *text->text() : std::string();
  };
  const auto fulfilled = [&] {
    switch (step.what) {
      case WaitFor::What::compile:
        return !session.compiling();
      case WaitFor::What::push:
        return !session.rig().status().pushing;
      case WaitFor::What::tasks:
        return session.tasks().empty();
      case WaitFor::What::rig:
        return text_of("state") == step.state || text_of("phase") == step.state;
      case WaitFor::What::seconds:
        break;
    }
    return false;
  };
  // Two frames in which nothing is left to do: what was just asked may only now be on its way.
  for (int calm = 0; calm < 2;) {
    if (seconds_now() > end_s) {
      if (step.what == WaitFor::What::seconds) break;
      return wrong("waited " + std::to_string(static_cast<int>(step.seconds)) + " s in vain");
    }
    editor_.take_news(tick_s);
    editor_.frame({});
    calm = fulfilled() ? calm + 1 : 0;
  }
  answer();
  return {};
}

Status ScriptPlayer::act(const ScriptClick& step) {
  const auto pixel = pixel_of(step.place);
  if (!pixel) return pixel.fault();
  Input& input = editor_.window().input();
  input.move(*pixel);
  answer();
  hold_modifiers(step, true);
  for (int i = 0; i < step.times; ++i) {
    input.button(step.button, true);
    input.button(step.button, false);
  }
  hold_modifiers(step, false);
  answer();
  return {};
}

Status ScriptPlayer::act(const MovePointer& step) {
  const auto pixel = pixel_of(step.place);
  if (!pixel) return pixel.fault();
  editor_.window().input().move(*pixel);
  answer();
  return {};
}

Status ScriptPlayer::act(const HoldButton& step) {
  if (step.place) {
    if (const Status moved = act(MovePointer{*step.place}); !moved) return moved;
  }
  editor_.window().input().button(step.button, step.down);
  answer();
  return {};
}

Status ScriptPlayer::act(const DragPointer& step) {
  const auto from = pixel_of(step.from.place);
  if (!from) return from.fault();
  const auto to = pixel_of(step.to);
  if (!to) return to.fault();
  Input& input = editor_.window().input();
  input.move(*from);
  answer();
  hold_modifiers(step.from, true);
  input.button(step.from.button, true);
  answer();
  for (int i = 1; i <= step.steps; ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(step.steps);
    input.move(glm::mix(*from, *to, share));
    editor_.take_news(0.0);
    editor_.frame({});
  }
  answer();
  input.button(step.from.button, false);
  hold_modifiers(step.from, false);
  answer();
  return {};
}

Status ScriptPlayer::act(const ScrollWheel& step) {
  editor_.window().input().scroll({0.0f, step.steps});
  answer();
  return {};
}

Status ScriptPlayer::act(const PressKey& step) {
  Input& input = editor_.window().input();
  ScriptClick held;
  held.ctrl = step.chord.ctrl;
  held.shift = step.chord.shift;
  held.alt = step.chord.alt;
  hold_modifiers(held, true);
  input.key(step.chord.key, true);
  input.key(step.chord.key, false);
  hold_modifiers(held, false);
  answer();
  return {};
}

Status ScriptPlayer::act(const TypeText& step) {
  for (const unsigned code : characters_of(step.text)) editor_.window().input().character(code);
  answer();
  return {};
}

Status ScriptPlayer::act(const DropFiles& step) {
  editor_.window().input().drop({folder_ / step.path});
  answer();
  return {};
}

Status ScriptPlayer::act(const ResizeWindow& step) {
  editor_.window().resize(step.size_px);
  const double end_s = seconds_now() + 5.0;
  while (editor_.window().framebuffer_px() != step.size_px) {
    if (seconds_now() > end_s) return wrong("the system does not let the window have that size");
    editor_.take_news(tick_s);
  }
  answer();
  return {};
}

Status ScriptPlayer::act(const SetScale& step) {
  editor_.set_scale(step.scale);
  answer();
  return {};
}

Status ScriptPlayer::act(const DrawFrames& step) {
  (void)editor_.take_frame_times_ms();
  for (int i = 0; i < step.count; ++i) {
    editor_.take_news(0.0);
    editor_.frame({});
  }
  print_times(editor_.take_frame_times_ms());
  return {};
}

Status play_script(Editor& editor, const std::filesystem::path& file) {
  const auto bytes = read_file(file, 1 << 20);
  if (!bytes) return bytes.fault();
  const std::string source = file.string();
  const auto lines = parse_script({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, source);
  if (!lines) return lines.fault();
  ScriptPlayer player(editor, file.parent_path());
  for (const ScriptLine& line : *lines) {
    (void)editor.take_frame_times_ms();
    const Status done = player.play(line.step, source + ":" + std::to_string(line.number));
    if (!done) return done;
    if (line.timed) {
      std::printf("%d: ", line.number);
      print_times(editor.take_frame_times_ms());
    }
    if (editor.session().wants_to_quit()) break;
  }
  return {};
}

}  // namespace focalstage
