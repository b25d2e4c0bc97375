#include "editor/document/document.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <fstream>

#include "core/mesh/measure.h"
#include "editor/document/recent.h"
#include "io/image/png.h"
#include "io/project/project_file.h"
#include "tests/support/temporary_folder.h"

using namespace focalstage;
namespace fs = std::filesystem;

namespace {

struct Folder : TemporaryFolder {
  UserFolders folders{path() / "state", path() / "config"};
};

Step pupils(double mm) { return {"Set pupils", {{Edit::Kind::set, "viewer", "", "interpupillary_mm", Value(mm)}}}; }

double pupils_of(const Document& document) { return document.project().viewer.interpupillary_mm; }

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

constexpr const char* triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

}  // namespace

TEST_CASE("a sample becomes a project of one's own: edited, saved elsewhere, opened again") {
  const Folder in;
  auto document = Document::from_sample("first-light", in.folders);
  REQUIRE(document.ok());
  CHECK(document->untitled());
  CHECK_FALSE(document->unsaved());
  CHECK(document->save().fault().code == "document.untitled");
  REQUIRE(document->apply(pupils(61)).ok());
  CHECK(document->unsaved());
  const fs::path first = document->folder();
  REQUIRE(document->save_as(in.path() / "my show").ok());
  CHECK(document->file() == in.path() / "my show" / "my show.focal");
  CHECK_FALSE(fs::exists(first));
  CHECK_FALSE(document->unsaved());
  REQUIRE(document->undo().ok());
  CHECK(document->unsaved());
  REQUIRE(document->redo().ok());
  CHECK_FALSE(document->unsaved());
  document->close();
  CHECK(recoveries(in.folders, recent_projects(in.folders)).empty());
  const auto again = Document::open(in.path() / "my show", in.folders);
  REQUIRE(again.ok());
  CHECK(pupils_of(*again) == 61);
  CHECK(recent_projects(in.folders) == std::vector<fs::path>{in.path() / "my show" / "my show.focal"});
}

TEST_CASE("after a crash the edits are offered in words, come back, and Undo reaches behind them") {
  const Folder in;
  {
    auto document = Document::from_sample("first-light", in.folders);
    REQUIRE(document->save_as(in.path() / "show").ok());
    REQUIRE(document->apply(pupils(61)).ok());
    REQUIRE(document->apply(pupils(62), Joining::continues_last).ok());
    REQUIRE(document->apply(pupils(64)).ok());
    REQUIRE(document->undo().ok());
  }  // gone without close: what a kill leaves
  const auto left = recoveries(in.folders, recent_projects(in.folders));
  REQUIRE(left.size() == 1);
  CHECK(left[0].words == std::vector<std::string>{"Set pupils"});
  auto back = Document::recover(left[0], in.folders);
  REQUIRE(back.ok());
  CHECK(pupils_of(*back) == 62);
  CHECK(back->unsaved());
  REQUIRE(back->redo().ok());
  CHECK(pupils_of(*back) == 64);
  REQUIRE(back->jump(0).ok());
  CHECK(pupils_of(*back) == 63);
  CHECK_FALSE(back->unsaved());
  CHECK(load_project(in.path() / "show")->project.viewer.interpupillary_mm == 63);
}

TEST_CASE("a crash twice loses nothing, and opening without recovering keeps the offer") {
  const Folder in;
  {
    auto document = Document::from_sample("first-light", in.folders);
    REQUIRE(document->save_as(in.path() / "show").ok());
    REQUIRE(document->apply(pupils(61)).ok());
  }
  {
    auto back = Document::recover(recoveries(in.folders, recent_projects(in.folders))[0], in.folders);
    REQUIRE(back.ok());
    REQUIRE(back->apply(pupils(62)).ok());
  }
  {
    auto opened = Document::open(in.path() / "show", in.folders);
    REQUIRE(opened.ok());
    CHECK(pupils_of(*opened) == 63);
    opened->close();
  }
  const auto left = recoveries(in.folders, recent_projects(in.folders));
  REQUIRE(left.size() == 1);
  CHECK(left[0].words.size() == 2);
  const auto back = Document::recover(left[0], in.folders);
  REQUIRE(back.ok());
  CHECK(pupils_of(*back) == 62);
}

TEST_CASE("a project that was never saved is recovered too, and forgotten for good") {
  const Folder in;
  { REQUIRE(Document::from_sample("", in.folders)->apply(pupils(60)).ok()); }
  const auto left = recoveries(in.folders, {});
  REQUIRE(left.size() == 1);
  CHECK(left[0].untitled);
  forget(left[0]);
  CHECK(recoveries(in.folders, {}).empty());
  CHECK(fs::is_empty(in.folders.state / "unsaved"));
}

TEST_CASE("two editors do not write one journal") {
  const Folder in;
  auto document = Document::from_sample("first-light", in.folders);
  REQUIRE(document->save_as(in.path() / "show").ok());
  CHECK(Document::open(in.path() / "show", in.folders).fault().code == "journal.held");
}

