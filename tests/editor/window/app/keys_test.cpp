#include "editor/window/app/keys.h"

#include <doctest/doctest.h>

#include <map>
#include <string>
#include <tuple>

#include "editor/session/command.h"

using namespace focalstage;

TEST_CASE("a chord is read in any order of what is held") {
  // GLFW: letters are their capitals in ASCII; Enter 257, F1 290, Delete 261.
  CHECK(chord_named("Ctrl+Shift+S") == KeyChord{'S', true, true, false});
  CHECK(chord_named("Shift+Ctrl+s") == KeyChord{'S', true, true, false});
  CHECK(chord_named("F12") == KeyChord{301, false, false, false});
  CHECK(chord_named("Delete") == KeyChord{261, false, false, false});
  CHECK(chord_named("Ctrl+Return") == KeyChord{257, true, false, false});
  CHECK(chord_named("Ctrl++") == KeyChord{61, true, false, false});
  CHECK(chord_named("7") == KeyChord{'7', false, false, false});
}

TEST_CASE("what names no key is none") {
  for (const char* text : {"", "Ctrl+", "Hyper+S", "F0", "F13", "F1x", "Sh", "é"}) {
    CAPTURE(text);
    CHECK_FALSE(chord_named(text).has_value());
  }
}

TEST_CASE("every command's shortcut is a chord, and no two share one") {
  std::map<std::tuple<int, bool, bool, bool>, std::string> taken;
  for (const Command& command : commands()) {
    if (command.shortcut.empty()) continue;
    CAPTURE(std::string(command.id));
    const auto chord = chord_named(command.shortcut);
    REQUIRE(chord.has_value());
    const auto [place, fresh] =
        taken.try_emplace({chord->key, chord->ctrl, chord->shift, chord->alt}, std::string(command.id));
    CAPTURE(place->second);
    CHECK(fresh);
  }
}
