#include "devices/runtime/runtime.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <thread>

#include <doctest/doctest.h>
#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/grpcpp.h>
#include <spdlog/spdlog.h>

#include "focalstage/v1/rig.grpc.pb.h"
#include "io/files/digest.h"
#include "io/protocol/client.h"
#include "io/protocol/convert.h"
#include "io/protocol/limits.h"
#include "io/protocol/show_chunks.h"
#include "tests/devices/runtime/sample_project.h"

// The daemon as editors see it: real gRPC over loopback.

namespace focalstage {
namespace {

using std::chrono::milliseconds;
constexpr milliseconds deadline(3000);

struct Stand {
  sample::Folder folder;
  std::filesystem::path show = folder.path() / "show.h5";
  RuntimeOptions options;
  std::unique_ptr<Runtime> runtime;

  explicit Stand(RigClock clock = RigClock::virtual_time, int width_px = 64, int height_px = 48) {
    spdlog::set_level(spdlog::level::off);
    options.listen = "127.0.0.1:0";
    options.store = folder.path() / "store";
    options.rig.rig = simulated_rig(sample::sim(width_px, height_px));
    options.rig.clock = clock;
    Project project = sample::project(width_px, height_px);
    project.frames.count = 4;
    project.cues = {{"bow", 0.05, {}}};
    REQUIRE(sample::write_show(show, project));
    start();
  }

  void start() {
    Result<Runtime> started = Runtime::start(options);
    REQUIRE(started);
    runtime = std::make_unique<Runtime>(std::move(*started));
  }

  RigClient client() const {
    Result<RigClient> connected = RigClient::connect(runtime->address(), deadline);
    REQUIRE(connected);
    return std::move(*connected);
  }

