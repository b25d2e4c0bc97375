#include "io/protocol/client.h"

#include <algorithm>
#include <utility>

#include "io/protocol/connection.h"
#include "io/protocol/limits.h"
#include "io/protocol/show_chunks.h"
#include "io/protocol/silence_watch.h"

namespace focalstage {

namespace {

using std::chrono::milliseconds;

Fault cancelled(const std::string& address) {
  return {"rig.cancelled", address, "the push was stopped", "push again: it goes on where it stopped"};
}

template <class Request>
Status command(RigConnection& rig, RigConnection::Method<v1::RigState, Request> method, const Request& request) {
  const Result<v1::RigState> reply = rig.holding(method, request, std::max(rig.deadline(), milliseconds(10'000)));
  if (!reply) return reply.fault();
  return {};
}

/// One push: the connection it goes through, who may stop it and who is told.
struct Push {
  RigConnection& rig;
  const std::function<void(double)>& progress;
  const std::stop_token& stop;

  Status send_chunks(const ShowChunks& show, std::uint64_t received) const;
  Status send(const std::filesystem::path& path, bool activate) const;
};

Status Push::send_chunks(const ShowChunks& show, std::uint64_t received) const {
  while (received < show.size_bytes()) {
    if (stop.stop_requested()) return cancelled(rig.address());
    Result<std::string> data = show.read(received / push_chunk_bytes);
    if (!data) return data.fault();
    v1::PushChunkRequest request;
    request.set_sha256(show.sha256());
    request.set_offset_bytes(received);
    request.set_data(std::move(*data));
    const Result<v1::PushProgress> reply = rig.holding(&v1::Rig::Stub::PushChunk, std::move(request),
                                                       std::max(rig.deadline(), milliseconds(30'000)), stop);
    if (!reply) return reply.fault();
    if (reply->received_bytes() <= received) {
      return Fault{"rig.refused", rig.address(), "the rig did not take a chunk and did not say why",
                   "look at the rig's log"};
    }
    received = reply->received_bytes();
    if (progress) progress(static_cast<double>(received) / static_cast<double>(show.size_bytes()));
  }
  return {};
}

Status Push::send(const std::filesystem::path& path, bool activate) const {
  const Result<ShowChunks> show = ShowChunks::open(path, stop);
  if (!show) return show.fault();
  v1::BeginPushRequest begin;
  begin.set_sha256(show->sha256());
  begin.set_size_bytes(show->size_bytes());
  for (const Sha256Value& digest : show->chunk_sha256()) begin.add_chunk_sha256(digest.data(), digest.size());
  // Before the first chunk and after the last the rig reads what it has: 20 MB a second are slow.
  const milliseconds patient = std::max(rig.deadline(), milliseconds(60'000 + show->size_bytes() / 20'000));
  const Result<v1::PushProgress> begun = rig.holding(&v1::Rig::Stub::BeginPush, begin, patient, stop);
  if (!begun) return begun.fault();
  if (!begun->complete()) {
    if (Status sent = send_chunks(*show, begun->received_bytes()); !sent) return sent;
    v1::FinishPushRequest finish;
    finish.set_sha256(show->sha256());
    const auto verified = rig.holding(&v1::Rig::Stub::FinishPush, finish, patient, stop);
    if (!verified) return verified.fault();
  }
  if (progress) progress(1.0);
  if (!activate) return {};
  v1::ActivateRequest request;
  request.set_sha256(show->sha256());
  const auto active = rig.holding(&v1::Rig::Stub::Activate, request, patient, stop);
  if (!active) return active.fault();
  return {};
}

}  // namespace

RigClient::RigClient(std::shared_ptr<RigConnection> connection) : connection_(std::move(connection)) {}
RigClient::RigClient(RigClient&&) noexcept = default;
RigClient& RigClient::operator=(RigClient&&) noexcept = default;
RigClient::~RigClient() = default;

Result<RigClient> RigClient::connect(const std::string& host_port, milliseconds deadline) {
  Result<std::shared_ptr<RigConnection>> connection = RigConnection::open(host_port, deadline);
  if (!connection) return connection.fault();
  return RigClient(std::move(*connection));
}

bool RigClient::reachable() const { return connection_->reachable(); }

Result<RigDescription> RigClient::describe(double frequency_hz) {
  v1::DescribeRequest request;
  request.set_frequency_hz(frequency_hz);
  const auto reply = connection_->call(&v1::Rig::Stub::Describe, request, connection_->deadline());
  if (!reply) return reply.fault();
  return description_from(*reply);
}

Status RigClient::push(const std::filesystem::path& show, bool activate,
                       const std::function<void(double share)>& progress, std::stop_token stop) {
  Status pushed = Push{*connection_, progress, stop}.send(show, activate);
  if (!pushed && (stop.stop_requested() || pushed.fault().code == "rig.cancelled")) {
    return cancelled(connection_->address());
  }
  return pushed;
}

Status RigClient::play(std::uint64_t sweeps) {
  v1::PlayRequest request;
  request.set_sweeps(sweeps);
  return command(*connection_, &v1::Rig::Stub::Play, request);
}

Status RigClient::hold() { return command(*connection_, &v1::Rig::Stub::Hold, v1::HoldRequest()); }

Status RigClient::blackout() {
  const auto reply = connection_->call(&v1::Rig::Stub::Blackout, v1::BlackoutRequest(), connection_->deadline());
  if (!reply) return reply.fault();
  return {};
}

Status RigClient::go() { return command(*connection_, &v1::Rig::Stub::Go, v1::GoRequest()); }

Status RigClient::cue(const std::string& name) {
  v1::CueRequest request;
  request.set_name(name);
  return command(*connection_, &v1::Rig::Stub::Cue, request);
}

Status RigClient::next() { return command(*connection_, &v1::Rig::Stub::Next, v1::NextRequest()); }

Status RigClient::back() { return command(*connection_, &v1::Rig::Stub::Back, v1::BackRequest()); }

Result<RigState> RigClient::state() {
  const auto reply = connection_->call(&v1::Rig::Stub::GetState, v1::GetStateRequest(), connection_->deadline());
  if (!reply) return reply.fault();
  return state_from(*reply);
}

Result<DeviceListing> RigClient::devices() {
  // Drivers look one after the other, and some wait for an answer.
  const auto reply = connection_->call(&v1::Rig::Stub::ListDevices, v1::ListDevicesRequest(),
                                       std::max(connection_->deadline(), milliseconds(30'000)));
  if (!reply) return reply.fault();
  return listing_from(*reply);
}

Status RigClient::identify(const std::string& driver, const std::string& serial) {
  v1::IdentifyRequest request;
  request.set_driver(driver);
  request.set_serial(serial);
  const auto reply =
      connection_->holding(&v1::Rig::Stub::Identify, request, std::max(connection_->deadline(), milliseconds(10'000)));
  if (!reply) return reply.fault();
  return {};
}

Status RigClient::watch(milliseconds interval, const std::function<bool(const RigState&)>& seen, std::stop_token stop) {
  v1::WatchRequest request;
  request.set_interval_s(std::chrono::duration<double>(interval).count());
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::hours(24));
  const auto reader = connection_->stub().Watch(&context, request);
  // A runtime that hangs keeps its connection open: only its silence tells.
  SilenceWatch silence(interval + milliseconds(900), [&] { context.TryCancel(); });
  const std::stop_callback on_stop(stop, [&] { context.TryCancel(); });
  v1::RigState message;
  bool wanted = true;
  while (wanted && reader->Read(&message)) {
    silence.heard();
    wanted = seen(state_from(message));
  }
  context.TryCancel();
  const grpc::Status status = reader->Finish();
  if (!wanted || stop.stop_requested()) return {};
  if (silence.fell_silent()) {
    return Fault{"rig.unreachable", connection_->address(), "the rig fell silent", "look at the rig's log"};
  }
  return connection_->lost(status);
}

}  // namespace focalstage
