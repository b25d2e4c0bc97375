#include "core/scene/edit.h"

#include <doctest/doctest.h>

#include "core/scene/finding.h"
#include "core/scene/project_value.h"

using namespace focalstage;

namespace {

Project small_project() {
  Project project;
  project.projectors.push_back({});
  project.projectors[0].name = "main";
  project.slices.powers_d = {-1.0, 0.0, 1.0};
  for (const char* name : {"a", "b", "c"}) {
    project.objects.push_back({});
    project.objects.back().name = name;
  }
  REQUIRE_FALSE(fault_of(project));
  return project;
}

std::string order_of(const Project& project) {
  std::string order;
  for (const Object& object : project.objects) order += object.name;
  return order;
}

Edit on_objects(Edit::Kind kind, std::string name, Value value, std::string key = "") {
  return {kind, "objects", std::move(name), std::move(key), std::move(value)};
}

std::string order_after(const Edit& edit) {
  const auto changed = apply(small_project(), edit);
  REQUIRE_MESSAGE(changed.ok(), (changed.ok() ? "" : describe(changed.fault())));
  return order_of(*changed);
}

Fault fault_after(const Edit& edit) {
  const Project before = small_project();
  const auto changed = apply(before, edit);
  REQUIRE_FALSE(changed.ok());
  CHECK_FALSE(changed.fault().remedy.empty());
  return changed.fault();
}

Value teapot(Value::Object more = {}) {
  more.emplace_back("mesh", Value(Value::Object{{"primitive", Value("teapot")}}));
  return Value(std::move(more));
}

}  // namespace

TEST_CASE("apply leaves the given project alone") {
  const Project before = small_project();
  const Project copy = before;
  const auto after = apply(before, on_objects(Edit::Kind::set, "b", Value(2), "scale"));
  REQUIRE(after.ok());
  CHECK(before == copy);
  CHECK(after->objects[1].scale == 2.0);
}

TEST_CASE("add: at the end, or before the item that key names; named once or twice alike") {
  CHECK(order_after(on_objects(Edit::Kind::add, "d", teapot())) == "abcd");
  CHECK(order_after(on_objects(Edit::Kind::add, "", teapot({{"name", Value("d")}}))) == "abcd");
  CHECK(order_after(on_objects(Edit::Kind::add, "d", teapot({{"name", Value("d")}}), "a")) == "dabc");
  CHECK(order_after(on_objects(Edit::Kind::add, "d", teapot(), "c")) == "abdc");
  CHECK(fault_after(on_objects(Edit::Kind::add, "b", teapot())).code == "edit.name");
  CHECK(fault_after(on_objects(Edit::Kind::add, "d", teapot({{"name", Value("e")}}))).code == "edit.name");
  CHECK(fault_after(on_objects(Edit::Kind::add, "d", teapot(), "nobody")).code == "edit.key");
  CHECK(fault_after(on_objects(Edit::Kind::add, "d", Value(3))).code == "edit.value");
  CHECK(fault_after(on_objects(Edit::Kind::add, "", teapot())).message.find("missing") != std::string::npos);
}

TEST_CASE("a light added without a name gets one") {
  const Edit add{Edit::Kind::add, "lights", "", "", Value(Value::Object{{"kind", Value("sky")}})};
  const auto changed = apply_all(small_project(), {add, add});
  REQUIRE(changed.ok());
  CHECK(changed->lights[0].name == "light 1");
  CHECK(changed->lights[1].name == "light 2");
}

TEST_CASE("remove, rename and move find the item by its name") {
  CHECK(order_after(on_objects(Edit::Kind::remove, "b", {})) == "ac");
  CHECK(order_after(on_objects(Edit::Kind::rename, "b", "x")) == "axc");
  CHECK(order_after(on_objects(Edit::Kind::rename, "b", "b")) == "abc");
  CHECK(order_after(on_objects(Edit::Kind::move, "a", Value(2))) == "bca");
  CHECK(order_after(on_objects(Edit::Kind::move, "c", Value(0))) == "cab");
  CHECK(order_after(on_objects(Edit::Kind::move, "b", Value(1))) == "abc");
  CHECK(fault_after(on_objects(Edit::Kind::remove, "x", {})).code == "edit.name");
  CHECK(fault_after(on_objects(Edit::Kind::rename, "b", "c")).code == "edit.name");
  CHECK(fault_after(on_objects(Edit::Kind::rename, "b", "")).code == "edit.value");
  CHECK(fault_after(on_objects(Edit::Kind::rename, "b", Value(1))).code == "edit.value");
  for (const double place : {-1.0, 3.0, 0.5}) {
    CHECK(fault_after(on_objects(Edit::Kind::move, "b", Value(place))).code == "edit.value");
  }
}

