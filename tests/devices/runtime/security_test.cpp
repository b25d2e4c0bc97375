#include <sys/socket.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <functional>
#include <thread>

#include <arpa/inet.h>
#include <doctest/doctest.h>
#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/grpcpp.h>
#include <netinet/in.h>
#include <spdlog/spdlog.h>

#include "devices/runtime/address.h"
#include "devices/runtime/runtime.h"
#include "focalstage/v1/rig.grpc.pb.h"
#include "io/credentials/certificates.h"
#include "io/credentials/credentials.h"
#include "io/protocol/client.h"
#include "io/protocol/convert.h"
#include "tests/devices/runtime/sample_project.h"

// Mutual TLS forced on loopback: who may not is refused, whatever else comes is bounded, and the show goes on.

namespace focalstage {
namespace {

using std::chrono::milliseconds;
constexpr milliseconds deadline(10000);  // a busy machine may take its time: what it waits for comes
constexpr milliseconds short_deadline(700);

bool eventually(const std::function<bool()>& holds) {
  for (int n = 0; n < 1000; ++n) {
    if (holds()) return true;
    std::this_thread::sleep_for(milliseconds(10));
  }
  return false;
}

struct Stand {
  sample::Folder folder;
  Issued authority = *make_authority("test", valid_for(1));
  RuntimeOptions options;
  std::unique_ptr<Runtime> runtime;

  Stand() {
    spdlog::set_level(spdlog::level::off);
    ::setenv("FOCALSTAGE_CREDENTIALS", (folder.path() / "pairs").c_str(), 1);
    options.listen = "127.0.0.1:0";
    options.store = folder.path() / "store";
    options.rig.rig = simulated_rig(sample::sim());
    options.clients = {
        {"director", "", {true, true, true}}, {"porter", "", {true, true, false}}, {"lobby", "", {true, false, false}}};
    use(*make_rig_certificate(authority, {"127.0.0.1"}, valid_for(1)));
  }
  ~Stand() { ::unsetenv("FOCALSTAGE_CREDENTIALS"); }

  void use(const Issued& rig) {
    options.network.certificate = folder.path() / "rig.pem";
    options.network.key = folder.path() / "rig.key";
    options.network.client_ca = folder.path() / "ca.pem";
    std::ofstream(options.network.certificate) << rig.certificate;
    std::ofstream(options.network.client_ca) << authority.certificate;
    REQUIRE(write_secret(options.network.key, rig.key));
  }

  void start() {
    Result<Runtime> started = Runtime::start(options);
    REQUIRE(started);
    runtime = std::make_unique<Runtime>(std::move(*started));
  }

  Credentials pair(const std::string& name, const Validity& validity = valid_for(1)) const {
    const Issued client = *make_client_certificate(authority, name, validity);
    return {client.certificate, client.key, authority.certificate};
  }

  /// A connection of a computer that was paired as `name`.
  Result<RigClient> client(const std::string& name, milliseconds patience = deadline) const {
    REQUIRE(keep_pair(pair(name), runtime->address()));
    return RigClient::connect(runtime->address(), patience);
  }

  /// Pushed and playing, in real time.
  void play() {
    const auto show = folder.path() / "show.h5";
    REQUIRE(sample::write_show(show, sample::project()));
    auto director = client("director");
    REQUIRE(director);
    REQUIRE(director->push(show, true, {}));
    REQUIRE(director->play());
  }

  std::uint64_t sweeps() const { return runtime->figures().state.sweeps; }

  /// Sweeps are counted on, and none of them missed its light.
  bool goes_on() const {
    const std::uint64_t before = sweeps();
    std::this_thread::sleep_for(milliseconds(200));
    const RigState state = runtime->figures().state;
    return state.state == "playing" && state.sweeps >= before + 8 && state.missed_exposures == 0;
  }

