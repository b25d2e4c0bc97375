#include "editor/window/app/editor_program.h"

#include <CLI/CLI.hpp>
#include <cstdio>

#include "editor/document/folders.h"
#include "editor/window/app/editor.h"
#include "editor/window/app/monkey.h"
#include "editor/window/app/script_player.h"

namespace focalstage {
namespace {

enum Exit { done = 0, failed = 1, usage = 2, no_display = 4 };

struct Arguments {
  std::string project;
  std::string script;
  std::string size;
  double scale = 0.0;
  bool hidden = false;
  std::uint64_t monkey = 0;
  bool monkey_given = false;
  int events = 10000;
};

void report(const Fault& fault) { std::fprintf(stderr, "focalstage-editor: %s\n", describe(fault).c_str()); }

bool parse_size(const std::string& text, glm::ivec2& size_px) {
  int width = 0;
  int height = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) != 2) return false;
  if (width < 320 || height < 200 || width > 16384 || height > 16384) return false;
  size_px = {width, height};
  return true;
}

int play(Editor& editor, const Arguments& arguments) {
  if (!arguments.project.empty()) {
    Value args;
    args.set("path", arguments.project);
    const Status opened = editor.session().run("file.open", args);
    if (!opened) report(opened.fault());
    if (!opened && !arguments.script.empty()) return failed;
  }
  if (!arguments.script.empty()) {
    const Status played = play_script(editor, arguments.script);
    if (!played) report(played.fault());
    return played ? done : failed;
  }
  if (arguments.monkey_given) {
    play_monkey(editor, arguments.monkey, arguments.events);
    return done;
  }
  editor.run();
  return done;
}

int open_and_play(const Arguments& arguments) {
  EditorOptions options;
  const bool scripted = !arguments.script.empty() || arguments.monkey_given;
  if (!scripted) {  // what is scripted looks the same on every machine
    options.config = UserFolders::of_environment().config;
    options.remembered = load_window_config(options.config);
    options.space_mouse = true;
  }
  options.window.size_px = options.remembered.size_px;
  options.window.hidden = arguments.hidden;
  options.scale = scripted && arguments.scale == 0.0 ? 1.0 : arguments.scale;
  if (!arguments.size.empty() && !parse_size(arguments.size, options.window.size_px)) {
    std::fprintf(stderr, "focalstage-editor: --size %s is no size; write WIDTHxHEIGHT, such as 1600x900\n",
                 arguments.size.c_str());
    return usage;
  }
  auto window = GlfwWindow::open(options.window);
  if (!window) {
    report(window.fault());
    return no_display;
  }
  Editor editor(std::move(*window), options);
  return play(editor, arguments);
}

}  // namespace

int run_editor(int argc, char** argv) {
  CLI::App app("The editor of Focalstage: place, see, be told, push.", "focalstage-editor");
  Arguments arguments;
  app.add_option("PROJECT", arguments.project, "a NAME.focal or the folder that holds it")->type_name("");
  app.add_option("--script", arguments.script, "play this file of commands, hands and expectations, then end")
      ->type_name("FILE");
  app.add_option("--size", arguments.size, "of the window, in pixels")->type_name("WxH");
  app.add_option("--scale", arguments.scale, "of all that is drawn; the monitor's by default")
      ->check(CLI::Range(1.0, 3.0))
      ->type_name("S");
  app.add_flag("--hidden", arguments.hidden, "do not show the window");
  CLI::Option* monkey = app.add_option("--monkey", arguments.monkey, "random hands from this seed")->type_name("SEED");
  app.add_option("--events", arguments.events, "how many of them")->needs(monkey)->type_name("N");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    return app.exit(problem) == 0 ? done : usage;
  }
  arguments.monkey_given = monkey->count() > 0;
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // what a script prints is out before the next step, also into a pipe
  return open_and_play(arguments);
}

}  // namespace focalstage
