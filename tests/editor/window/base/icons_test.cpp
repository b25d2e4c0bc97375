#include "editor/window/base/icons.h"

#include <doctest/doctest.h>

#include <string>

#include "editor/session/command.h"

using namespace focalstage;

TEST_CASE("every command's icon is in the table") {
  for (const Command& command : commands()) {
    if (command.icon.empty()) continue;
    CAPTURE(std::string(command.id));
    CAPTURE(std::string(command.icon));
    CHECK(has_icon(command.icon));
  }
}

TEST_CASE("an unknown icon is seen, an empty name shows nothing") {
  CHECK(icon("").empty());
  CHECK_FALSE(has_icon("no-such-thing"));
  CHECK_FALSE(icon("no-such-thing").empty());
  // Fork Awesome's undo is U+F0E2.
  CHECK(icon("undo") == "\xef\x83\xa2");
}