  int connection() const {
    const int descriptor = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(host_port(runtime->address())->port));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    REQUIRE(::connect(descriptor, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0);
    return descriptor;
  }
};

TEST_CASE("each client does what its rights allow, and is told what they do not") {
  Stand stand;
  stand.start();
  const auto show = stand.folder.path() / "show.h5";
  REQUIRE(sample::write_show(show, sample::project()));
  {
    auto lobby = stand.client("lobby");
    REQUIRE(lobby);
    CHECK(lobby->describe().ok());
    CHECK(lobby->state()->state == "empty");
    CHECK(lobby->blackout().ok());
    const Status pushed = lobby->push(show, true, {});
    REQUIRE_FALSE(pushed);
    CHECK(pushed.fault().code == "rig.unauthorised");
    CHECK(pushed.fault().where == "lobby");
    CHECK(lobby->go().fault().code == "rig.unauthorised");
  }
  {
    auto porter = stand.client("porter");
    REQUIRE(porter);
    CHECK(porter->push(show, false, {}).ok());
    CHECK(porter->push(show, true, {}).fault().code == "rig.unauthorised");
    CHECK(porter->play().fault().message.find("control") != std::string::npos);
  }
  {
    auto director = stand.client("director");
    REQUIRE(director);
    CHECK(director->go().ok());
    CHECK(director->push(show, true, {}).ok());
    CHECK(director->play().ok());
    CHECK(eventually([&] { return stand.sweeps() > 10; }));
  }
  auto stranger = stand.client("stranger");
  REQUIRE(stranger);
  CHECK(stranger->state().fault().code == "rig.unauthorised");
  CHECK(stranger->blackout().fault().code == "rig.unauthorised");
  CHECK(stand.goes_on());
}

TEST_CASE("a fingerprint tells one certificate from another of the same name") {
  Stand stand;
  const Credentials known = stand.pair("desk");
  stand.options.clients = {{"desk", read_certificate(known.certificate, "x")->fingerprint, {true, false, false}}};
  stand.start();
  REQUIRE(keep_pair(known, stand.runtime->address()));
  CHECK(RigClient::connect(stand.runtime->address(), deadline)->state().ok());
  CHECK(stand.client("desk")->state().fault().code == "rig.unauthorised");
}

TEST_CASE("whoever has no certificate, an old one or another authority's is refused and told why; the show goes on") {
  Stand stand;
  stand.start();
  stand.play();
  const std::string address = stand.runtime->address();
  const auto refused = [&](const std::string& code, const std::string& word) {
    const auto client = RigClient::connect(address, short_deadline);
    REQUIRE_FALSE(client);
    CAPTURE(describe(client.fault()));
    CHECK(client.fault().code == code);
    CHECK(client.fault().message.find(word) != std::string::npos);
    CHECK_FALSE(client.fault().remedy.empty());
  };
  const auto keep = [&](const std::string& text) {
    const auto kept = keep_pair({"", "", ""}, address);
    REQUIRE(kept);
    REQUIRE(write_secret(*kept, text));
  };
  std::filesystem::remove_all(stand.folder.path() / "pairs");
  refused("rig.unpaired", "wants a certificate");
  keep(pair_text(stand.pair("director", {0, 86400})));
  refused("credentials.expired", "1970-01-02");
  const Issued other = *make_authority("other", valid_for(1));
  const Issued foreign = *make_client_certificate(other, "director", valid_for(1));
  keep(pair_text({foreign.certificate, foreign.key, stand.authority.certificate}));
  refused("rig.certificate", "does not take this computer's certificate");
  const Credentials ours = stand.pair("director");
  keep(pair_text({ours.certificate, ours.key, other.certificate}));
  refused("rig.certificate", "not of the authority");
  CHECK(stand.goes_on());
}

TEST_CASE("a client whose certificate ended is refused by the rig itself") {
  Stand stand;
  stand.start();
  stand.play();
  const Credentials old = stand.pair("director", {0, 86400});
  const auto channel = grpc::CreateChannel(
      stand.runtime->address(), grpc::SslCredentials({stand.authority.certificate, old.key, old.certificate}));
  CHECK_FALSE(channel->WaitForConnected(std::chrono::system_clock::now() + short_deadline));
  const Credentials good = stand.pair("director");
  const auto second = grpc::CreateChannel(
      stand.runtime->address(), grpc::SslCredentials({stand.authority.certificate, good.key, good.certificate}));
  CHECK(second->WaitForConnected(std::chrono::system_clock::now() + deadline));
  CHECK(stand.goes_on());
}

TEST_CASE("a rig whose certificate is for another host, or over, is told from one that is down") {
  Stand stand;
  stand.use(*make_rig_certificate(stand.authority, {"rig.example"}, valid_for(1)));
  stand.start();
  REQUIRE(keep_pair(stand.pair("director"), stand.runtime->address()));
  const auto client = RigClient::connect(stand.runtime->address(), short_deadline);
  REQUIRE_FALSE(client);
  CHECK(client.fault().code == "rig.certificate");
  CHECK(client.fault().message.find("rig.example") != std::string::npos);
  REQUIRE(keep_pair(stand.pair("director"), "127.0.0.1:1"));
  CHECK(RigClient::connect("127.0.0.1:1", short_deadline).fault().code == "rig.unreachable");
  stand.runtime.reset();
  stand.use(*make_rig_certificate(stand.authority, {"127.0.0.1"}, {0, 86400}));
  const auto started = Runtime::start(stand.options);
  REQUIRE_FALSE(started);
  CHECK(started.fault().code == "credentials.expired");
}

TEST_CASE("beyond loopback only with certificates") {
  Stand stand;
  stand.options.listen = "0.0.0.0:0";
  stand.start();
  CHECK(stand.runtime->address().starts_with("0.0.0.0:"));
  stand.runtime.reset();
  stand.options.network = {};
  const auto open = Runtime::start(stand.options);
  REQUIRE_FALSE(open);
  CHECK(open.fault().code == "runtime.not-loopback");
}

TEST_CASE("an oversized message is refused before it is read; the show goes on") {
  Stand stand;
  stand.options.network.message_bytes_max = 1'100'000;
  stand.start();
  stand.play();
  const Credentials good = stand.pair("director");
  grpc::ChannelArguments unbounded;
  unbounded.SetMaxSendMessageSize(-1);
  const auto stub = v1::Rig::NewStub(grpc::CreateCustomChannel(
      stand.runtime->address(), grpc::SslCredentials({stand.authority.certificate, good.key, good.certificate}),
      unbounded));
  v1::PushChunkRequest request;
  request.set_data(std::string(8 << 20, 'x'));
  v1::PushProgress reply;
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + deadline);
  CHECK(stub->PushChunk(&context, request, &reply).error_code() == grpc::StatusCode::RESOURCE_EXHAUSTED);
  CHECK(stand.goes_on());
}

TEST_CASE("three hundred half-open connections: bounded, shown out, and the show goes on") {
  Stand stand;
  stand.options.network.connections_max = 40;
  stand.options.network.connections_per_peer_max = 40;
  stand.start();
  stand.play();
  auto director = stand.client("director");
  REQUIRE(director);
  CHECK(director->state().ok());
  std::vector<int> half_open;
  for (int n = 0; n < 300; ++n) {
    half_open.push_back(stand.connection());
    if (n % 3 == 1) (void)::send(half_open.back(), "\x16\x03\x01", 3, MSG_NOSIGNAL);  // a handshake that never goes on
    if (n % 3 == 2) (void)::send(half_open.back(), "GET / HTTP/1.0\r\n\r\n", 18, MSG_NOSIGNAL);
  }
  CHECK(eventually([&] { return stand.runtime->figures().turned_away >= 100; }));
  CHECK(stand.runtime->figures().connections <= 40);
  CHECK(stand.goes_on());
  CHECK(director->state().ok());  // who is in stays in
  CHECK(director->hold().ok());
  CHECK(director->play().ok());
  // Those that got in and say nothing are shown out, and there is room again.
  CHECK(eventually([&] { return stand.runtime->figures().connections <= 2; }));
  auto late = stand.client("lobby");
  REQUIRE(late);
  CHECK(late->state().ok());
  CHECK(stand.goes_on());
  for (const int descriptor : half_open) ::close(descriptor);
}

TEST_CASE("a place is free again when a client leaves") {
  Stand stand;
  stand.options.network.connections_max = 2;
  stand.start();
  for (int n = 0; n < 10; ++n) {
    CAPTURE(n);
    CHECK(eventually([&] { return stand.runtime->figures().connections == 0; }));
    auto client = stand.client("lobby");
    REQUIRE(client);
    CHECK(client->state().ok());
    CHECK(stand.runtime->figures().connections == 1);
  }
}

TEST_CASE("a client that calls too often is told so, others are not") {
  Stand stand;
  stand.options.network.calls_per_s = 20;
  stand.start();
  auto lobby = stand.client("lobby");
  auto porter = stand.client("porter");
  REQUIRE(lobby);
  REQUIRE(porter);
  int busy = 0;
  for (int n = 0; n < 200; ++n) {
    const auto state = lobby->state();
    if (!state && state.fault().code == "rig.busy") ++busy;
  }
  CHECK(busy > 50);
  CHECK(porter->state().ok());
}

TEST_CASE("a push comes no faster than the configuration allows") {
  Stand stand;
  stand.options.network.push_bytes_per_s = 200'000;
  stand.start();
  const auto show = stand.folder.path() / "show.h5";
  REQUIRE(sample::write_show(show, sample::project(320, 240)));
  const double bytes = static_cast<double>(std::filesystem::file_size(show));
  REQUIRE(bytes > 250'000);
  auto director = stand.client("director");
  REQUIRE(director);
  const auto begun = std::chrono::steady_clock::now();
  REQUIRE(director->push(show, false, {}));
  const double took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  CHECK(took_s >= (bytes - 200'000) / 200'000 - 0.05);
}

TEST_CASE("reflection only where it was asked for, or on loopback without certificates") {
  const auto reflects = [](const std::shared_ptr<grpc::Channel>& channel) {
    grpc::GenericStub stub(channel);
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + deadline);
    grpc::CompletionQueue queue;
    grpc::ByteBuffer request;
    auto call = stub.PrepareUnaryCall(&context, "/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo",
                                      request, &queue);
    call->StartCall();
    grpc::ByteBuffer reply;
    grpc::Status status;
    call->Finish(&reply, &status, nullptr);
    void* tag = nullptr;
    bool ok = false;
    (void)queue.Next(&tag, &ok);
    queue.Shutdown();
    while (queue.Next(&tag, &ok)) continue;
    return status.error_code() != grpc::StatusCode::UNIMPLEMENTED;
  };
  Stand stand;
  const Credentials good = stand.pair("director");
  const auto channel = [&] {
    return grpc::CreateChannel(stand.runtime->address(),
                               grpc::SslCredentials({stand.authority.certificate, good.key, good.certificate}));
  };
  stand.start();
  CHECK_FALSE(reflects(channel()));
  stand.runtime.reset();
  stand.options.network.reflection = true;
  stand.start();
  CHECK(reflects(channel()));
  stand.runtime.reset();
  stand.options.network = {};
  stand.start();
  CHECK(reflects(grpc::CreateChannel(stand.runtime->address(), grpc::InsecureChannelCredentials())));
}

}  // namespace
}  // namespace focalstage