TEST_CASE("group: joins and leaves; only surfaces and objects have groups") {
  const auto joined = apply(small_project(), on_objects(Edit::Kind::group, "b", "g"));
  REQUIRE(joined.ok());
  CHECK(joined->objects[1].group == "g");
  const auto left = apply(*joined, on_objects(Edit::Kind::group, "b", ""));
  REQUIRE(left.ok());
  CHECK(*left == small_project());
  CHECK(fault_after({Edit::Kind::group, "projectors", "main", "", "g"}).code == "edit.list");
}

TEST_CASE("faults of edits name list, name and key") {
  const Fault value = fault_after(on_objects(Edit::Kind::set, "b", Value(-1), "scale"));
  CHECK(value.code == "edit.value");
  CHECK(value.where == "objects/b/scale");
  CHECK(fault_after(on_objects(Edit::Kind::set, "b", Value(1), "size")).where == "objects/b/size");
  CHECK(fault_after(on_objects(Edit::Kind::set, "b", Value(1), "")).code == "edit.key");
  CHECK(fault_after(on_objects(Edit::Kind::set, "b", "x", "name")).code == "edit.key");
  CHECK(fault_after(on_objects(Edit::Kind::set, "b", Value(1), "position_m/3/x")).code == "edit.key");
  CHECK(fault_after({Edit::Kind::set, "things", "b", "x", Value(1)}).code == "edit.list");
  CHECK(fault_after({Edit::Kind::set, "viewer", "b", "track", "x"}).code == "edit.kind");
  CHECK(fault_after({Edit::Kind::remove, "viewer", "", "", {}}).code == "edit.kind");
  CHECK(fault_after({Edit::Kind::add, "", "", "", teapot()}).code == "edit.kind");
  CHECK(fault_after({Edit::Kind::set, "", "", "viewer/interpupillary_mm", Value(0)}).where ==
        "project/viewer/interpupillary_mm");
}

TEST_CASE("what must hold between the parts holds after an edit") {
  CHECK(fault_after({Edit::Kind::remove, "projectors", "main", "", {}}).code == "edit.value");
  const Edit beyond{Edit::Kind::set, "slices", "", "powers_d/3", Value(70)};  // 1000 / 15 mm = 66.67 D
  CHECK(fault_after(beyond).message.find("/slices/powers_d/3") != std::string::npos);
  const Edit slice_2 =
      on_objects(Edit::Kind::set, "a", Value(Value::Object{{"mode", Value("slice")}, {"index", Value(2)}}), "depth");
  const auto uses_slice_2 = apply(small_project(), slice_2);
  REQUIRE(uses_slice_2.ok());
  CHECK_FALSE(apply(*uses_slice_2, {Edit::Kind::set, "slices", "", "powers_d/2", Value()}).ok());
}

TEST_CASE("a project that was amiss before can be edited, also towards being right") {
  Project amiss = small_project();
  amiss.objects[2].name = "b";
  REQUIRE(fault_of(amiss));
  CHECK(apply(amiss, {Edit::Kind::set, "viewer", "", "track", "head"}).ok());
  const auto mended = apply(amiss, on_objects(Edit::Kind::rename, "b", "d"));
  REQUIRE(mended.ok());
  CHECK(order_of(*mended) == "adb");
}

TEST_CASE("set reaches inside: members, items, and the place after the last item") {
  const auto changed = apply_all(
      small_project(), {on_objects(Edit::Kind::set, "a", Value(5), "position_m/1"),
                        {Edit::Kind::set, "slices", "", "powers_d/3", Value(0.5)},
                        {Edit::Kind::set, "slices", "", "powers_d/0", Value()},
                        on_objects(Edit::Kind::set, "a", Value(Value::Object{{"time_s", Value(1)}}), "keys/0")});
  REQUIRE_MESSAGE(changed.ok(), (changed.ok() ? "" : describe(changed.fault())));
  CHECK(changed->objects[0].placement.pose.position_m == glm::dvec3(0, 5, 0));
  CHECK(changed->slices.powers_d == std::vector<double>{0.0, 1.0, 0.5});
  CHECK(changed->objects[0].placement.keys[0].pose.position_m == glm::dvec3(0, 5, 0));
}

