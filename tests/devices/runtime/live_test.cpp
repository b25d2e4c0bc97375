#include "io/protocol/live_client.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string_view>

#include <doctest/doctest.h>
#include <grpcpp/grpcpp.h>
#include <spdlog/spdlog.h>

#include "devices/runtime/runtime.h"
#include "focalstage/v1/rig.grpc.pb.h"
#include "io/files/files.h"
#include "io/project/project_file.h"
#include "io/protocol/connection.h"
#include "tests/devices/runtime/live_project.h"

// Live over real gRPC, with the simulated rig in this process.

namespace focalstage {
namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

struct Stand {
  sample::Folder folder;
  RuntimeOptions options;
  std::unique_ptr<Runtime> runtime;

  explicit Stand(RigClock clock = RigClock::virtual_time, int width_px = 64, int height_px = 48) {
    spdlog::set_level(spdlog::level::off);
    options.listen = "127.0.0.1:0";
    options.store = folder.path() / "store";
    options.rig.rig = simulated_rig(sample::sim(width_px, height_px));
    options.rig.clock = clock;
    Result<Runtime> started = Runtime::start(options);
    REQUIRE(started);
    runtime = std::make_unique<Runtime>(std::move(*started));
  }

  RigClient client() const {
    Result<RigClient> connected = RigClient::connect(runtime->address(), milliseconds(3000));
    REQUIRE(connected);
    return std::move(*connected);
  }
};

/// A link on a stand, playing its first revision.
struct Playing {
  RigClient client;
  LiveLink link;
  sample::LiveAnswers answers;

  Playing(const Stand& stand, const Project& project, std::vector<AssetFile> files = {})
      : client(stand.client()), link(begun(client, project, std::move(files))), answers(link) {
    REQUIRE(answers.wait_compiled(1));
    REQUIRE(client.play());
    REQUIRE(answers.wait_appeared(1));
  }

