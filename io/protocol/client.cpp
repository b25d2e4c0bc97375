#include "io/protocol/client.h"

#include <unistd.h>
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <grpcpp/grpcpp.h>

#include "focalstage/v1/rig.grpc.pb.h"
#include "io/protocol/convert.h"
#include "io/protocol/limits.h"
#include "io/protocol/show_chunks.h"

namespace focalstage {

namespace {

using std::chrono::milliseconds;

std::string holder_name() {
  std::array<char, 256> host{};
  if (gethostname(host.data(), host.size() - 1) != 0) return "somebody";
  return std::string(host.data()) + ":" + std::to_string(getpid());
}

grpc::ChannelArguments channel_arguments() {
  grpc::ChannelArguments arguments;
  arguments.SetMaxReceiveMessageSize(message_limit_bytes);
  arguments.SetMaxSendMessageSize(message_limit_bytes);
  arguments.SetInt(GRPC_ARG_ENABLE_HTTP_PROXY, 0);  // a rig is never behind the proxy of the web
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, 200);
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, 50);
  return arguments;
}

Fault cancelled(const std::string& address) {
  return {"rig.cancelled", address, "the push was stopped", "push again: it goes on where it stopped"};
}

}  // namespace

struct RigClient::State {
  std::string address;
  milliseconds deadline;
  std::unique_ptr<v1::Rig::Stub> stub;
  std::string token;
  std::stop_token stop;  ///< of the push in progress: a stop request ends the call it is in

