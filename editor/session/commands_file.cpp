#include <filesystem>
#include <memory>
#include <utility>

#include "core/scene/fields_image.h"
#include "editor/session/command_list.h"
#include "editor/session/edits.h"
#include "io/assets/image_plane.h"

namespace focalstage {
namespace {

namespace fs = std::filesystem;

void open_or_say(Session::State& state, Result<Document> opened) {
  if (!opened) {
    state.say(LogLine::Kind::fault, describe(opened.fault()));
    return;
  }
  state.take(std::move(*opened));
}

/// args: from, the sample's name; "" or none: a bare room
Status make_new(Session& session, const Value& args) {
  auto& state = SessionAccess::of(session);
  const std::string from = text_or(args, "from", "");
  state.leave_then([&state, from] {
    state.close_document();
    open_or_say(state, Document::from_sample(from, state.folders));
  });
  return {};
}

/// args: path. Without one the window asks for it.
Status open(Session& session, const Value& args) {
  auto& state = SessionAccess::of(session);
  const auto path = text_arg(args, "path");
  if (!path) {
    state.file_wish = FileWish::open;
    return {};
  }
  // Looked at before the project that is open goes: what cannot be opened costs nothing.
  auto opened = Document::open(*path, state.folders);
  if (!opened) return opened.fault();
  const auto waiting = std::make_shared<Document>(std::move(*opened));
  state.leave_then([&state, waiting] {
    state.close_document();
    state.take(std::move(*waiting));
  });
  return {};
}

/// args: index, of what was left behind
Status recover(Session& session, const Value& args) {
  auto& state = SessionAccess::of(session);
  const auto index = static_cast<std::size_t>(number_or(args, "index", 0.0));
  if (index >= state.left_behind.size()) return Fault{"command.argument", "index", "there is no such recovery", ""};
  const Recovery recovery = state.left_behind[index];
  state.leave_then([&state, recovery] {
    state.close_document();
    open_or_say(state, Document::recover(recovery, state.folders));
  });
  return {};
}

/// args: index
Status forget_left(Session& session, const Value& args) {
  auto& state = SessionAccess::of(session);
  const auto index = static_cast<std::size_t>(number_or(args, "index", 0.0));
  if (index >= state.left_behind.size()) return Fault{"command.argument", "index", "there is no such recovery", ""};
  forget(state.left_behind[index]);
  state.left_behind = recoveries(state.folders, state.recent);
  return {};
}

Status save(Session& session, const Value&) {
  auto& state = SessionAccess::of(session);
  if (state.document->untitled()) {
    state.file_wish = FileWish::save_as;
    return {};
  }
  if (Status saved = state.document->save(); !saved) return saved;
  state.say(LogLine::Kind::good, "Saved " + state.document->file().string());
  return {};
}

/// args: path, a folder or a *.focal. Without one the window asks for it.
Status save_as(Session& session, const Value& args) {
  auto& state = SessionAccess::of(session);
  const auto path = text_arg(args, "path");
  if (!path) {
    state.file_wish = FileWish::save_as;
    return {};
  }
  state.file_wish = FileWish::none;
  if (Status saved = state.document->save_as(*path); !saved) return saved;
  state.recent = recent_projects(state.folders);
  state.say(LogLine::Kind::good, "Saved " + state.document->file().string());
  if (const auto next = std::exchange(state.after_save, nullptr)) next();
  return {};
}

Status close(Session& session, const Value&) {
  auto& state = SessionAccess::of(session);
  state.leave_then([&state] { state.close_document(); });
  return {};
}

Status quit(Session& session, const Value&) {
  auto& state = SessionAccess::of(session);
  state.leave_then([&state] {
    state.close_document();
    state.quitting = true;
  });
  return {};
}

/// How wide an imported picture stands in the room at first.
constexpr double picture_width_m = 0.2;

/// A new object where the room's camera looks, with the mesh of `reference`; or that mesh for a thing there is.
void add_imported(Session::State& state, const std::string& reference, const Thing& replaced, double scale) {
  Value mesh;
  mesh.set("file", reference);
  if (!replaced.name.empty()) {
    (void)state.apply("Replace mesh of " + replaced.name, {set_edit(replaced, "mesh", mesh)});
    return;
  }
  Value item;
  item.set("mesh", mesh);
  item.set("position_m", value_of(state.view.camera.target_m));
  item.set("rotation_xyzw", value_of(glm::dquat(1.0, 0.0, 0.0, 0.0)));
  item.set("scale", scale);
  const std::string name = free_name(state.project(), "objects", fs::path(reference).stem().string());
  if (state.apply("Import " + name, {add_edit("objects", name, item)})) state.selection.things = {{"objects", name}};
}

/// A picture, or the sequence it belongs to, as the look of an object.
void import_look(Session::State& state, const fs::path& file, const std::string& object) {
  const double rate_hz = state.project().frames.rate_hz;
  state.jobs.start(
      "Import " + file.filename().string(),
      [&state, file, object, rate_hz, folder = state.document->folder()](const Jobs::Progress&, std::stop_token) {
        auto look = std::make_shared<Result<ImageAppearance>>(bring_in_look(file, folder, rate_hz));
        return [&state, look, object, folder] {
          if (!state.document || state.document->folder() != folder) return;
          if (!*look) {
            state.say(LogLine::Kind::fault, "Nothing was imported. " + describe(look->fault()));
            return;
          }
          Value appearance;
          appearance.set("image", Codec<ImageAppearance>::write(**look));
          (void)state.apply("Picture on " + object, {set_edit({"objects", object}, "appearance", appearance)});
        };
      });
}

Thing replaced_by(const Value& args) { return {text_or(args, "list", "objects"), text_or(args, "replace", "")}; }

/// args: path (none: it is asked for); look: the object that a picture is to be laid on; replace: the thing whose mesh
/// it becomes, of the list `list` (none: objects)
Status import(Session& session, const Value& args) {
  auto& state = SessionAccess::of(session);
  const auto path = text_arg(args, "path");
  if (!path) {
    state.file_wish = FileWish::import_mesh;
    state.import_replaces = replaced_by(args);
    state.import_look_of = text_or(args, "look", "");
    return {};
  }
  const std::string look_of = text_or(args, "look", std::exchange(state.import_look_of, {}));
  const Thing asked_for = std::exchange(state.import_replaces, Thing{});
  const fs::path file(*path);
  if (file.extension() == ".focal" || fs::is_directory(file)) return open(session, args);
  if (!state.document) return Fault{"session.nothing-open", file.string(), "no project is open", "open one first"};
  if (!look_of.empty()) {
    import_look(state, file, look_of);
    return {};
  }
  const Thing replaced = args.find("replace") ? replaced_by(args) : asked_for;
  state.jobs.start("Import " + file.filename().string(),
                   [&state, file, replaced, folder = state.document->folder()](const Jobs::Progress&, std::stop_token) {
                     auto brought = std::make_shared<Result<std::string>>(bring_in(file, folder));
                     return [&state, brought, replaced, folder, file] {
                       if (!state.document || state.document->folder() != folder) return;
                       if (!*brought) {
                         state.say(LogLine::Kind::fault, "Nothing was imported. " + describe(brought->fault()));
                         return;
                       }
                       add_imported(state, **brought, replaced, is_picture(file) ? picture_width_m : 1.0);
                     };
                   });
  return {};
}

}  // namespace

void add_file_commands(CommandList& list) {
  list.push_back(
      {"file.new", "New project", "Ctrl+N", "Start from a bare room or a sample", "file", true, always, make_new});
  list.push_back({"file.open", "Open...", "Ctrl+O", "Open a project", "folder", true, always, open});
  list.push_back({"file.recover", "Recover", "", "Bring back what a crash left", "undo", false, always, recover});
  list.push_back({"file.forget", "Forget", "", "Give up what a crash left", "delete", false, always, forget_left});
  list.push_back({"file.save", "Save", "Ctrl+S", "Write the project to its file", "save", true, needs_project, save});
  list.push_back({"file.save-as", "Save As...", "Ctrl+Shift+S", "Write the project and all its files into a folder",
                  "save", true, needs_project, save_as});
  list.push_back({"file.import", "Import...", "Ctrl+I", "Bring a mesh into the project; it becomes an object", "import",
                  true, always, import});
  list.push_back(
      {"file.close", "Close project", "Ctrl+W", "Back to the start screen", "close", true, needs_project, close});
  list.push_back({"app.quit", "Quit", "Ctrl+Q", "Leave; unsaved edits are asked about", "", true, always, quit});
}

}  // namespace focalstage
