#include "devices/runtime/guard.h"

#include <utility>

#include <grpcpp/grpcpp.h>

#include "io/credentials/certificates.h"

namespace focalstage {

namespace {

constexpr std::size_t most_rates = 4096;

const char* name_of(Right right) {
  switch (right) {
    case Right::watch:
      return "watch";
    case Right::push:
      return "push";
    case Right::control:
      return "control";
  }
  return "";
}

bool has(const Rights& rights, Right right) {
  switch (right) {
    case Right::watch:
      return rights.watch;
    case Right::push:
      return rights.push;
    case Right::control:
      return rights.control;
  }
  return false;
}

/// Of the certificate that the handshake proved.
Result<CertificateFacts> client_of(const grpc::ServerContext& context) {
  const auto who = context.auth_context();
  const auto shown = who->FindPropertyValues(GRPC_X509_PEM_CERT_PROPERTY_NAME);
  if (!who->IsPeerAuthenticated() || shown.empty()) {
    return Fault{"rig.unauthorised", context.peer(), "this client showed no certificate", "pair it with the rig"};
  }
  return read_certificate({shown.front().data(), shown.front().size()}, context.peer());
}

}  // namespace

Guard::Guard(const NetworkConfig& network, std::vector<ClientConfig> clients)
    : everybody_(network.certificate.empty()), calls_per_s_(network.calls_per_s), clients_(std::move(clients)) {}

Rights Guard::rights_of(const std::string& name, const std::string& fingerprint) const {
  for (const ClientConfig& client : clients_) {
    const bool named = client.name.empty() || client.name == name;
    const bool known = client.fingerprint.empty() || client.fingerprint == fingerprint;
    if (named && known && !(client.name.empty() && client.fingerprint.empty())) return client.rights;
  }
  return {};
}

bool Guard::in_time(const std::string& fingerprint) {
  const std::lock_guard lock(mutex_);
  if (rates_.size() >= most_rates && !rates_.contains(fingerprint)) rates_.clear();
  auto& rate = rates_[fingerprint];
  if (!rate) rate = std::make_unique<RateLimit>(calls_per_s_, 2.0 * calls_per_s_);
  return rate->take();
}

Status Guard::admit(const grpc::ServerContext& context, Right right, bool counts) {
  if (everybody_) return {};
  const Result<CertificateFacts> client = client_of(context);
  if (!client) return client.fault();
  if (!has(rights_of(client->common_name, client->fingerprint), right)) {
    return Fault{"rig.unauthorised", client->common_name,
                 std::string("this client has not the right to ") + name_of(right),
                 "list it with that right among the clients in the rig's configuration"};
  }
  if (!counts || in_time(client->fingerprint)) return {};
  return Fault{"rig.busy", client->common_name, "this client calls too often", "call less often"};
}

}  // namespace focalstage