  /// One call with a deadline; `until` ends it before.
  template <class Reply, class Request>
  Result<Reply> call(grpc::Status (v1::Rig::Stub::*method)(grpc::ClientContext*, const Request&, Reply*),
                     const Request& request, milliseconds at_most, const std::stop_token& until) {
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + at_most);
    const std::stop_callback on_stop(until, [&] { context.TryCancel(); });
    Reply reply;
    const grpc::Status status = (stub.get()->*method)(&context, request, &reply);
    if (!status.ok()) return fault_from(status, address);
    return reply;
  }

  template <class Reply, class Request>
  Result<Reply> call(grpc::Status (v1::Rig::Stub::*method)(grpc::ClientContext*, const Request&, Reply*),
                     const Request& request, milliseconds at_most) {
    return call(method, request, at_most, stop);
  }

  /// No stop request ends this call: the rig may have given a lease of which only the answer tells, and nobody could
  /// give it back.
  Status acquire() {
    v1::AcquireRequest request;
    request.set_holder(holder_name());
    Result<v1::Lease> lease = call(&v1::Rig::Stub::Acquire, request, deadline, std::stop_token());
    if (!lease) return lease.fault();
    token = lease->token();
    return {};
  }

  /// One call that needs the rig for oneself. A lease that ran out meanwhile is asked for again, once.
  template <class Reply, class Request>
  Result<Reply> holding(grpc::Status (v1::Rig::Stub::*method)(grpc::ClientContext*, const Request&, Reply*),
                        Request request, milliseconds at_most) {
    for (int attempt = 0;; ++attempt) {
      if (token.empty()) {
        if (Status held = acquire(); !held) return held.fault();
      }
      if (stop.stop_requested()) return cancelled(address);
      request.set_token(token);
      Result<Reply> reply = call(method, request, at_most);
      if (reply || reply.fault().code != "rig.lease" || attempt > 0) return reply;
      token.clear();
    }
  }

  template <class Request>
  Status command(grpc::Status (v1::Rig::Stub::*method)(grpc::ClientContext*, const Request&, v1::RigState*),
                 const Request& request) {
    const Result<v1::RigState> reply = holding(method, request, std::max(deadline, milliseconds(10'000)));
    if (!reply) return reply.fault();
    return {};
  }

  Status push(const std::filesystem::path& path, bool activate, const std::function<void(double)>& progress);
  Status send_chunks(const ShowChunks& show, std::uint64_t received, const std::function<void(double)>& progress);
};

RigClient::RigClient(std::unique_ptr<State> state) : state_(std::move(state)) {}
RigClient::RigClient(RigClient&&) noexcept = default;
RigClient& RigClient::operator=(RigClient&&) noexcept = default;

RigClient::~RigClient() {
  if (!state_ || state_->token.empty()) return;
  v1::ReleaseRequest request;
  request.set_token(state_->token);
  (void)state_->call(&v1::Rig::Stub::Release, request, milliseconds(500));
}

Result<RigClient> RigClient::connect(const std::string& host_port, milliseconds deadline) {
  silence_grpc();
  const std::shared_ptr<grpc::Channel> channel =
      grpc::CreateCustomChannel(host_port, grpc::InsecureChannelCredentials(), channel_arguments());
  if (!channel->WaitForConnected(std::chrono::system_clock::now() + deadline)) {
    return Fault{"rig.unreachable", host_port, "no rig answers there",
                 "start focalstage-runtime, or name its HOST:PORT with --to"};
  }
  auto state = std::make_unique<State>();
  state->address = host_port;
  state->deadline = deadline;
  state->stub = v1::Rig::NewStub(channel);
  return RigClient(std::move(state));
}

Result<RigDescription> RigClient::describe(double frequency_hz) {
  v1::DescribeRequest request;
  request.set_frequency_hz(frequency_hz);
  const Result<v1::RigDescription> reply = state_->call(&v1::Rig::Stub::Describe, request, state_->deadline);
  if (!reply) return reply.fault();
  return description_from(*reply);
}

Status RigClient::State::send_chunks(const ShowChunks& show, std::uint64_t received,
                                     const std::function<void(double)>& progress) {
  while (received < show.size_bytes()) {
    if (stop.stop_requested()) return cancelled(address);
    Result<std::string> data = show.read(received / push_chunk_bytes);
    if (!data) return data.fault();
    v1::PushChunkRequest request;
    request.set_sha256(show.sha256());
    request.set_offset_bytes(received);
    request.set_data(std::move(*data));
    const Result<v1::PushProgress> reply =
        holding(&v1::Rig::Stub::PushChunk, std::move(request), std::max(deadline, milliseconds(30'000)));
    if (!reply) return reply.fault();
    if (reply->received_bytes() <= received) {
      return Fault{"rig.refused", address, "the rig did not take a chunk and did not say why", "look at the rig's log"};
    }
    received = reply->received_bytes();
    if (progress) progress(static_cast<double>(received) / static_cast<double>(show.size_bytes()));
  }
  return {};
}

Status RigClient::State::push(const std::filesystem::path& path, bool activate,
                              const std::function<void(double)>& progress) {
  const Result<ShowChunks> show = ShowChunks::open(path, stop);
  if (!show) return show.fault();
  v1::BeginPushRequest begin;
  begin.set_sha256(show->sha256());
  begin.set_size_bytes(show->size_bytes());
  for (const Sha256Value& digest : show->chunk_sha256()) begin.add_chunk_sha256(digest.data(), digest.size());
  // Before the first chunk and after the last the rig reads what it has: 20 MB a second are slow.
  const milliseconds patient = std::max(deadline, milliseconds(60'000 + show->size_bytes() / 20'000));
  const Result<v1::PushProgress> begun = holding(&v1::Rig::Stub::BeginPush, begin, patient);
  if (!begun) return begun.fault();
  if (!begun->complete()) {
    if (Status sent = send_chunks(*show, begun->received_bytes(), progress); !sent) return sent;
    v1::FinishPushRequest finish;
    finish.set_sha256(show->sha256());
    const auto verified = holding(&v1::Rig::Stub::FinishPush, finish, patient);
    if (!verified) return verified.fault();
  }
  if (progress) progress(1.0);
  if (!activate) return {};
  v1::ActivateRequest request;
  request.set_sha256(show->sha256());
  const auto active = holding(&v1::Rig::Stub::Activate, request, patient);
  if (!active) return active.fault();
  return {};
}

Status RigClient::push(const std::filesystem::path& show, bool activate,
                       const std::function<void(double share)>& progress, std::stop_token stop) {
  state_->stop = std::move(stop);
  Status pushed = state_->push(show, activate, progress);
  const bool stopped = state_->stop.stop_requested();
  state_->stop = {};
  if (!pushed && (stopped || pushed.fault().code == "rig.cancelled")) return cancelled(state_->address);
  return pushed;
}

Status RigClient::play(std::uint64_t sweeps) {
  v1::PlayRequest request;
  request.set_sweeps(sweeps);
  return state_->command(&v1::Rig::Stub::Play, request);
}

Status RigClient::hold() { return state_->command(&v1::Rig::Stub::Hold, v1::HoldRequest()); }

Status RigClient::blackout() {
  const auto reply = state_->call(&v1::Rig::Stub::Blackout, v1::BlackoutRequest(), state_->deadline);
  if (!reply) return reply.fault();
  return {};
}

Status RigClient::go() { return state_->command(&v1::Rig::Stub::Go, v1::GoRequest()); }

Status RigClient::cue(const std::string& name) {
  v1::CueRequest request;
  request.set_name(name);
  return state_->command(&v1::Rig::Stub::Cue, request);
}

Result<RigState> RigClient::state() {
  const auto reply = state_->call(&v1::Rig::Stub::GetState, v1::GetStateRequest(), state_->deadline);
  if (!reply) return reply.fault();
  return state_from(*reply);
}

Status RigClient::watch(milliseconds interval, const std::function<bool(const RigState&)>& seen) {
  v1::WatchRequest request;
  request.set_interval_s(std::chrono::duration<double>(interval).count());
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::hours(24));
  const auto reader = state_->stub->Watch(&context, request);
  v1::RigState message;
  bool wanted = true;
  while (wanted && reader->Read(&message)) wanted = seen(state_from(message));
  context.TryCancel();
  const grpc::Status status = reader->Finish();
  if (!wanted || status.ok()) return {};
  return fault_from(status, state_->address);
}

}  // namespace focalstage
