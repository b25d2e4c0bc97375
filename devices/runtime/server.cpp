#include "devices/runtime/server.h"

#include <sys/socket.h>
#include <unistd.h>

#include <utility>
#include <vector>

#include <grpcpp/ext/proto_server_reflection_plugin.h>
#include <grpcpp/grpcpp.h>
#include <grpcpp/health_check_service_interface.h>
#include <grpcpp/impl/server_builder_option.h>
#include <grpcpp/impl/server_builder_plugin.h>
#include <grpcpp/resource_quota.h>

#include "devices/runtime/sockets.h"
#include "io/protocol/limits.h"

namespace focalstage {

namespace {

/// Whoever shakes no hands in this time is shown out.
constexpr int handshake_ms = 5000;
constexpr int most_threads = 256;

/// The library gives reflection to every server of a program that links it.
class WithoutReflection final : public grpc::ServerBuilderOption {
 public:
  void UpdateArguments(grpc::ChannelArguments*) override {}
  void UpdatePlugins(std::vector<std::unique_ptr<grpc::ServerBuilderPlugin>>* plugins) override {
    std::erase_if(*plugins, [](const auto& plugin) { return plugin->name().find("reflection") != std::string::npos; });
  }
};

std::shared_ptr<grpc::ServerCredentials> server_credentials(const std::optional<Credentials>& ours) {
  if (!ours) return grpc::InsecureServerCredentials();
  grpc::SslServerCredentialsOptions options(GRPC_SSL_REQUEST_AND_REQUIRE_CLIENT_CERTIFICATE_AND_VERIFY);
  options.pem_root_certs = ours->authority;
  options.pem_key_cert_pairs.push_back({ours->key, ours->certificate});
  return grpc::SslServerCredentials(options);
}

void bound(grpc::ServerBuilder& builder, const NetworkConfig& network) {
  builder.SetMaxReceiveMessageSize(network.message_bytes_max);
  builder.SetMaxSendMessageSize(message_limit_bytes);
  builder.AddChannelArgument(GRPC_ARG_MAX_CONCURRENT_STREAMS, network.streams_per_connection_max);
  builder.AddChannelArgument(GRPC_ARG_SERVER_HANDSHAKE_TIMEOUT_MS, handshake_ms);
  // A client that vanished without a word gives its place back.
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIME_MS, 20'000);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, 10'000);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1);
  builder.SetResourceQuota(grpc::ResourceQuota("runtime").SetMaxThreads(most_threads));
}

Result<std::optional<Credentials>> credentials_of(const NetworkConfig& network) {
  if (network.certificate.empty()) return std::optional<Credentials>();
  Result<Credentials> ours = load_credentials(network.certificate, network.key, network.client_ca);
  if (!ours) return ours.fault();
  return std::optional<Credentials>(std::move(*ours));
}

}  // namespace

Status may_listen(const std::string& listen, const NetworkConfig& network) {
  const Result<HostPort> address = host_port(listen);
  if (!address) return address.fault();
  if (!network.certificate.empty() || is_loopback(*address)) return {};
  return Fault{"runtime.not-loopback", listen, "without certificates a rig is reached from its own machine only",
               "listen on 127.0.0.1, or make certificates with focalstage pair"};
}

Result<std::unique_ptr<RigServer>> RigServer::start(const std::string& listen, const NetworkConfig& network,
                                                    grpc::Service& service) {
  if (Status may = may_listen(listen, network); !may) return may.fault();
  const auto ours = credentials_of(network);
  if (!ours) return ours.fault();
  silence_grpc();
  grpc::EnableDefaultHealthCheckService(true);
  const bool reflects = network.reflection.value_or(!*ours);
  if (reflects) grpc::reflection::InitProtoReflectionServerBuilderPlugin();
  grpc::ServerBuilder builder;
  bound(builder, network);
  if (!reflects) builder.SetOption(std::make_unique<WithoutReflection>());
  std::shared_ptr<grpc::experimental::ExternalConnectionAcceptor> door =
      builder.experimental().AddExternalConnectionAcceptor(
          grpc::ServerBuilder::experimental_type::ExternalConnectionType::FROM_FD, server_credentials(*ours));
  builder.RegisterService(&service);
  Result<BoundSocket> socket = bind_socket(*host_port(listen), SOCK_STREAM);
  if (!socket) return socket.fault();
  std::unique_ptr<RigServer> made(new RigServer());
  made->server_ = builder.BuildAndStart();
  if (!made->server_) {
    close(socket->descriptor);
    return Fault{"runtime.server", listen, "the server could not be started", "look at its certificates"};
  }
  made->address_ = socket->address;
  made->doorman_ = std::make_unique<Doorman>(
      socket->descriptor, Doorman::Settings{network.connections_max, network.connections_per_peer_max},
      [door, listener = socket->descriptor](int connection) {
        grpc::experimental::ExternalConnectionAcceptor::NewConnectionParameters arrived;
        arrived.listener_fd = listener;
        arrived.fd = connection;
        door->HandleNewConnection(&arrived);
      });
  return made;
}

RigServer::~RigServer() {
  doorman_.reset();  // nobody comes in any more
  if (server_) server_->Shutdown(std::chrono::system_clock::now() + std::chrono::milliseconds(200));
}

}  // namespace focalstage