TEST_CASE("setting another shape or appearance takes the former one's parameters away") {
  const auto sphere = apply(small_project(), on_objects(Edit::Kind::set, "a", "sphere", "mesh/primitive"));
  REQUIRE(sphere.ok());
  CHECK(sphere->objects[0].mesh == MeshSource{SphereMesh{}, {}, {}});
  const auto file = apply(*sphere, on_objects(Edit::Kind::set, "a", "x.obj", "mesh/file"));
  REQUIRE(file.ok());
  CHECK(file->objects[0].mesh == MeshSource{FileMesh{"x.obj"}, {}, {}});
  const Value white(Value::Array{Value(1), Value(1), Value(1)});
  const Value two(Value::Array{Value(2), Value(2)});
  const auto unlit = apply(small_project(), on_objects(Edit::Kind::set, "a", white, "appearance/unlit"));
  REQUIRE(unlit.ok());
  const auto checker = apply(*unlit, on_objects(Edit::Kind::set, "a", two, "appearance/checker/squares"));
  REQUIRE(checker.ok());
  CHECK(std::get<CheckerAppearance>(checker->objects[0].appearance).squares == glm::ivec2(2, 2));
  const auto material = apply(*unlit, on_objects(Edit::Kind::set, "a", Value(), "appearance"));
  REQUIRE(material.ok());
  CHECK(*material == small_project());
}

TEST_CASE("setting one eye parts what stood for both") {
  const Value lens(Value::Array{Value(Value::Object{{"harmonic", Value(1)}, {"gain_d_per_a", Value(39)}})});
  const auto changed = apply(small_project(), {Edit::Kind::set, "glasses", "", "lens_response/left", lens});
  REQUIRE(changed.ok());
  CHECK(changed->glasses.lens_response.left.size() == 1);
  CHECK(changed->glasses.lens_response.right.empty());
}

TEST_CASE("apply_all is all or nothing") {
  const auto none =
      apply_all(small_project(), {on_objects(Edit::Kind::remove, "a", {}), on_objects(Edit::Kind::remove, "a", {})});
  REQUIRE_FALSE(none.ok());
  CHECK(none.fault().code == "edit.name");
  CHECK(*apply_all(small_project(), {}) == small_project());
}

TEST_CASE("edits and findings go to values, edits come back") {
  for (const Edit& edit :
       {on_objects(Edit::Kind::set, "a", Value(2), "scale"), on_objects(Edit::Kind::set, "a", Value(), "track"),
        on_objects(Edit::Kind::add, "d", teapot(), "a"), on_objects(Edit::Kind::remove, "a", {}),
        on_objects(Edit::Kind::rename, "a", "z"), on_objects(Edit::Kind::move, "a", Value(0)),
        on_objects(Edit::Kind::group, "a", "g"), Edit{Edit::Kind::set, "", "", "name", "x"}}) {
    const auto back = edit_from(value_from(edit));
    REQUIRE(back.ok());
    CHECK(*back == edit);
  }
  for (const Value& bad :
       {Value(3), Value(Value::Object{}), Value(Value::Object{{"edit", Value("paint")}}),
        Value(Value::Object{{"edit", Value(1)}}), Value(Value::Object{{"edit", Value("set")}, {"list", Value(1)}}),
        Value(Value::Object{{"edit", Value("set")}, {"lisst", Value("x")}})}) {
    const auto edit = edit_from(bad);
    REQUIRE_FALSE(edit.ok());
    CHECK(edit.fault().code == "edit.shape");
  }
  const Finding finding{Severity::warning, "slices.spacing",      "/slices/powers_d/1",
                        "far apart",       Amount{0.8, 0.6, "D"}, {on_objects(Edit::Kind::remove, "a", {})}};
  const Value written = value_from(finding);
  CHECK(*written.find("severity") == Value("warning"));
  CHECK(*written.find("amount")->find("limit") == Value(0.6));
  CHECK(*edit_from((*written.find("remedy")->array())[0]) == finding.remedy[0]);
  CHECK_FALSE(has_error({finding}));
  CHECK(has_error({finding, {Severity::error, "", "", "", std::nullopt, {}}}));
}
