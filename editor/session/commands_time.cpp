#include <algorithm>
#include <utility>

#include "editor/session/command_list.h"
#include "editor/session/edits.h"

namespace focalstage {
namespace {

std::string needs_keyable(const Session& session) {
  if (!session.has_document()) return needs_project(session);
  const Thing* thing = session.selection().primary();
  return thing && placement_of(session.project(), thing) ? "" : "select a surface, an object or the viewer first";
}

/// args: frame
Status frame(Session& session, const Value& args) {
  const auto number = number_arg(args, "frame");
  if (!number) return number.fault();
  session.view().frame = static_cast<int>(std::clamp(*number, 0.0, session.project().frames.count - 1.0));
  return {};
}

Status step(Session& session, int by) {
  const int count = std::max(1, session.project().frames.count);
  session.view().frame = ((session.view().frame + by) % count + count) % count;
  return {};
}
Status next(Session& session, const Value&) { return step(session, 1); }
Status previous(Session& session, const Value&) { return step(session, -1); }
Status first(Session& session, const Value&) {
  session.view().frame = 0;
  return {};
}

Status play(Session& session, const Value&) {
  session.view().playing = !session.view().playing;
  return {};
}

/// The thing's keys with its present pose at the frame in view.
Status add_key(Session& session, const Value&) {
  const auto& state = SessionAccess::of(session);
  const Thing thing = *session.selection().primary();
  std::vector<Keyframe> keys = placement_of(session.project(), &thing)->keys;
  const double time_s = state.frame_time_s();
  const Rigid pose = pose_of(session.project(), thing, time_s);
  std::erase_if(keys, [&](const Keyframe& key) { return same_key(key.time_s, time_s); });
  const auto later = std::find_if(keys.begin(), keys.end(), [&](const Keyframe& key) { return key.time_s > time_s; });
  keys.insert(later, {time_s, pose, {}});
  return session.edit("Set a key of " + title_of(thing), {set_edit(thing, "keys", keys_value(keys))});
}

/// args: time_s, of the key; none: the one at the frame in view
Status delete_key(Session& session, const Value& args) {
  const auto& state = SessionAccess::of(session);
  const Thing thing = *session.selection().primary();
  std::vector<Keyframe> keys = placement_of(session.project(), &thing)->keys;
  const double time_s = number_or(args, "time_s", state.frame_time_s());
  if (std::erase_if(keys, [&](const Keyframe& key) { return same_key(key.time_s, time_s); }) == 0) {
    return Fault{"session.no-key", title_of(thing), "has no key at this moment", ""};
  }
  return session.edit("Delete a key of " + title_of(thing),
                      {set_edit(thing, "keys", keys.empty() ? Value() : keys_value(keys))});
}

/// args: from_s, to_s; dragging
Status move_key(Session& session, const Value& args) {
  const auto from_s = number_arg(args, "from_s"), to_s = number_arg(args, "to_s");
  if (!from_s || !to_s) return from_s ? to_s.fault() : from_s.fault();
  const Thing thing = *session.selection().primary();
  std::vector<Keyframe> keys = placement_of(session.project(), &thing)->keys;
  const auto at =
      std::find_if(keys.begin(), keys.end(), [&](const Keyframe& key) { return same_key(key.time_s, *from_s); });
  if (at == keys.end()) return Fault{"session.no-key", title_of(thing), "has no key at this moment", ""};
  at->time_s = std::max(0.0, *to_s);
  std::stable_sort(keys.begin(), keys.end(), [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
  std::vector<Edit> edits{set_edit(thing, "keys", keys_value(keys))};
  const std::string words = "Move a key of " + title_of(thing);
  return flag_or(args, "dragging", false) ? session.drag(words, std::move(edits))
                                          : session.edit(words, std::move(edits));
}

Status set_cues(Session& session, const std::string& words, const std::vector<Cue>& cues) {
  Value::Array array;
  for (const Cue& cue : cues) {
    Value item;
    item.set("name", cue.name);
    item.set("time_s", cue.time_s);
    for (const auto& [key, kept] : cue.unknown) item.set(key, kept);
    array.push_back(std::move(item));
  }
  return session.edit(words, {{Edit::Kind::set, "", "", "cues", Value(std::move(array))}});
}

/// args: name; time_s, else the frame in view
Status add_cue(Session& session, const Value& args) {
  std::vector<Cue> cues = session.project().cues;
  std::string name = text_or(args, "name", "cue");
  const auto taken = [&] {
    return std::any_of(cues.begin(), cues.end(), [&](const Cue& cue) { return cue.name == name; });
  };
  for (int k = 2; taken(); ++k) name = text_or(args, "name", "cue") + " " + std::to_string(k);
  cues.push_back({name, number_or(args, "time_s", SessionAccess::of(session).frame_time_s()), {}});
  std::stable_sort(cues.begin(), cues.end(), [](const Cue& a, const Cue& b) { return a.time_s < b.time_s; });
  return set_cues(session, "Add cue " + name, cues);
}

/// args: name
Status delete_cue(Session& session, const Value& args) {
  const auto name = text_arg(args, "name");
  if (!name) return name.fault();
  std::vector<Cue> cues = session.project().cues;
  if (std::erase_if(cues, [&](const Cue& cue) { return cue.name == *name; }) == 0) {
    return Fault{"command.argument", *name, "there is no such cue", ""};
  }
  return set_cues(session, "Delete cue " + *name, cues);
}

}  // namespace

void add_time_commands(CommandList& list) {
  const auto add = [&](Command command) { list.push_back(command); };
  add({"time.play", "Play or pause", "Space", "Play the frames in the editor", "play", true, needs_project, play});
  add({"time.frame", "Go to a frame", "", "", "", false, needs_project, frame});
  add({"time.next", "Next frame", "Right", "One frame on", "next", true, needs_project, next});
  add({"time.previous", "Previous frame", "Left", "One frame back", "previous", true, needs_project, previous});
  add({"time.first", "First frame", "Home", "Back to the beginning", "first", true, needs_project, first});
  add({"key.add", "Set a key", "K", "The selected thing stands here at this moment", "key", true, needs_keyable,
       add_key});
  add({"key.delete", "Delete the key", "Shift+K", "The key at this moment goes", "", true, needs_keyable, delete_key});
  add({"key.move", "Move a key", "", "", "", false, needs_keyable, move_key});
  add({"cue.add", "Add a cue", "M", "A name for this moment, to be called from outside", "cue", true, needs_project,
       add_cue});
  add({"cue.delete", "Delete a cue", "", "", "", false, needs_project, delete_cue});
}

}  // namespace focalstage