  std::shared_ptr<grpc::Channel> channel() const {
    return grpc::CreateChannel(runtime->address(), grpc::InsecureChannelCredentials());
  }
};

bool eventually(const std::function<bool()>& holds) {
  for (int n = 0; n < 500; ++n) {
    if (holds()) return true;
    std::this_thread::sleep_for(milliseconds(10));
  }
  return false;
}

TEST_CASE("describe says what the simulated rig is, over the wire as in the program") {
  const Stand stand;
  RigClient client = stand.client();
  const auto rig = client.describe();
  REQUIRE(rig);
  CHECK(*rig == describe_sim(sample::sim(), {}, 60.0));
  CHECK(rig->kind == "sim");
  CHECK(rig->glasses.lens_response.left.size() == 25);
  CHECK(rig->glasses.lens_response.left[1].gain_d_per_a == doctest::Approx(37.063664).epsilon(1e-7));
  CHECK(client.describe(50.0)->frequency_hz == 50.0);
  CHECK(client.describe(50.0)->glasses.lens_response.left[1].gain_d_per_a > 37.07);
}

TEST_CASE("push, activate, play: each slot asked beside delivered") {
  const Stand stand;
  RigClient client = stand.client();
  CHECK(client.state()->state == "empty");
  double last = 0.0;
  REQUIRE(client.push(stand.show, true, [&](double share) {
    CHECK(share >= last);
    last = share;
  }));
  CHECK(last == 1.0);
  CHECK(client.state()->state == "ready");
  REQUIRE(client.play(60));
  REQUIRE(eventually([&] { return client.state()->state == "holding"; }));
  const auto state = client.state();
  CHECK(state->sweeps == 60);
  CHECK(state->missed_exposures == 0);
  CHECK(state->show_sha256 == ShowChunks::open(stand.show, {})->sha256());
  REQUIRE(state->slots.size() == 8);
  for (const SlotReport& slot : state->slots) {
    CHECK(slot.delivered);
    CHECK(slot.exposures == 60);
  }
}

TEST_CASE("commands and what they are refused in") {
  const Stand stand;
  RigClient client = stand.client();
  CHECK(client.play().fault().code == "rig.refused");
  REQUIRE(client.push(stand.show, true, {}));
  CHECK(client.cue("curtain").fault().code == "rig.refused");
  REQUIRE(client.cue("bow"));
  CHECK(client.state()->frame == 3);
  REQUIRE(client.hold());
  CHECK(client.state()->state == "holding");
  REQUIRE(client.blackout());
  CHECK(client.state()->state == "dark");
  CHECK(client.play().fault().code == "rig.refused");
  REQUIRE(client.go());
  CHECK(client.state()->state == "ready");
}

TEST_CASE("one editor holds the rig, others watch and may black it out") {
  const Stand stand;
  {
    RigClient holder = stand.client();
    REQUIRE(holder.push(stand.show, true, {}));
    RigClient other = stand.client();
    CHECK(other.play().fault().code == "rig.held");
    CHECK(other.push(stand.show, true, {}).fault().code == "rig.held");
    int seen = 0;
    REQUIRE(other.watch(milliseconds(20), [&](const RigState& state) {
      CHECK(state.state == "ready");
      CHECK_FALSE(state.holder.empty());
      return ++seen < 3;
    }));
    CHECK(seen == 3);
    REQUIRE(other.blackout());
    CHECK(holder.state()->state == "dark");
  }
  RigClient next = stand.client();
  CHECK(next.go());
}

TEST_CASE("a client that vanished mid-push leaves its chunks, and the rig once its lease has run out") {
  Stand stand(RigClock::virtual_time, 512, 384);
  stand.runtime.reset();
  stand.options.lease = milliseconds(1500);
  stand.start();
  RigClient* vanished = new RigClient(stand.client());
  std::stop_source stop;
  int chunks = 0;
  const Status cut = vanished->push(
      stand.show, true,
      [&](double) {
        if (++chunks == 2) stop.request_stop();
      },
      stop.get_token());
  CHECK(cut.fault().code == "rig.cancelled");
  // It never says good-bye: the object is left as a killed process would leave it.
  RigClient next = stand.client();
  CHECK(next.push(stand.show, true, {}).fault().code == "rig.held");
  REQUIRE(eventually([&] { return stand.client().state()->holder.empty(); }));
  double first = -1.0;
  REQUIRE(next.push(stand.show, true, [&](double share) {
    if (first < 0.0) first = share;
  }));
  // The third chunk is the first to travel again.
  const double size = static_cast<double>(std::filesystem::file_size(stand.show));
  CHECK(first == doctest::Approx(std::min(1.0, 3.0 * push_chunk_bytes / size)));
  CHECK(next.state()->state == "ready");
  delete vanished;
}

TEST_CASE("a push goes on after the runtime was started anew") {
  Stand stand(RigClock::virtual_time, 512, 384);
  {
    RigClient client = stand.client();
    std::stop_source stop;
    CHECK_FALSE(client.push(
        stand.show, false, [&](double) { stop.request_stop(); }, stop.get_token()));
  }
  stand.runtime.reset();
  stand.start();
  RigClient client = stand.client();
  int chunks = 0;
  REQUIRE(client.push(stand.show, true, [&](double) { ++chunks; }));
  const auto all = chunks_of(std::filesystem::file_size(stand.show));
  CHECK(static_cast<std::uint64_t>(chunks) == all - 1 + 1);  // one was there; the last call says 1.0 again
}

TEST_CASE("a lease that ran out between two commands is taken anew") {
  Stand stand;
  stand.runtime.reset();
  stand.options.lease = milliseconds(50);
  stand.start();
  RigClient client = stand.client();
  REQUIRE(client.push(stand.show, true, {}));
  std::this_thread::sleep_for(milliseconds(120));
  CHECK(client.play(3));
}

TEST_CASE("a message beyond the limit is refused, and the next one is not") {
  const Stand stand;
  const auto stub = v1::Rig::NewStub(stand.channel());
  v1::PushChunkRequest request;
  request.set_data(std::string(static_cast<std::size_t>(message_limit_bytes), 'x'));
  grpc::ClientContext context;
  v1::PushProgress reply;
  CHECK(stub->PushChunk(&context, request, &reply).error_code() == grpc::StatusCode::RESOURCE_EXHAUSTED);
  CHECK(stand.client().state());
}

TEST_CASE("calls without the token are refused, whatever they carry") {
  const Stand stand;
  const auto stub = v1::Rig::NewStub(stand.channel());
  v1::RigState state;
  v1::PushProgress progress;
  v1::PushVerified verified;
  const auto code = [](const grpc::Status& status) { return fault_from(status, "").code; };
  const auto in_call = [](auto call) {
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(3));
    return call(&context);
  };
  CHECK(code(in_call([&](auto* c) { return stub->Play(c, {}, &state); })) == "rig.lease");
  CHECK(code(in_call([&](auto* c) { return stub->Hold(c, {}, &state); })) == "rig.lease");
  CHECK(code(in_call([&](auto* c) { return stub->Go(c, {}, &state); })) == "rig.lease");
  CHECK(code(in_call([&](auto* c) { return stub->Cue(c, {}, &state); })) == "rig.lease");
  CHECK(code(in_call([&](auto* c) { return stub->Activate(c, {}, &state); })) == "rig.lease");
  CHECK(code(in_call([&](auto* c) { return stub->BeginPush(c, {}, &progress); })) == "rig.lease");
  CHECK(code(in_call([&](auto* c) { return stub->PushChunk(c, {}, &progress); })) == "rig.lease");
  CHECK(code(in_call([&](auto* c) { return stub->FinishPush(c, {}, &verified); })) == "rig.lease");
}

TEST_CASE("a flipped bit on the wire's other end is refused, naming the chunk") {
  const Stand stand;
  const auto stub = v1::Rig::NewStub(stand.channel());
  v1::Lease lease;
  grpc::ClientContext acquire_call;
  REQUIRE(stub->Acquire(&acquire_call, {}, &lease).ok());
  const std::string data(1000, 'd');
  const Sha256Value digest = sha256_of(std::string_view(data));
  v1::BeginPushRequest begin;
  begin.set_token(lease.token());
  begin.set_sha256(hex(digest));
  begin.set_size_bytes(data.size());
  begin.add_chunk_sha256(digest.data(), digest.size());
  grpc::ClientContext begin_call;
  v1::PushProgress progress;
  REQUIRE(stub->BeginPush(&begin_call, begin, &progress).ok());
  v1::PushChunkRequest chunk;
  chunk.set_token(lease.token());
  chunk.set_sha256(hex(digest));
  chunk.set_data("e" + data.substr(1));
  grpc::ClientContext chunk_call;
  const grpc::Status refused = stub->PushChunk(&chunk_call, chunk, &progress);
  CHECK(refused.error_code() == grpc::StatusCode::DATA_LOSS);
  CHECK(fault_from(refused, "").where == "chunk 0 of 1 (bytes from 0)");
}

TEST_CASE("a show that cannot be, and one for another rig, never become active") {
  const Stand stand;
  RigClient client = stand.client();
  const auto bad = stand.folder.path() / "bad.h5";
  std::ofstream(bad) << "no show";
  CHECK(client.push(bad, true, {}).fault().code == "rig.damaged");
  Project project = sample::project();
  project.glasses.lens_response = {};
  REQUIRE(sample::write_show(bad, project));
  const Status differs = client.push(bad, true, {});
  CHECK(differs.fault().code == "rig.differs");
  CHECK(differs.fault().remedy.find("adopt-rig") != std::string::npos);
  CHECK(client.state()->state == "empty");
  REQUIRE(client.push(stand.show, true, {}));
  CHECK_FALSE(client.push(bad, true, {}));
  CHECK(client.state()->state == "ready");
  CHECK(client.play(5));
}

TEST_CASE("a show activated while another plays takes its place, and play goes on") {
  const Stand stand;
  RigClient client = stand.client();
  REQUIRE(client.push(stand.show, true, {}));
  REQUIRE(client.play());
  const std::string first = client.state()->show_sha256;
  const auto path = stand.folder.path() / "second.h5";
  REQUIRE(sample::write_show(path, sample::project(), 9));
  REQUIRE(client.push(path, true, {}));
  const auto state = client.state();
  CHECK(state->state == "playing");
  CHECK(state->show_sha256 != first);
  CHECK(state->missed_exposures == 0);
  REQUIRE(eventually([&] { return client.state()->slots.size() == 8 && client.state()->slots[0].exposures > 10; }));
  REQUIRE(client.blackout());
  const auto after = client.state();
  for (const SlotReport& slot : after->slots) CHECK(slot.delivered);
}

/// One call of a service that we have no code for, as bytes in and out.
std::string raw_call(const std::shared_ptr<grpc::Channel>& channel, const std::string& method,
                     const std::string& request) {
  grpc::GenericStub stub(channel);
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(3));
  grpc::CompletionQueue queue;
  const auto wait = [&] {
    void* tag = nullptr;
    bool ok = false;
    queue.Next(&tag, &ok);
    return ok;
  };
  const auto call = stub.PrepareCall(&context, method, &queue);
  call->StartCall(nullptr);
  wait();
  const grpc::Slice slice(request);
  call->Write(grpc::ByteBuffer(&slice, 1), nullptr);
  wait();
  grpc::ByteBuffer reply;
  call->Read(&reply, nullptr);
  if (!wait()) return "no reply";
  std::vector<grpc::Slice> slices;
  (void)reply.Dump(&slices);
  std::string bytes;
  for (const grpc::Slice& part : slices) bytes.append(reinterpret_cast<const char*>(part.begin()), part.size());
  context.TryCancel();
  grpc::Status status;
  call->Finish(&status, nullptr);
  wait();
  return bytes;
}

