#include "editor/window/app/script.h"

#include <doctest/doctest.h>

using namespace focalstage;

namespace {

template <class Step>
Step step(const char* line) {
  const auto parsed = parse_script_step(line, "here:1");
  REQUIRE_MESSAGE(parsed.ok(), line);
  REQUIRE_MESSAGE(std::holds_alternative<Step>(*parsed), line);
  return std::get<Step>(*parsed);
}

}  // namespace

TEST_CASE("commands and edits carry JSON") {
  const auto run = step<RunCommand>("run file.open {\"path\": \"a b.focal\"}");
  CHECK(run.command == "file.open");
  CHECK(*run.args.find("path")->text() == "a b.focal");
  CHECK(step<RunCommand>("run edit.undo").args.is_null());
  CHECK(step<ApplyEdit>("edit [{\"edit\": \"set\"}]").edit.array() != nullptr);
}

TEST_CASE("places are widgets, shares of widgets, or pixels") {
  const auto named = step<ScriptClick>("click \"outline/rabbit near\" right ctrl");
  CHECK(named.place.name == "outline/rabbit near");
  CHECK(named.place.at == glm::vec2(0.5f));
  CHECK(named.button == 1);
  CHECK(named.ctrl);
  const auto shared = step<MovePointer>("move pane/room 0.25 0.75");
  CHECK(shared.place.name == "pane/room");
  CHECK(shared.place.at == glm::vec2(0.25f, 0.75f));
  const auto pixels = step<ScriptClick>("click 10 20 double");
  CHECK(pixels.place.name.empty());
  CHECK(pixels.place.at == glm::vec2(10.0f, 20.0f));
  CHECK(pixels.times == 2);
}

TEST_CASE("a drag has two places, steps and what is held") {
  const auto drag = step<DragPointer>("drag pane/room 0.5 0.5 -> 30 40 steps 20 middle shift");
  CHECK(drag.from.place.name == "pane/room");
  CHECK(drag.to.at == glm::vec2(30.0f, 40.0f));
  CHECK(drag.steps == 20);
  CHECK(drag.from.button == 2);
  CHECK(drag.from.shift);
}

TEST_CASE("a button is held where the pointer is, or goes there first") {
  CHECK_FALSE(step<HoldButton>("press").place.has_value());
  CHECK(step<HoldButton>("press right").button == 1);
  const auto placed = step<HoldButton>("press pane/room 0.1 0.2 middle");
  REQUIRE(placed.place.has_value());
  CHECK(placed.place->at == glm::vec2(0.1f, 0.2f));
  CHECK(placed.button == 2);
  CHECK_FALSE(step<HoldButton>("release").down);
}

TEST_CASE("an expectation's value is JSON with blanks, its tolerance apart") {
  const auto text = step<ExpectValue>("expect /project/name \"within a room\"");
  CHECK(*text.value.text() == "within a room");
  CHECK(text.tolerance == 0.0);
  const auto number = step<ExpectValue>("expect /a [1, 2] within 0.5");
  CHECK(number.value.array()->size() == 2);
  CHECK(number.tolerance == 0.5);
}

TEST_CASE("colours, waits, keys and text") {
  const auto colour = step<ExpectColour>("expect-color pane/eye 0.1 0.9 #1b2d21 within 3");
  CHECK(colour.rgb == glm::ivec3(0x1b, 0x2d, 0x21));
  CHECK(colour.tolerance == 3);
  CHECK(step<WaitFor>("wait rig playing within 5").seconds == 5.0);
  CHECK(step<WaitFor>("wait seconds 0.5").what == WaitFor::What::seconds);
  CHECK(step<PressKey>("key Ctrl+Shift+S").chord.shift);
  CHECK(step<TypeText>("type two words").text == "two words");
  CHECK(step<TypeText>("type \" quoted \\\" \"").text == " quoted \" ");
}

TEST_CASE("a line that is wrong names itself and says how it should read") {
  for (const char* line : {"dance",           "run",         "click",       "click 10",
                           "drag a b",        "drag a -> ",  "key Hyper+S", "wait moon",
                           "wait rig",        "size 10",     "size -1 5",   "scale 9",
                           "expect /a",       "expect /a {", "frames 0",    "expect-color a #12",
                           "scroll up",       "drop",        "edit 5",      "screenshot",
                           "click a sideways"}) {
    CAPTURE(line);
    const auto parsed = parse_script_step(line, "here:7");
    REQUIRE_FALSE(parsed.ok());
    CHECK(parsed.fault().where.starts_with("here:7"));
    CHECK_FALSE(parsed.fault().message.empty());
  }
}

TEST_CASE("a script is its lines but for blank ones and comments, each with its number") {
  const auto script = parse_script("# a comment\n\n  \nrun a\r\n  # another\nkey A", "s.script");
  REQUIRE(script.ok());
  REQUIRE(script->size() == 2);
  CHECK((*script)[0].number == 4);
  CHECK((*script)[1].number == 6);
  CHECK(std::get<RunCommand>((*script)[0].step).command == "a");
  const auto broken = parse_script("run a\nfly\n", "s.script");
  REQUIRE_FALSE(broken.ok());
  CHECK(broken.fault().where == "s.script:2");
}
