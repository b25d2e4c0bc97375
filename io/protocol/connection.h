#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>

#include <grpcpp/grpcpp.h>

#include "core/base/result.h"
#include "focalstage/v1/rig.grpc.pb.h"
#include "io/protocol/convert.h"

namespace focalstage {

/// A channel to a runtime and the lease taken over it, shared by a client and its live link. Every call may come from
/// any thread and has a deadline. A runtime that was gone and is back is reached again by the next call.
class RigConnection {
 public:
  using Milliseconds = std::chrono::milliseconds;

  /// Over mutual TLS where this user was paired with the rig (io/credentials), else without. "rig.unreachable" where
  /// nobody answers within the deadline; "rig.unpaired", "rig.certificate", "credentials.*" where the certificates are
  /// why.
  static Result<std::shared_ptr<RigConnection>> open(const std::string& host_port, Milliseconds deadline);
  ~RigConnection();  ///< gives the rig back

  const std::string& address() const { return address_; }
  Milliseconds deadline() const { return deadline_; }
  v1::Rig::Stub& stub() { return *stub_; }

  /// Why a stream ended that this program did not end.
  Fault lost(const grpc::Status& status) const;

  /// Whether the runtime is there, as far as the channel knows; where not, begins to look for it.
  bool reachable() const;

  /// The lease's token; takes the rig where it is not held. "rig.held".
  Result<std::string> token();

  /// The token turned out to be of no lease any more.
  void forget(const std::string& token);

  template <class Reply, class Request>
  using Method = grpc::Status (v1::Rig::Stub::*)(grpc::ClientContext*, const Request&, Reply*);

  /// One call. A stop request ends it.
  template <class Reply, class Request>
  Result<Reply> call(Method<Reply, Request> method, const Request& request, Milliseconds at_most,
                     const std::stop_token& stop = {}) {
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + at_most);
    const std::stop_callback on_stop(stop, [&] { context.TryCancel(); });
    Reply reply;
    const grpc::Status status = (stub_.get()->*method)(&context, request, &reply);
    if (!status.ok()) return fault_from(status, address_);
    return reply;
  }

  /// One call that needs the rig for oneself. A lease that ran out meanwhile is asked for again, once.
  template <class Reply, class Request>
  Result<Reply> holding(Method<Reply, Request> method, Request request, Milliseconds at_most,
                        const std::stop_token& stop = {}) {
    for (int attempt = 0;; ++attempt) {
      const Result<std::string> mine = token();
      if (!mine) return mine.fault();
      // Whoever was stopped while it took the rig has a lease to give back, and nothing more to ask.
      if (stop.stop_requested()) return Fault{"rig.cancelled", address_, "was stopped", "ask again"};
      request.set_token(*mine);
      Result<Reply> reply = call(method, request, at_most, stop);
      if (reply || reply.fault().code != "rig.lease" || attempt > 0) return reply;
      forget(*mine);
    }
  }

 private:
  RigConnection(std::string address, Milliseconds deadline, std::shared_ptr<grpc::Channel> channel);

  std::string address_;
  Milliseconds deadline_;
  std::shared_ptr<grpc::Channel> channel_;
  std::unique_ptr<v1::Rig::Stub> stub_;
  std::mutex mutex_;
  std::string token_;
};

}  // namespace focalstage