TEST_CASE("health and reflection answer") {
  const Stand stand;
  // HealthCheckResponse{status: SERVING} is the varint field 1 with value 1.
  CHECK(raw_call(stand.channel(), "/grpc.health.v1.Health/Check", "") == std::string("\x08\x01"));
  // ServerReflectionRequest{list_services: "*"}: field 7, one byte.
  const std::string listed =
      raw_call(stand.channel(), "/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo", "\x3a\x01*");
  CHECK(listed.find("focalstage.v1.Rig") != std::string::npos);
  CHECK(listed.find("grpc.health.v1.Health") != std::string::npos);
}

TEST_CASE("a second runtime on the same port is an error of its own, and the first goes on") {
  const Stand stand;
  RuntimeOptions second = stand.options;
  second.listen = stand.runtime->address();
  CHECK(Runtime::start(second).fault().code == "store.in-use");
  second.store = stand.folder.path() / "other";
  const auto started = Runtime::start(second);
  REQUIRE_FALSE(started);
  CHECK(started.fault().code == "runtime.address-in-use");
  CHECK(started.fault().where == stand.runtime->address());
  CHECK(stand.client().state());
}

TEST_CASE("only loopback is listened on") {
  for (const char* open : {"0.0.0.0:50371", "192.168.1.20:50371", "[::]:1", "rig.example.org:50371"}) {
    CHECK(loopback_address(open).fault().code == "runtime.not-loopback");
  }
  for (const char* none : {"127.0.0.1", "127.0.0.1:", "127.0.0.1:http", "127.0.0.1:65536", "", "50371"}) {
    CHECK(loopback_address(none).fault().code == "runtime.address");
  }
  CHECK(*loopback_address("localhost:7") == "127.0.0.1:7");
  CHECK(*loopback_address("[::1]:50371") == "[::1]:50371");
}

TEST_CASE("where nobody answers, the fault says so within the deadline") {
  const auto started = std::chrono::steady_clock::now();
  const auto client = RigClient::connect("127.0.0.1:1", milliseconds(300));
  CHECK(client.fault().code == "rig.unreachable");
  CHECK(client.fault().where == "127.0.0.1:1");
  CHECK(std::chrono::steady_clock::now() - started < std::chrono::seconds(2));
  Stand stand;
  RigClient orphan = stand.client();
  stand.runtime.reset();
  CHECK(orphan.state().fault().code == "rig.unreachable");
}

}  // namespace
}  // namespace focalstage
