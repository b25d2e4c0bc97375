#include "io/protocol/connection.h"

#include <unistd.h>
#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "io/credentials/diagnose.h"
#include "io/protocol/limits.h"

namespace focalstage {

namespace {

std::string holder_name() {
  std::array<char, 256> host{};
  if (gethostname(host.data(), host.size() - 1) != 0) return "somebody";
  return std::string(host.data()) + ":" + std::to_string(getpid());
}

std::shared_ptr<grpc::ChannelCredentials> channel_credentials(const std::optional<Credentials>& pair) {
  if (!pair) return grpc::InsecureChannelCredentials();
  return grpc::SslCredentials({pair->authority, pair->key, pair->certificate});
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

}  // namespace

RigConnection::RigConnection(std::string address, Milliseconds deadline, std::shared_ptr<grpc::Channel> channel)
    : address_(std::move(address)),
      deadline_(deadline),
      channel_(std::move(channel)),
      stub_(v1::Rig::NewStub(channel_)) {}

Result<std::shared_ptr<RigConnection>> RigConnection::open(const std::string& host_port, Milliseconds deadline) {
  silence_grpc();
  const Result<std::optional<Credentials>> pair = find_pair(host_port);
  if (!pair) return pair.fault();
  std::shared_ptr<grpc::Channel> channel =
      grpc::CreateCustomChannel(host_port, channel_credentials(*pair), channel_arguments());
  if (!channel->WaitForConnected(std::chrono::system_clock::now() + deadline)) {
    return diagnose_connection(host_port, *pair, std::min(deadline, Milliseconds(1000)));
  }
  return std::shared_ptr<RigConnection>(new RigConnection(host_port, deadline, std::move(channel)));
}

RigConnection::~RigConnection() {
  if (token_.empty()) return;
  v1::ReleaseRequest request;
  request.set_token(token_);
  (void)call(&v1::Rig::Stub::Release, request, Milliseconds(500));
}

Fault RigConnection::lost(const grpc::Status& status) const {
  if (status.ok() || status.error_code() == grpc::StatusCode::CANCELLED) {
    return {"rig.unreachable", address_, "the rig ended the connection", "see whether it runs, then begin again"};
  }
  return fault_from(status, address_);
}

bool RigConnection::reachable() const { return channel_->GetState(true) == GRPC_CHANNEL_READY; }

Result<std::string> RigConnection::token() {
  const std::lock_guard lock(mutex_);  // also while asking: two threads that need the rig take it once
  if (!token_.empty()) return token_;
  v1::AcquireRequest request;
  request.set_holder(holder_name());
  Result<v1::Lease> lease = call(&v1::Rig::Stub::Acquire, request, deadline_);
  if (!lease) return lease.fault();
  token_ = lease->token();
  return token_;
}

void RigConnection::forget(const std::string& token) {
  const std::lock_guard lock(mutex_);
  if (token_ == token) token_.clear();
}

}  // namespace focalstage
