#include "editor/session/edit_words.h"

#include <doctest/doctest.h>

using namespace focalstage;

namespace {

Project three_slices() {
  Project project;
  project.slices.powers_d = {-1.0, 0.0, 1.0};
  return project;
}

Edit set(const char* list, const char* name, const char* key, Value value) {
  return {Edit::Kind::set, list, name, key, std::move(value)};
}

Edit powers(std::initializer_list<double> powers_d) {
  Value::Array array;
  for (const double power_d : powers_d) array.emplace_back(power_d);
  return set("slices", "", "powers_d", Value(std::move(array)));
}

std::string said(const Edit& edit) { return edit_words(edit, three_slices()); }

}  // namespace

TEST_CASE("edits of the slices say what comes, goes or moves, not the whole list") {
  CHECK(said(powers({-1, 0, 0.6, 1})) == "Add a slice at 0.6 D");
  CHECK(said(powers({-1.5, -1, 0, 0.5, 1})) == "Add slices at -1.5 and 0.5 D");
  CHECK(said(powers({-1, 1})) == "Remove the slice at 0 D");
  CHECK(said(powers({0})) == "Remove slices at -1 and 1 D");
  CHECK(said(powers({-1, 0.25, 1})) == "Move the slice at 0 D to 0.25 D");
  CHECK(said(powers({1, 0, -1})) == "Put the slices into another order");
  CHECK(said(powers({-2, 0, 2, 3})) == "Set the slices to -2, 0, 2 and 3 D");
  // A power that stands twice in the list counts twice.
  CHECK(said(powers({-1, 0, 0, 1})) == "Add a slice at 0 D");
}

TEST_CASE("keys are said in words with their units") {
  CHECK(said(set("sweep", "", "max_power_d", 2.0)) == "Set highest power of the sweep to 2 D");
  CHECK(said(set("projectors", "main", "exposure_ms", 0.35)) == "Set exposure of main to 0.35 ms");
  CHECK(said(set("frames", "", "rate_hz", 30)) == "Set rate of the frames to 30 Hz");
  CHECK(said(set("surfaces", "wall", "illumination", 0.0)) == "Set light of wall to 0");
  CHECK(said(set("sweep", "", "waveform", "sine")) == "Set waveform of the sweep to sine");
  CHECK(said(set("objects", "box", "mesh/angle_deg", 45)) == "Set mesh angle of box to 45°");
  CHECK(said(set("objects", "box", "position_m", Value(Value::Array{0.1, 0.0, -0.5}))) ==
        "Set position of box to 0.1, 0, -0.5 m");
  CHECK(said(set("projectors", "main", "exposure_ms", {})) == "Clear exposure of main");
  CHECK(said(set("glasses", "", "lens_response", Value(Value::Object{{"left", 1}}))) ==
        "Change lens response of the glasses");
  CHECK(said(set("", "", "name", "Кролик")) == "Call the project Кролик");
}

TEST_CASE("depth and flags are said as what a person sees") {
  const auto depth = [](Value::Object object) { return set("objects", "rabbit", "depth", Value(std::move(object))); };
  CHECK(said(depth({{"mode", "placed"}})) == "Show rabbit in focus where it stands");
  CHECK(said(depth({{"mode", "fixed"}, {"vergence_d", 2.5}})) == "Show rabbit in focus at 2.5 D");
  CHECK(said(depth({{"mode", "offset"}, {"vergence_d", 0.3}})) == "Shift the image depth of rabbit by +0.3 D");
  CHECK(said(depth({{"mode", "offset"}, {"vergence_d", -0.3}})) == "Shift the image depth of rabbit by -0.3 D");
  CHECK(said(depth({{"mode", "slice"}, {"index", 2}})) == "Pin rabbit to the slice at 1 D");
  CHECK(said(set("objects", "rabbit", "depth/index", 0)) == "Pin rabbit to the slice at -1 D");
  CHECK(said(set("objects", "rabbit", "depth/index", 7)) == "Pin rabbit to slice 8");
  CHECK(said(set("objects", "rabbit", "hidden", true)) == "Hide rabbit");
  CHECK(said(set("surfaces", "wall", "locked", false)) == "Unlock wall");
}

TEST_CASE("steps of a mesh's processing are said as what they do") {
  const auto step = [](const char* name) {
    return set("surfaces", "wall", "mesh/process/0", Value(Value::Object{{"step", name}}));
  };
  CHECK(said(step("fill-holes")) == "Fill the holes of wall");
  CHECK(said(step("fix-winding")) == "Fix the winding of wall");
  CHECK(said(step("decimate")) == "Decimate wall");
  CHECK(said(set("surfaces", "wall", "mesh/process/1", {})) == "Take step 2 from the mesh of wall");
  CHECK(said(set("surfaces", "wall", "mesh/process/1/rounds", 3)) == "Set rounds of step 2 of wall to 3");
  CHECK(said(set("surfaces", "wall", "mesh/process/1/error_mm", 0.5)) == "Set error of step 2 of wall to 0.5 mm");
}

TEST_CASE("what comes and goes is named") {
  const auto edit = [](Edit::Kind kind, Value value) {
    return Edit{kind, "objects", "兎 うさぎ", "", std::move(value)};
  };
  CHECK(said(edit(Edit::Kind::add, Value(Value::Object{}))) == "Add 兎 うさぎ");
  CHECK(said(edit(Edit::Kind::remove, {})) == "Remove 兎 うさぎ");
  CHECK(said(edit(Edit::Kind::rename, "b")) == "Rename 兎 うさぎ to b");
  CHECK(said(edit(Edit::Kind::move, 3)) == "Move 兎 うさぎ in the list");
  CHECK(said(edit(Edit::Kind::group, "g")) == "Put 兎 うさぎ into g");
  CHECK(said(edit(Edit::Kind::group, "")) == "Take 兎 うさぎ out of its group");
}

TEST_CASE("several edits are one sentence that does not grow without end") {
  const Project project = three_slices();
  const std::vector<Edit> two{set("sweep", "", "min_power_d", -2), set("sweep", "", "max_power_d", 2)};
  CHECK(edit_words(two, project) == "Set lowest power of the sweep to -2 D, set highest power of the sweep to 2 D");
  const std::vector<Edit> five(5, set("objects", "a", "hidden", true));
  CHECK(edit_words(five, project) == "Hide a, hide a, hide a and 2 more");
  CHECK(edit_words(std::vector<Edit>{}, project).empty());
}

TEST_CASE("places are said by what stands there") {
  Project project = three_slices();
  project.objects.resize(2);
  project.objects[1].name = "rabbit";
  CHECK(place_words("/slices/powers_d/2", project) == "Slice at 1 D");
  CHECK(place_words("/slices/powers_d/3", project) == "Slices");
  CHECK(place_words("/objects/1/depth/vergence_d", project) == "rabbit");
  CHECK(place_words("/sweep/frequency_hz", project) == "Sweep");
  CHECK(place_words("", project) == "Project");
  CHECK(place_words("/objects/7", project) == "Project");
}