TEST_CASE("imported files travel with the project, and a broken one changes nothing") {
  const Folder in;
  write(in.path() / "away" / "three.obj", triangle);
  write(in.path() / "away" / "broken.obj", "v 0 0 0\nf 1 2 3\n");
  auto document = Document::from_sample("", in.folders);
  REQUIRE(document.ok());
  const auto reference = bring_in(in.path() / "away" / "three.obj", document->folder());
  REQUIRE(reference.ok());
  CHECK(*reference == "assets/three.obj");
  CHECK(*bring_in(in.path() / "away" / "three.obj", document->folder()) == "assets/three.obj");
  write(in.path() / "other" / "three.obj", std::string(triangle) + "# another\n");
  CHECK(*bring_in(in.path() / "other" / "three.obj", document->folder()) == "assets/three-2.obj");
  const auto broken = bring_in(in.path() / "away" / "broken.obj", document->folder());
  REQUIRE_FALSE(broken.ok());
  CHECK(broken.fault().where.find("broken.obj") != std::string::npos);
  CHECK_FALSE(fs::exists(document->folder() / "assets" / "broken.obj"));

  Value item;
  item.set("mesh", Value(Value::Object{{"file", *reference}}));
  item.set("position_m", Value(Value::Array{0.0, 0.0, -0.5}));
  item.set("rotation_xyzw", Value(Value::Array{0.0, 0.0, 0.0, 1.0}));
  const Status added = document->apply({"Add three", {{Edit::Kind::add, "objects", "three", "", item}}});
  REQUIRE_MESSAGE(added.ok(), (added.ok() ? "" : describe(added.fault())));
  CHECK(document->shelf().fetch(document->project()));
  CHECK(document->shelf().wanted(document->project()).empty());
  REQUIRE(document->shelf().assets().models.contains("assets/three.obj"));
  write(document->folder() / "models" / "bench.json", "{}");
  REQUIRE(document->save_as(in.path() / "show").ok());
  CHECK(fs::exists(in.path() / "show" / "assets" / "three.obj"));
  CHECK(fs::exists(in.path() / "show" / "models" / "bench.json"));
  document->shelf().fetch(document->project());
  CHECK(document->shelf().findings(document->project()).empty());
  fs::remove(in.path() / "show" / "assets" / "three.obj");
  CHECK(document->shelf().wanted(document->project()).size() == 1);
  document->shelf().fetch(document->project());
  const auto findings = document->shelf().findings(document->project());
  REQUIRE(findings.size() == 1);
  CHECK(findings[0].code == "asset.missing");
  CHECK(findings[0].where == "/objects/0/mesh/file");
}

TEST_CASE("a picture becomes a plane of its shape that shows its colours") {
  const Folder in;
  const std::vector<std::uint8_t> codes{255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255,
                                        0,   0, 0, 9, 9,   9, 1, 2, 3,   4,   5,   6};
  REQUIRE(write_png(in.path() / "flag.PNG", 4, 2, 3, codes).ok());
  auto document = Document::from_sample("", in.folders);
  REQUIRE(document.ok());
  const auto reference = bring_in(in.path() / "flag.PNG", document->folder());
  REQUIRE_MESSAGE(reference.ok(), (reference.ok() ? "" : describe(reference.fault())));
  CHECK(*reference == "assets/flag.glb");
  const auto read = AssetShelf::read(document->folder(), {AssetReference{*reference}});
  document->shelf().put(read);
  const auto& model = document->shelf().assets().models.at(*reference);
  const Bounds bounds = mesh_bounds(*model->nodes[0].parts[0].mesh);
  CHECK(bounds.size_m().x == doctest::Approx(1.0));
  CHECK(bounds.size_m().y == doctest::Approx(0.5));
  REQUIRE(model->materials[0].texture);
  CHECK(model->materials[0].unlit);
  CHECK(model->materials[0].texture->width_px == 4);
  CHECK(model->materials[0].texture->rgba[4] == 0);
  CHECK(model->materials[0].texture->rgba[5] == 255);
  write(in.path() / "broken.png", "not a picture");
  CHECK_FALSE(bring_in(in.path() / "broken.png", document->folder()).ok());
}

TEST_CASE("a file changed by others is noticed, and taken as one step of undo") {
  const Folder in;
  auto document = Document::from_sample("first-light", in.folders);
  REQUIRE(document->save_as(in.path() / "show").ok());
  CHECK_FALSE(document->changed_outside());
  Project theirs = document->project();
  theirs.viewer.interpupillary_mm = 58;
  theirs.objects.pop_back();
  REQUIRE(save_project(theirs, document->file()).ok());
  CHECK(document->changed_outside());
  REQUIRE(document->reload().ok());
  CHECK(document->project() == theirs);
  CHECK_FALSE(document->changed_outside());
  CHECK_FALSE(document->unsaved());
  REQUIRE(document->undo().ok());
  CHECK(pupils_of(*document) == 63);
  theirs.viewer.interpupillary_mm = 57;
  REQUIRE(save_project(theirs, document->file()).ok());
  document->keep_ours();
  CHECK_FALSE(document->changed_outside());
  CHECK(document->unsaved());
}