  static LiveLink begun(RigClient& client, const Project& project, std::vector<AssetFile> files) {
    Result<LiveLink> started = LiveLink::start(client, {1, project_text(project), std::move(files), 0}, true);
    REQUIRE(started);
    return std::move(*started);
  }
};

TEST_CASE("an edit that moves an object appears on the rig, image for image") {
  const Stand stand;
  const Project project = sample::live_project();
  Playing live(stand, project);
  CHECK(read_live_frame(live.answers.compiled.back())->codes == sample::images_of(project).codes);
  CHECK(live.client.state()->revision == 1);
  CHECK(live.client.state()->show_sha256.empty());

  const Edit edit = sample::move_to(0.06, -1.0);
  REQUIRE(live.link.send(2, {edit}));
  REQUIRE(live.answers.wait_appeared(2));
  const FrameImages moved = sample::images_of(*apply(project, edit));
  const auto shown = read_live_frame(live.answers.compiled.back());
  REQUIRE(shown);
  CHECK(shown->count == 8);
  CHECK(shown->codes == moved.codes);
  CHECK(shown->codes != sample::images_of(project).codes);

  const auto& appeared = live.answers.appeared;
  CHECK(appeared.back().sweep > appeared.front().sweep);
  CHECK(appeared.back().edit_to_light_ms > 0.0);
  CHECK(appeared.back().edit_to_light_ms < 5000.0);
  const auto state = live.client.state();
  CHECK(state->state == "playing");
  CHECK(state->revision == 2);
  CHECK(state->missed_exposures == 0);
  REQUIRE(state->slots.size() == 8);
  for (const SlotReport& slot : state->slots) CHECK(slot.delivered);
}

TEST_CASE("of a hundred fast edits the newest wins, and what appears never goes back") {
  const Stand stand;
  const Project project = sample::live_project();
  Playing live(stand, project);
  for (int n = 1; n <= 100; ++n)
    REQUIRE(live.link.send(1 + static_cast<std::uint64_t>(n), {sample::move_to(n * 1e-3)}));
  REQUIRE(live.answers.wait_appeared(101));
  CHECK(read_live_frame(live.answers.compiled.back())->codes ==
        sample::images_of(*apply(project, sample::move_to(0.1))).codes);
  const auto rising = [](const auto& answers) {
    return std::ranges::adjacent_find(answers, [](const auto& a, const auto& b) { return a.revision >= b.revision; }) ==
           answers.end();
  };
  CHECK(rising(live.answers.compiled));
  CHECK(rising(live.answers.appeared));
  CHECK(std::ranges::is_sorted(live.answers.appeared, {}, &LiveAppeared::sweep));
  CHECK(live.answers.compiled.size() < 101);  // some were overtaken
  CHECK(live.answers.refused.empty());
}

TEST_CASE("a drag that outruns the compiler still moves on the rig") {
  const Stand stand(RigClock::virtual_time, 512, 384);
  Playing live(stand, sample::live_project(512, 384));
  const auto started = Clock::now();
  std::uint64_t revision = 1;
  // An edit each half millisecond: every compile is overtaken while it runs.
  while (Clock::now() - started < milliseconds(600)) {
    ++revision;
    REQUIRE(live.link.send(revision, {sample::move_to(1e-4 * static_cast<double>(revision % 500))}));
    std::this_thread::sleep_for(std::chrono::microseconds(500));
  }
  const bool any = live.answers.wait([&] { return live.answers.compiled.size() > 1; });
  REQUIRE(any);
  CHECK(live.answers.compiled[1].revision < revision);  // before the drag came to rest
  CHECK(live.answers.wait_appeared(revision));
}

TEST_CASE("an edit that does not apply is refused with its place, and what plays stays") {
  const Stand stand;
  const Project project = sample::live_project();
  Playing live(stand, project);
  const Edit wrong{Edit::Kind::set, "objects", "square", "scale", Value(-1.0)};
  REQUIRE(live.link.send(2, {wrong}));
  REQUIRE(live.answers.wait_refused(2));
  CHECK(live.answers.refused.back().fault.code == "edit.value");
  CHECK(live.answers.refused.back().fault.where == "objects/square/scale");
  CHECK(live.client.state()->revision == 1);
  CHECK(live.client.state()->state == "playing");

  // What would build upon it can't be either; upon the one before, it can.
  REQUIRE(live.link.send(3, {sample::move_to(0.01)}));
  REQUIRE(live.answers.wait_refused(3));
  CHECK(live.answers.refused.back().fault.code == "live.base");
  REQUIRE(live.link.send_onto(1, 4, {sample::move_to(0.02)}));
  CHECK(live.answers.wait_appeared(4));
  REQUIRE(live.link.send_onto(1, 4, {sample::move_to(0.03)}));
  REQUIRE(live.answers.wait_refused(4));
  CHECK(live.answers.refused.back().fault.code == "live.order");
  CHECK(live.client.state()->revision == 4);

  // Undo: the revision of long ago, with no edits. And the whole anew, whatever was refused.
  REQUIRE(live.link.send_onto(1, 5, {}));
  REQUIRE(live.answers.wait_appeared(5));
  CHECK(read_live_frame(live.answers.compiled.back())->codes == sample::images_of(project).codes);
  REQUIRE(live.link.send_project({6, project_text(*apply(project, sample::move_to(-0.05))), {}, 0}));
  REQUIRE(live.answers.wait_appeared(6));
  CHECK(read_live_frame(live.answers.compiled.back())->codes ==
        sample::images_of(*apply(project, sample::move_to(-0.05))).codes);
}

TEST_CASE("what would not be played as a show is not played live; edits go on from it") {
  const Stand stand;
  const Project project = sample::live_project();
  Playing live(stand, project);
  const auto refused = [&](std::uint64_t revision, const std::string& list, const std::string& name,
                           const std::string& key, Value value) {
    REQUIRE(live.link.send_onto(1, revision, {{Edit::Kind::set, list, name, key, std::move(value)}}));
    REQUIRE(live.answers.wait_refused(revision));
    return live.answers.refused.back().fault;
  };
  const Fault spacing = refused(2, "slices", "", "powers_d", Value::Array{-1.0, 0.5});
  CHECK(spacing.code == "rig.refused");
  CHECK(spacing.message.find("slices.spacing") != std::string::npos);
  CHECK(refused(3, "projectors", "main", "latency_ms", 0.25).code == "rig.differs");
  CHECK(refused(4, "projectors", "main", "width_px", 32.0).code == "rig.differs");
  // Light for 8 slots of 1.9 ms: 0.91 of the sweep, beyond the rig's 0.8... and over each other.
  CHECK(refused(5, "projectors", "main", "exposure_ms", 1.9).code == "rig.refused");
  // Measured while compiling: at 0.2 m, 5.4 D, the square wants a power far below the lowest slice.
  const Fault beyond = refused(6, "objects", "square", "position_m", Value::Array{0.0, 0.0, -0.2});
  CHECK(beyond.message.find("depth.out-of-range") != std::string::npos);
  CHECK(live.client.state()->revision == 1);
  CHECK(live.client.state()->state == "playing");
  // A drag goes through such a place and on.
  REQUIRE(live.link.send(7, {sample::move_to(0.03)}));
  CHECK(live.answers.wait_appeared(7));
}

TEST_CASE("frames of the project are shown as asked") {
  const Stand stand;
  Project project = sample::live_project();
  project.frames.count = 3;
  project.objects[0].placement.keys = {{0.0, {{0.0, 0.0, -0.5}}}, {2.0 / 60.0, {{0.1, 0.0, -0.5}}}};
  Playing live(stand, project);
  REQUIRE(live.link.show_frame(2));
  REQUIRE(live.answers.wait_appeared(1, 2));
  CHECK(read_live_frame(live.answers.compiled.back())->codes == sample::images_of(project, 2).codes);
  CHECK(live.client.state()->frame == 2);
  REQUIRE(live.link.show_frame(3));
  REQUIRE(live.answers.wait_refused(1));
  CHECK(live.answers.refused.back().fault.code == "live.frame");
  // Fewer frames: the last of them, and edits keep to the frame shown.
  REQUIRE(live.link.send(2, {{Edit::Kind::set, "frames", "", "count", Value(2.0)}}));
  REQUIRE(live.answers.wait_appeared(2, 1));
}

AssetFile triangle(double size_m) {
  const std::string size = std::to_string(size_m);
  const std::string text = "v 0 0 0\nv " + size + " 0 0\nv 0 " + size + " 0\nf 1 2 3\n";
  const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
  return {"assets/triangle.obj", sha256_hex(text), {bytes, bytes + text.size()}};
}

Project with_triangle() {
  Project project = sample::live_project();
  project.objects[0].mesh.shape = FileMesh{"assets/triangle.obj"};
  return project;
}

TEST_CASE("an asset travels once, by its hash") {
  const Stand stand;
  const AssetFile file = triangle(0.1);
  {
    Playing live(stand, with_triangle(), {file});
    CHECK(live.client.state()->slots.size() == 8);
    // A file that an edit brings along replaces the one of its name.
    const AssetFile larger = triangle(0.2);
    const FrameImages before = *read_live_frame(live.answers.compiled.back());
    REQUIRE(live.link.send(2, {sample::move_to(0.0)}, {larger}));
    REQUIRE(live.answers.wait_appeared(2));
    CHECK(read_live_frame(live.answers.compiled.back())->codes != before.codes);
  }
  // By hand: what does the rig ask for?
  const auto stub = v1::Rig::NewStub(grpc::CreateChannel(stand.runtime->address(), grpc::InsecureChannelCredentials()));
  v1::Lease lease;
  grpc::ClientContext acquire;
  REQUIRE(stub->Acquire(&acquire, {}, &lease).ok());
  const auto asked_for = [&](const AssetFile& asset) {
    grpc::ClientContext context;
    const auto stream = stub->Live(&context);
    v1::LiveRequest request;
    request.mutable_begin()->set_token(lease.token());
    stream->Write(request);
    v1::LiveProject& project = *request.mutable_project();
    project.set_revision(1);
    project.set_sha256(std::string(64, 'a'));
    project.set_size_bytes(10);
    v1::LiveAsset& named = *project.add_assets();
    named.set_path(asset.path);
    named.set_sha256(asset.sha256);
    named.set_size_bytes(asset.bytes.size());
    stream->Write(request);
    v1::LiveReply reply;
    std::vector<std::string> wanted;
    while (wanted.empty() && stream->Read(&reply)) {
      wanted.assign(reply.wanted().sha256().begin(), reply.wanted().sha256().end());
    }
    request.mutable_end();
    stream->Write(request);
    stream->WritesDone();
    while (stream->Read(&reply)) {
    }
    CHECK(stream->Finish().ok());
    return wanted;
  };
  CHECK(asked_for(file) == std::vector{std::string(64, 'a')});
  const AssetFile unknown = triangle(0.3);
  CHECK(asked_for(unknown) == std::vector{std::string(64, 'a'), unknown.sha256});
}

TEST_CASE("an asset that is not what it was announced as is refused, and the link goes on") {
  const Stand stand;
  AssetFile file = triangle(0.1);
  std::vector<std::byte> damaged(file.bytes.begin(), file.bytes.end());
  damaged.back() = std::byte{'x'};
  file.bytes = std::move(damaged);
  RigClient client = stand.client();
  LiveLink link = Playing::begun(client, with_triangle(), {file});
  sample::LiveAnswers answers(link);
  REQUIRE(answers.wait_refused(1));
  CHECK(answers.refused.back().fault.code == "rig.damaged");
  REQUIRE(link.send_project({2, project_text(with_triangle()), {triangle(0.1)}, 0}));
  CHECK(answers.wait_compiled(2));
  // One that no mesh reader takes is refused by its own name.
  AssetFile nonsense = triangle(0.1);
  nonsense.bytes = std::vector<std::byte>(100, std::byte{0xff});
  nonsense.sha256 = sha256_hex(nonsense.bytes);
  REQUIRE(link.send(3, {}, {nonsense}));
  REQUIRE(answers.wait_refused(3));
  CHECK(answers.refused.back().fault.where.find("triangle.obj") != std::string::npos);
}

TEST_CASE("a project of many chunks travels whole") {
  const Stand stand;
  Project project = sample::live_project();
  project.name = std::string(3'000'000, 'n');
  const Playing live(stand, project);
  CHECK(live.answers.compiled.back().revision == 1);
}

TEST_CASE("edits too large for one message say so; the link goes on") {
  const Stand stand;
  Playing live(stand, sample::live_project());
  const Edit large{Edit::Kind::set, "", "", "name", Value(std::string(3'000'000, 'n'))};
  CHECK(live.link.send(2, {large}).fault().code == "live.too-large");
  REQUIRE(live.link.send(2, {sample::move_to(0.01)}));
  CHECK(live.answers.wait_appeared(2));
}

TEST_CASE("one live link at a time, and only for whoever holds the rig") {
  const Stand stand;
  Playing live(stand, sample::live_project());
  RigClient other = stand.client();
  const std::string text = project_text(sample::live_project());
  CHECK(LiveLink::start(other, {1, text, {}, 0}).fault().code == "rig.held");
  CHECK(LiveLink::start(live.client, {1, text, {}, 0}).fault().code == "rig.refused");
  REQUIRE(live.link.send(2, {sample::move_to(0.01)}));
  CHECK(live.answers.wait_appeared(2));
}

TEST_CASE("a link that ends leaves what plays, and the next may begin; a pushed show takes its place") {
  const Stand stand;
  RigClient client = stand.client();
  {
    LiveLink link = Playing::begun(client, sample::live_project(), {});
    sample::LiveAnswers answers(link);
    REQUIRE(answers.wait_compiled(1));
    REQUIRE(client.play());
    REQUIRE(answers.wait_appeared(1));
  }
  CHECK(client.state()->state == "playing");
  CHECK(client.state()->fault.empty());
  CHECK(client.state()->revision == 1);
  {
    LiveLink link = Playing::begun(client, sample::live_project(), {});
    sample::LiveAnswers answers(link);
    CHECK(answers.wait_appeared(1));
  }
  const auto show = stand.folder.path() / "show.h5";
  REQUIRE(sample::write_show(show, sample::project()));
  REQUIRE(client.push(show, true, {}));
  CHECK(client.state()->state == "playing");
  CHECK(client.state()->revision == 0);
  CHECK(client.state()->show_sha256.size() == 64);
}

TEST_CASE("blackout is stronger than live: edits are compiled, nothing is lit until go and play") {
  const Stand stand;
  Playing live(stand, sample::live_project());
  REQUIRE(live.client.blackout());
  REQUIRE(live.link.send(2, {sample::move_to(0.02)}));
  REQUIRE(live.answers.wait_compiled(2));
  CHECK(live.client.state()->state == "dark");
  CHECK(live.answers.appeared.back().revision == 1);
  CHECK(live.client.play().fault().code == "rig.refused");
  REQUIRE(live.client.go());
  REQUIRE(live.client.play());
  CHECK(live.answers.wait_appeared(2));
}

TEST_CASE("a connection that breaks without a good-bye is darkness at once, latched until go") {
  const Stand stand;
  Playing live(stand, sample::live_project());
  const auto stub = v1::Rig::NewStub(grpc::CreateChannel(stand.runtime->address(), grpc::InsecureChannelCredentials()));
  {
    LiveLink ending = std::move(live.link);  // a clean end frees the place
  }
  const std::string token = *live.client.connection()->token();
  grpc::ClientContext context;
  const auto stream = stub->Live(&context);
  v1::LiveRequest request;
  request.mutable_begin()->set_token(token);
  REQUIRE(stream->Write(request));
  v1::LiveReply reply;
  REQUIRE(stream->Read(&reply));
  CHECK(reply.state().state() == "playing");
  context.TryCancel();
  (void)stream->Finish();
  for (int n = 0; n < 500 && live.client.state()->state != "dark"; ++n) std::this_thread::sleep_for(milliseconds(2));
  CHECK(live.client.state()->state == "dark");
  CHECK(live.client.state()->fault.find("rig.live-client") != std::string::npos);
  CHECK(live.client.play().fault().code == "rig.refused");
  REQUIRE(live.client.go());
  CHECK(live.client.play());
}

TEST_CASE("an editor that says nothing for 250 ms is gone, though its connection stands") {
  const Stand stand(RigClock::real_time);
  RigClient client = stand.client();
  LiveLink link = Playing::begun(client, sample::live_project(), {});
  sample::LiveAnswers answers(link);
  REQUIRE(answers.wait_compiled(1));
  { LiveLink ending = std::move(link); }
  REQUIRE(client.play());
  const auto stub = v1::Rig::NewStub(grpc::CreateChannel(stand.runtime->address(), grpc::InsecureChannelCredentials()));
  grpc::ClientContext context;
  const auto stream = stub->Live(&context);
  v1::LiveRequest request;
  request.mutable_begin()->set_token(*client.connection()->token());
  REQUIRE(stream->Write(request));
  v1::LiveReply reply;
  REQUIRE(stream->Read(&reply));
  for (int n = 0; n < 10; ++n) {
    request.mutable_keepalive();
    REQUIRE(stream->Write(request));
    std::this_thread::sleep_for(milliseconds(100));
  }
  CHECK(client.state()->state != "dark");
  const auto last_word = Clock::now();
  while (stream->Read(&reply)) {
  }
  const double silent_ms = std::chrono::duration<double, std::milli>(Clock::now() - last_word).count();
  CHECK(silent_ms > 100.0);
  CHECK(silent_ms < 400.0);
  CHECK(client.state()->state == "dark");
  CHECK_FALSE(stream->Finish().ok());
}

TEST_CASE("a rig that goes away is told within a second, and is reached again when it is back") {
  Stand stand;
  Playing live(stand, sample::live_project());
  std::optional<Status> watched;
  std::jthread watcher([&] { watched = live.client.watch(milliseconds(50), [](const RigState&) { return true; }); });
  CHECK(live.client.reachable());
  const std::string address = stand.runtime->address();
  const auto gone = Clock::now();
  stand.runtime.reset();
  REQUIRE(live.answers.wait_ended());
  CHECK(Clock::now() - gone < std::chrono::seconds(1));
  CHECK(live.answers.ended.back().fault.code == "rig.unreachable");
  CHECK(live.link.send(9, {}).fault().code == "rig.unreachable");
  watcher.join();
  CHECK(watched->fault().code == "rig.unreachable");
  CHECK(live.client.state().fault().code == "rig.unreachable");
  CHECK_FALSE(live.client.reachable());

  stand.options.listen = address;
  Result<Runtime> back = Runtime::start(stand.options);
  REQUIRE(back);
  for (int n = 0; n < 500 && !live.client.reachable(); ++n) std::this_thread::sleep_for(milliseconds(10));
  CHECK(live.client.reachable());
  CHECK(live.client.state()->state == "empty");
  // The lease of before is not known any more; that is nobody's concern.
  LiveLink again = Playing::begun(live.client, sample::live_project(), {});
  sample::LiveAnswers answers(again);
  CHECK(answers.wait_compiled(1));
}

TEST_CASE("watching ends when it is told to") {
  const Stand stand;
  RigClient client = stand.client();
  std::stop_source stop;
  std::jthread soon([&] {
    std::this_thread::sleep_for(milliseconds(100));
    stop.request_stop();
  });
  const auto started = Clock::now();
  CHECK(client.watch(
      milliseconds(20), [](const RigState&) { return true; }, stop.get_token()));
  CHECK(Clock::now() - started < std::chrono::seconds(2));
}

}  // namespace
}  // namespace focalstage
