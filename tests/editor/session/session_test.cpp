#include "editor/session/session.h"

#include <doctest/doctest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <set>
#include <thread>

#include <glm/geometric.hpp>

#include "editor/session/edits.h"
#include "io/files/files.h"
#include "io/image/png.h"
#include "io/project/project_file.h"
#include "tests/support/temporary_folder.h"

using namespace focalstage;
namespace fs = std::filesystem;

namespace {

/// A home of its own, so that no test meets another's state.
struct Home : TemporaryFolder {
  Home() {
    setenv("XDG_STATE_HOME", (path() / "state").c_str(), 1);
    setenv("XDG_CONFIG_HOME", (path() / "config").c_str(), 1);
  }
};

double now_s() {
  static const auto begun = std::chrono::steady_clock::now();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
}

bool wait(Session& session, const std::function<bool()>& until, double patience_s = 20.0) {
  const double end_s = now_s() + patience_s;
  while (now_s() < end_s) {
    session.update(now_s());
    if (until()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

bool wait_compiled(Session& session) {
  return wait(session, [&] {
    const auto slices = session.slices();
    const auto checked = session.checked();
    return slices && slices->revision == session.revision() && slices->divisor == 1 && checked && checked->measured &&
           checked->revision == session.revision();
  });
}

Value args(Value::Object object) { return Value(std::move(object)); }

Value here(const Session& session, const std::string& key) {
  const Value state = session.described();
  const Value* found = state.find(key);
  return found ? *found : Value("no such key");
}

std::set<std::string> codes(const Session& session) {
  std::set<std::string> found;
  for (const Finding& finding : session.findings()) found.insert(finding.code);
  return found;
}

void kill_runtime_with(const std::string& store) {
  for (const auto& entry : fs::directory_iterator("/proc")) {
    std::ifstream in(entry.path() / "cmdline", std::ios::binary);
    const std::string line{std::istreambuf_iterator<char>(in), {}};
    if (line.starts_with('/') && line.find("focalstage-runtime") != std::string::npos &&
        line.find(store) != std::string::npos) {
      kill(std::atoi(entry.path().filename().c_str()), SIGKILL);
    }
  }
}

void open_sample(Session& session, const char* name) {
  REQUIRE(session.run("file.new", args({{"from", name}})).ok());
  REQUIRE(session.has_document());
}

}  // namespace

TEST_CASE("every command has a name, a title and a shortcut of its own") {
  std::set<std::string_view> ids, shortcuts;
  for (const Command& command : commands()) {
    CHECK(ids.insert(command.id).second);
    CHECK_FALSE(command.title.empty());
    CHECK((command.shortcut.empty() || shortcuts.insert(command.shortcut).second));
    CHECK((!command.in_palette || !command.help.empty() || command.id == "view.four"));
  }
  CHECK(ids.size() > 60);
}

TEST_CASE("without a project most commands say why they cannot be done, and none crashes") {
  const Home home;
  Session session([] {});
  for (const Command& command : commands()) {
    if (command.id == "app.quit" || command.id == "rig.simulate" || command.id == "rig.connect" ||
        command.id.starts_with("file.")) {
      continue;
    }
    const Status done = session.run(command.id);
    if (!done) CHECK_FALSE(describe(done.fault()).empty());
  }
  CHECK_FALSE(session.has_document());
  CHECK(session.run("no.such").fault().code == "command.unknown");
}

TEST_CASE("with a project every command takes no or wrong arguments without harm") {
  const Home home;
  Session session([] {});
  open_sample(session, "first-light");
  session.select({{"objects", "rabbit"}});
  const std::vector<Value> odd{
      Value(), args({{"index", -1.0}, {"place", -3.0}, {"frame", 1e300}, {"kind", "cube"}}),
      args({{"index", 1e18}, {"power_d", 1e9}, {"name", ""}, {"path", "/no/such"}, {"list", "x"}}),
      args({{"from_s", 0.0}, {"to_s", 1e9}, {"focus_d", 1e9}, {"pupil_mm", -4.0}})};
  for (const Command& command : commands()) {
    if (command.id == "app.quit" || command.id.starts_with("rig.")) continue;
    for (const Value& value : odd) {
      (void)session.run(command.id, value);
      if (session.question()) session.answer(99);
      if (!session.has_document()) open_sample(session, "first-light");
      session.forget_file_wish();
      session.update(now_s());
      REQUIRE(parse_project(project_text(session.project()), "session").ok());
    }
  }
}

TEST_CASE("what is edited is compiled, checked and seen") {
  const Home home;
  Session session([] {});
  open_sample(session, "first-light");
  REQUIRE(wait_compiled(session));
  CHECK(codes(session).empty());
  REQUIRE(
      wait(session, [&] { return session.eye_picture() && session.eye_picture()->revision == session.revision(); }));
  const auto& rgb = session.eye_picture()->rgb;
  CHECK(*std::max_element(rgb.begin(), rgb.end()) > 200);

  // The depth sheet pulled to 0.3 m: beyond what the slices reach.
  REQUIRE(
      session.edit("Depth", {set_edit({"objects", "rabbit"}, "depth", args({{"mode", "fixed"}, {"vergence_d", 4.0}}))})
          .ok());
  REQUIRE(wait_compiled(session));
  CHECK(codes(session).contains("depth.out-of-range"));
  REQUIRE(session.run("finding.remedy-first").ok());
  REQUIRE(wait_compiled(session));
  CHECK_FALSE(codes(session).contains("depth.out-of-range"));
  REQUIRE(session.run("edit.undo").ok());
  REQUIRE(wait_compiled(session));
  CHECK(codes(session).contains("depth.out-of-range"));
}

TEST_CASE("a rig that is off is seen, not compiled: a viewer who stands aside sees what a head moved aside does") {
  const Home home;
  Session session([] {});
  open_sample(session, "first-light");
  REQUIRE(wait_compiled(session));
  const auto picture = [&](bool off) {
    const auto before = session.eye_picture();
    REQUIRE(wait(session, [&] {
      const auto now = session.eye_picture();
      return now && now != before && now->revision == session.revision() && now->divisor == 1 && now->off == off;
    }));
    return session.eye_picture()->rgb;
  };
  REQUIRE(wait(session, [&] { return session.eye_picture() && session.eye_picture()->divisor == 1; }));
  const auto said = session.eye_picture()->rgb;
  const auto slices = session.slices()->images.codes;
  REQUIRE(session.run("eye.off-rig", args({{"what", "viewer along x"}, {"amount", 6.0}})).ok());
  const auto aside = picture(true);
  CHECK(aside != said);
  CHECK(session.slices()->images.codes == slices);
  REQUIRE(session.run("eye.off-rig").ok());
  CHECK(picture(false) == said);
  REQUIRE(session.run("eye.head", args({{"x_m", 0.006}})).ok());
  const auto head_aside = picture(false);
  REQUIRE(head_aside.size() == aside.size());
  int most = 0;
  for (std::size_t i = 0; i < aside.size(); ++i) most = std::max(most, std::abs(int{head_aside[i]} - int{aside[i]}));
  CHECK(most <= 1);
  REQUIRE(session.run("eye.head").ok());
  REQUIRE(session.run("eye.off-rig", args({{"what", "lens power"}, {"amount", 0.3}})).ok());
  CHECK(picture(true) != said);
  CHECK_FALSE(session.run("eye.off-rig", args({{"what", "weather"}, {"amount", 1.0}})).ok());
}

TEST_CASE("a drag is one step, and shows slices meanwhile") {
  const Home home;
  Session session([] {});
  open_sample(session, "first-light");
  REQUIRE(wait_compiled(session));
  const Project before = session.project();
  const Thing rabbit{"objects", "rabbit"};
  for (int i = 1; i <= 20; ++i) {
    Rigid pose = pose_of(before, rabbit, 0.0);
    pose.position_m.x += 0.002 * i;
    REQUIRE(session.drag("Move rabbit", {set_edit(rabbit, "position_m", value_of(pose.position_m))}).ok());
    REQUIRE(wait(session, [&] { return session.slices() && session.slices()->revision == session.revision(); }));
  }
  session.end_drag();
  REQUIRE(wait_compiled(session));
  CHECK(session.document().history().place() == 1);
  REQUIRE(session.run("edit.undo").ok());
  CHECK(session.project() == before);
}

TEST_CASE("copies, groups, hides and locks; undo takes all of it back") {
  const Home home;
  Session session([] {});
  open_sample(session, "first-light");
  const Project before = session.project();
  session.select({{"objects", "rabbit"}, {"objects", "teapot"}});
  REQUIRE(session.run("edit.duplicate").ok());
  CHECK(session.selection().things == std::vector<Thing>{{"objects", "rabbit 2"}, {"objects", "teapot 2"}});
  REQUIRE(session.run("edit.group", args({{"name", "pair"}})).ok());
  CHECK(object_named(session.project(), "teapot 2")->group == "pair");
  REQUIRE(session.run("edit.lock").ok());
  CHECK(session.run("edit.delete").fault().code == "session.locked");
  REQUIRE(session.run("edit.lock").ok());
  REQUIRE(session.run("edit.cut").ok());
  CHECK(session.project().objects.size() == 2);
  REQUIRE(session.run("edit.paste").ok());
  REQUIRE(session.run("edit.paste").ok());
  CHECK(session.project().objects.size() == 6);
  while (session.run("edit.undo").ok()) {
  }
  CHECK(session.project() == before);
  while (session.run("edit.redo").ok()) {
  }
  CHECK(session.project().objects.size() == 6);
}

TEST_CASE("things are aligned, put at one distance and dropped, each as one step") {
  const Home home;
  Session session([] {});
  open_sample(session, "first-light");
  session.update(now_s());
  session.select({{"objects", "rabbit"}});
  CHECK_FALSE(session.run("edit.align").ok());
  // The screen is upright: only what is above its upper edge could come to rest on it.
  CHECK(session.run("edit.drop").fault().code == "session.no-surface");
  REQUIRE(session.run("edit.drop-along-sight").ok());
  const Object& rabbit = *object_named(session.project(), "rabbit");
  CHECK(rabbit.placement.pose.position_m.z < -0.5);
  CHECK(rabbit.placement.pose.position_m.z > -0.6);
  REQUIRE(session.run("add.sphere").ok());
  session.select({{"objects", "sphere"}, {"objects", "rabbit"}});
  REQUIRE(session.run("edit.align", args({{"axis", "y"}, {"to", "low"}})).ok());
  REQUIRE(session.run("edit.same-distance").ok());
  const auto distance = [&](const char* name) {
    return glm::length(object_named(session.project(), name)->placement.pose.position_m);
  };
  CHECK(distance("sphere") == doctest::Approx(distance("rabbit")).epsilon(1e-9));
  CHECK(session.document().history().place() == 4);
  const double before = session.view().camera.distance_m;
  REQUIRE(session.run("view.zoom-selection").ok());
  CHECK(session.view().camera.distance_m < before);
}

TEST_CASE("shaping the sweep is one step, found behind the window, and undone") {
  const Home home;
  Session session([] {});
  open_sample(session, "step-teapot");
  const Project before = session.project();
  REQUIRE(session.run("sweep.shape").ok());
  CHECK(session.project() == before);  // not yet: nothing blocks the window
  REQUIRE(wait(session, [&] { return session.project().sweep.waveform.left.has_value(); }));
  CHECK(session.project().sweep.waveform.right.has_value());
  REQUIRE(wait_compiled(session));
  double worst_d = 0.0;
  for (const Slot& slot : session.checked()->schedule.schedule.slots) worst_d = std::max(worst_d, slot.smear_d);
  CHECK(worst_d < 0.2);  // the sine's: 0.278 D; the sample lists two harmonics
  REQUIRE(session.notice());
  CHECK(session.notice()->text.find("on the sine by 0.278 D") != std::string::npos);
  REQUIRE(session.run("edit.undo").ok());
  CHECK(session.project() == before);

  CHECK_FALSE(session.run("sweep.shape", args({{"max_harmonic", 0.0}})).ok());
  CHECK_FALSE(session.run("sweep.shape", args({{"max_harmonic", "all"}})).ok());
}

TEST_CASE("a sweep that was shaped for another project than the present one is not taken") {
  const Home home;
  Session session([] {});
  open_sample(session, "step-teapot");
  REQUIRE(session.run("sweep.shape").ok());
  REQUIRE(session.edit("Another slice", {{Edit::Kind::set, "slices", "", "powers_d", Value(Value::Array{-0.5, 0.25})}})
              .ok());
  REQUIRE(wait(session, [&] { return session.tasks().empty(); }));
  session.update(now_s());
  CHECK_FALSE(session.project().sweep.waveform.left);
}

TEST_CASE("closing with unsaved edits asks, and saving an untitled project asks for its place") {
  const Home home;
  Session session([] {});
  open_sample(session, "first-light");
  REQUIRE(session.run("add.rabbit").ok());
  REQUIRE(session.run("app.quit").ok());
  REQUIRE(session.question() != nullptr);
  session.answer(2);
  CHECK(session.has_document());
  CHECK_FALSE(session.wants_to_quit());
  REQUIRE(session.run("app.quit").ok());
  session.answer(0);
  CHECK(session.file_wish() == FileWish::save_as);
  REQUIRE(session.run("file.save-as", args({{"path", (home.path() / "mine").string()}})).ok());
  CHECK(session.wants_to_quit());
  CHECK(fs::exists(home.path() / "mine" / "mine.focal"));
}

TEST_CASE("a broken mesh is refused in words, and a good one becomes an object") {
  const Home home;
  std::ofstream(home.path() / "broken.obj") << "v 0 0 0\nf 1 2 3\n";
  std::ofstream(home.path() / "three.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  Session session([] {});
  open_sample(session, "first-light");
  const Project before = session.project();
  REQUIRE(session.run("file.import", args({{"path", (home.path() / "broken.obj").string()}})).ok());
  REQUIRE(wait(session, [&] { return session.notice() && session.notice()->kind == LogLine::Kind::fault; }));
  CHECK(session.notice()->text.find("broken.obj") != std::string::npos);
  CHECK(session.project() == before);
  REQUIRE(session.run("file.import", args({{"path", (home.path() / "three.obj").string()}})).ok());
  REQUIRE(wait(session, [&] { return session.project().objects.size() == 3; }));
  REQUIRE(wait_compiled(session));
  CHECK(session.stage()->objects.size() == 3);
}

TEST_CASE("a numbered picture laid on an object brings those that follow it, and plays on the clock") {
  const Home home;
  for (int k = 7; k < 10; ++k) {
    const std::vector<std::uint8_t> codes(4, static_cast<std::uint8_t>(20 * k));
    REQUIRE(write_png(home.path() / ("fire_00" + std::to_string(k) + ".png"), 2, 2, 1, codes).ok());
  }
  Session session([] {});
  open_sample(session, "first-light");
  const std::string name = session.project().objects[0].name;
  const auto lay = [&](const char* file) {
    return session.run("file.import", args({{"path", (home.path() / file).string()}, {"look", name}}));
  };
  REQUIRE(lay("fire_007.png").ok());
  const auto image = [&] { return std::get_if<ImageAppearance>(&session.project().objects[0].appearance); };
  REQUIRE(wait(session, [&] { return image() != nullptr; }));
  CHECK(image()->file == "assets/fire/fire_###.png");
  CHECK(image()->first == 7);
  CHECK(image()->count == 3);
  CHECK(image()->rate_hz == session.project().frames.rate_hz);
  const auto shown = [&]() -> std::shared_ptr<const Texture> {
    const auto& drawables = session.stage()->objects.at(0).drawables;
    return drawables.empty() ? nullptr : drawables[0].finish.texture;
  };
  REQUIRE(wait(session, [&] { return session.stage()->objects.at(0).name == name && shown() != nullptr; }));
  CHECK(shown()->rgba[0] == 140);
  REQUIRE(wait_compiled(session));
  REQUIRE(lay("fire_009.png").ok());  // none follows: one picture
  REQUIRE(wait(session, [&] { return image()->count == 0; }));
  CHECK(image()->file == "assets/fire_009.png");
  const Project before = session.project();
  REQUIRE(session.run("file.import", args({{"path", "/nonexistent/a.png"}, {"look", name}})).ok());
  REQUIRE(wait(session, [&] { return session.notice() && session.notice()->kind == LogLine::Kind::fault; }));
  CHECK(session.project() == before);
}

TEST_CASE("what a client should see is written as pictures") {
  const Home home;
  Session session([] {});
  open_sample(session, "first-light");
  REQUIRE(wait_compiled(session));
  const auto count = [&] {
    std::error_code none;
    return std::distance(fs::directory_iterator(home.path() / "out", none), fs::directory_iterator());
  };
  REQUIRE(session.run("export.stereo", args({{"path", (home.path() / "out").string()}})).ok());
  REQUIRE(wait(session, [&] { return count() == 4 && session.tasks().empty(); }));
  const auto bytes = read_file(home.path() / "out" / "stereo-side-by-side.png", 1u << 26);
  REQUIRE(bytes.ok());
  const auto both = decode_image(*bytes, "both");
  REQUIRE(both.ok());
  CHECK(both->width_px == 2560);
  REQUIRE(session.run("export.focal-pull", args({{"path", (home.path() / "out").string()}, {"frames", 3.0}})).ok());
  REQUIRE(wait(session, [&] { return count() >= 7 && session.tasks().empty(); }));
}

TEST_CASE("what cannot be opened costs nothing of what is open") {
  const Home home;
  Session session([] {});
  open_sample(session, "first-light");
  REQUIRE(session.run("add.rabbit").ok());
  CHECK_FALSE(session.run("file.open", args({{"path", (home.path() / "none.focal").string()}})).ok());
  CHECK(session.project().objects.size() == 3);
  CHECK(here(session, "question") == Value(""));
}

TEST_CASE("a project's models are the program's, the user's and its own; a broken file is told and costs no more") {
  const Home home;
  const auto model = [](const std::string& name) {
    return R"({"focalstage_projector_model": 1, "name": ")" + name +
           R"(", "width_px": 640, "height_px": 480, "depths": [{"bits": 8, "frames_per_second": 60}]})";
  };
  const auto write = [](const fs::path& file, const std::string& text) {
    fs::create_directories(file.parent_path());
    std::ofstream(file) << text;
  };
  Session session([] {});
  CHECK(session.models() == nullptr);
  write(home.path() / "config" / "focalstage" / "models" / "mine.json", model("mine"));
  open_sample(session, "first-light");
  REQUIRE(session.models());
  CHECK(find_model(*session.models(), "dynaflash") != nullptr);
  CHECK(find_model(*session.models(), "mine") != nullptr);
  CHECK(find_model(*session.models(), "its own") == nullptr);

  const fs::path folder = home.path() / "show";
  REQUIRE(session.run("file.save-as", args({{"path", folder.string()}})).ok());
  write(folder / "models" / "own.json", model("its own"));
  const auto open_again = [&] {
    REQUIRE(session.run("file.close").ok());
    const Status opened = session.run("file.open", args({{"path", folder.string()}}));
    REQUIRE_MESSAGE(opened.ok(), describe(opened.ok() ? Fault{} : opened.fault()));
  };
  open_again();
  CHECK(find_model(*session.models(), "its own") != nullptr);

  write(folder / "models" / "own.json", "{");
  open_again();
  CHECK(find_model(*session.models(), "dynaflash") != nullptr);
  const auto names_it = [](const LogLine& line) {
    return line.kind == LogLine::Kind::fault && line.text.find("own.json") != std::string::npos;
  };
  CHECK(std::any_of(session.log().begin(), session.log().end(), names_it));
}

TEST_CASE("push to a simulated rig, play, live, blackout") {
  const Home home;
  Session session([] {});
  open_sample(session, "first-light");
  REQUIRE(session.edit("Short", {set_edit({"frames", ""}, "count", Value(2))}).ok());
  REQUIRE(wait_compiled(session));
  REQUIRE(session.run("rig.simulate").ok());
  REQUIRE(wait(session, [&] { return session.rig().status().phase == RigStatus::Phase::connected; }));
  REQUIRE(session.run("rig.push").ok());
  REQUIRE(wait(
      session, [&] { return !session.rig().status().pushing; }, 60.0));
  REQUIRE_MESSAGE(!session.rig().status().pushed_sha256.empty(),
                  (session.rig().status().fault ? describe(*session.rig().status().fault) : ""));
  REQUIRE(session.run("rig.play").ok());
  CHECK(wait(session, [&] { return session.rig().status().state.state == "playing"; }));
  REQUIRE(session.run("rig.blackout").ok());
  CHECK(wait(session, [&] { return session.rig().status().state.state == "dark"; }));
  REQUIRE(session.run("rig.go").ok());
  CHECK(wait(session, [&] { return session.rig().status().state.state != "dark"; }));
  REQUIRE(session.run("rig.live", args({{"on", true}})).ok());
  REQUIRE(wait(session, [&] { return session.rig().status().live; }));
  REQUIRE(session.edit("Pupils", {set_edit({"viewer", ""}, "interpupillary_mm", Value(60.0))}).ok());
  const std::uint64_t wanted = session.revision();
  const bool shown = wait(session, [&] { return session.rig().status().live_revision >= wanted; });
  CHECK_MESSAGE(shown, (session.rig().status().fault ? describe(*session.rig().status().fault)
                                                     : session.rig().status().state.state));
  CHECK(session.rig().status().edit_to_light_ms > 0.0);

  // The runtime dies while it is live: the session says so, goes on, and is live again on a new one.
  const std::string first = session.rig().status().address;
  kill_runtime_with((home.path() / "state").string());
  REQUIRE(wait(session, [&] { return session.rig().status().address != first && session.rig().status().live; }));
  REQUIRE(session.edit("Pupils", {set_edit({"viewer", ""}, "interpupillary_mm", Value(61.0))}).ok());
  CHECK(std::any_of(session.log().begin(), session.log().end(),
                    [](const LogLine& line) { return line.kind == LogLine::Kind::fault; }));
}

TEST_CASE("solving: offered, applied as one step, void after an edit, refused with reasons") {
  const Home home;
  Session session([] {});
  CHECK_FALSE(session.run("solve.start").ok());  // nothing is open
  REQUIRE(session.run("file.new", args({{"from", "three-rabbits"}})).ok());
  CHECK_FALSE(session.run("solve.apply").ok());
  const std::vector<double> before = session.project().slices.powers_d;

  REQUIRE(session.run("solve.start").ok());
  CHECK_FALSE(session.run("solve.start").ok());  // it runs already
  REQUIRE(wait(session, [&] { return session.solve_offer() != nullptr; }));
  CHECK(session.project().slices.powers_d == before);
  CHECK(session.solve_offer()->solved());
  CHECK_FALSE(session.solve_offer()->words.empty());
  CHECK_FALSE(session.solve_offer()->schedule.slots.empty());
  REQUIRE(session.run("solve.apply").ok());
  CHECK(session.project().slices.powers_d == std::vector<double>{-1.0, -0.5, 0.0, 0.5, 1.0});
  CHECK(session.solve_offer() == nullptr);
  REQUIRE(session.run("edit.undo").ok());
  CHECK(session.project().slices.powers_d == before);

  REQUIRE(session.run("solve.start").ok());
  REQUIRE(wait(session, [&] { return session.solve_offer() != nullptr; }));
  REQUIRE(session.run("slice.set", args({{"index", 0.0}, {"power_d", -0.9}})).ok());
  CHECK(session.solve_offer() == nullptr);

  REQUIRE(session.run("solve.start", args({{"slices", 40.0}})).ok());
  REQUIRE(wait(session, [&] { return session.solve_offer() != nullptr; }));
  CHECK_FALSE(session.solve_offer()->solved());
  CHECK_FALSE(session.solve_offer()->report.nearest.empty());
  CHECK_FALSE(session.run("solve.apply", args({{"nearest", 99.0}})).ok());
  REQUIRE(session.run("solve.apply", args({{"nearest", 0.0}})).ok());
  CHECK(session.project().slices.powers_d.size() > 3);

  CHECK_FALSE(session.run("solve.start", args({{"slices", 0.0}})).ok());
  CHECK_FALSE(session.run("solve.start", args({{"spacing_d", -1.0}})).ok());
}

TEST_CASE("a project edited while it is solved gets no offer; a cancelled solve says nothing") {
  const Home home;
  Session session([] {});
  REQUIRE(session.run("file.new", args({{"from", "first-light"}})).ok());
  REQUIRE(session.run("solve.start").ok());
  REQUIRE(session.run("slice.set", args({{"index", 0.0}, {"power_d", -0.9}})).ok());
  REQUIRE(wait(
      session, [&] { return session.tasks().empty(); }, 60.0));
  CHECK(session.solve_offer() == nullptr);
  REQUIRE(session.notice());
  CHECK(session.notice()->text.find("edited while it was solved") != std::string::npos);

  session.dismiss_notice();
  REQUIRE(session.run("solve.start").ok());
  session.update(now_s());
  for (const Task& task : session.tasks()) session.cancel_task(task.id);
  REQUIRE(wait(
      session, [&] { return session.tasks().empty(); }, 60.0));
  CHECK(session.solve_offer() == nullptr);
  CHECK_FALSE(session.notice());
}
