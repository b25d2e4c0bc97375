#include "io/credentials/diagnose.h"

#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/time.h>

#include <cerrno>

#include <openssl/err.h>
#include <openssl/sslerr.h>
#include <openssl/x509v3.h>

#include "io/credentials/certificates.h"
#include "io/credentials/openssl.h"
#include "io/files/descriptor.h"

namespace focalstage {

namespace {

using std::chrono::milliseconds;
using ContextPointer = OpensslPointer<SSL_CTX, SSL_CTX_free>;
using SslPointer = OpensslPointer<SSL, SSL_free>;

Fault unreachable(const std::string& where) {
  return {"rig.unreachable", where, "no rig answers there",
          "start focalstage-runtime, or give the HOST:PORT where it runs"};
}

Fault unpaired(const std::string& where) {
  return {"rig.unpaired", where, "this rig wants a certificate, and none is kept for it here",
          "let its keeper make one with focalstage pair client, then focalstage pair import FILE --to " + where};
}

Fault bad_certificate(const std::string& where, std::string message, std::string remedy) {
  return {"rig.certificate", where, std::move(message), std::move(remedy)};
}

/// A connection within `patience`, blocking afterwards for as long in each step; not open where there is none.
Descriptor connect(const std::string& host_port, milliseconds patience) {
  const std::size_t colon = host_port.rfind(':');
  if (colon == std::string::npos) return Descriptor(-1);
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (getaddrinfo(host_of(host_port).c_str(), host_port.substr(colon + 1).c_str(), &hints, &found) != 0) {
    return Descriptor(-1);
  }
  const OpensslPointer<addrinfo, freeaddrinfo> owned(found);
  const timeval time{static_cast<time_t>(patience.count() / 1000),
                     static_cast<suseconds_t>(1000 * (patience.count() % 1000))};
  for (const addrinfo* at = found; at != nullptr; at = at->ai_next) {
    Descriptor socket(::socket(at->ai_family, at->ai_socktype | SOCK_CLOEXEC, at->ai_protocol));
    if (!socket.open()) continue;
    setsockopt(socket.number(), SOL_SOCKET, SO_RCVTIMEO, &time, sizeof time);
    setsockopt(socket.number(), SOL_SOCKET, SO_SNDTIMEO, &time, sizeof time);  // of connect too
    if (::connect(socket.number(), at->ai_addr, at->ai_addrlen) == 0) return socket;
  }
  return Descriptor(-1);
}

/// Trusts the authority and nobody else, and goes on to the end to see what is wrong.
ContextPointer context_for(const std::optional<Credentials>& credentials) {
  ContextPointer context(SSL_CTX_new(TLS_client_method()));
  if (!context) return context;
  SSL_CTX_set_verify(context.get(), SSL_VERIFY_NONE, nullptr);
  static constexpr unsigned char http2[] = {2, 'h', '2'};
  SSL_CTX_set_alpn_protos(context.get(), http2, sizeof http2);
  if (!credentials) return context;
  const CertificatePointer authority = certificate_from(credentials->authority);
  const CertificatePointer own = certificate_from(credentials->certificate);
  const KeyPointer key = key_from(credentials->key);
  if (!authority || !own || !key) return nullptr;
  X509_STORE_add_cert(SSL_CTX_get_cert_store(context.get()), authority.get());
  SSL_CTX_use_certificate(context.get(), own.get());
  SSL_CTX_use_PrivateKey(context.get(), key.get());
  return context;
}

void expect_host(SSL* ssl, const std::string& host) {
  X509_VERIFY_PARAM* wanted = SSL_get0_param(ssl);
  if (X509_VERIFY_PARAM_set1_ip_asc(wanted, host.c_str()) != 1) {
    X509_VERIFY_PARAM_set1_host(wanted, host.c_str(), host.size());
  }
}

/// What is wrong with the certificate that the rig shows, if anything.
std::optional<Fault> rig_fault(const std::string& host_port, SSL* ssl) {
  const long result = SSL_get_verify_result(ssl);
  if (result == X509_V_OK) return std::nullopt;
  const CertificatePointer shown(SSL_get1_peer_certificate(ssl));
  std::string until;
  std::string hosts;
  if (shown) {
    const BioPointer bio(BIO_new(BIO_s_mem()));
    PEM_write_bio_X509(bio.get(), shown.get());
    char* bytes = nullptr;
    const long size = BIO_get_mem_data(bio.get(), &bytes);
    const auto facts = read_certificate({bytes, static_cast<std::size_t>(size)}, host_port);
    if (facts) {
      until = date_text(facts->validity.until_s);
      for (const std::string& host : facts->hosts) hosts += (hosts.empty() ? "" : ", ") + host;
    }
  }
  if (result == X509_V_ERR_CERT_HAS_EXPIRED) {
    return bad_certificate(host_port, "the rig's certificate ended on " + until,
                           "let its keeper make a new one: focalstage pair rig");
  }
  if (result == X509_V_ERR_HOSTNAME_MISMATCH || result == X509_V_ERR_IP_ADDRESS_MISMATCH) {
    return bad_certificate(host_port, "the rig's certificate is for " + hosts + ", not for this host",
                           "reach it by a name it is made for, or let its keeper make one: focalstage pair rig --host");
  }
  return bad_certificate(host_port,
                         "the rig's certificate is not of the authority this computer was paired with (" +
                             std::string(X509_verify_cert_error_string(result)) + ")",
                         "see that this is the right rig, then pair with it again");
}

Fault not_taken(const std::string& host_port) {
  return bad_certificate(
      host_port,
      "the rig does not take this computer's certificate: it is of another authority, or over by the "
      "rig's clock",
      "see both clocks, or let its keeper make a new one: focalstage pair client");
}

/// After a handshake the rig speaks first. One that hangs up instead did not like what it was shown: in TLS 1.3 that
/// comes after the handshake, and with or without an alert.
std::optional<Fault> refusal_after(const std::string& host_port, SSL* ssl) {
  ERR_clear_error();
  errno = 0;
  char byte = 0;
  const int count = SSL_read(ssl, &byte, 1);
  if (count > 0 || SSL_get_error(ssl, count) == SSL_ERROR_WANT_READ || errno == EAGAIN) return std::nullopt;
  return not_taken(host_port);
}

/// Why there was no handshake.
Fault refusal_before(const std::string& host_port, const std::optional<Credentials>& credentials) {
  switch (ERR_GET_REASON(ERR_peek_last_error())) {
    case SSL_R_TLSV13_ALERT_CERTIFICATE_REQUIRED:
      return unpaired(host_port);
    case SSL_R_SSLV3_ALERT_CERTIFICATE_EXPIRED:
    case SSL_R_TLSV1_ALERT_UNKNOWN_CA:
    case SSL_R_SSLV3_ALERT_BAD_CERTIFICATE:
    case SSL_R_SSLV3_ALERT_CERTIFICATE_UNKNOWN:
      return not_taken(host_port);
    case SSL_R_WRONG_VERSION_NUMBER:
      if (!credentials) break;
      return bad_certificate(host_port, "who listens there speaks without certificates",
                             "see that this is the right rig, and that its configuration names its certificate");
    default:
      break;
  }
  return {"rig.unreachable", host_port, "who listens there hangs up: no rig, or one that has too many connections",
          "see what runs there, and look at its log"};
}

}  // namespace

Fault diagnose_connection(const std::string& host_port, const std::optional<Credentials>& credentials,
                          milliseconds patience) {
  const Descriptor socket = connect(host_port, patience);
  const ContextPointer context = context_for(credentials);
  if (!socket.open() || !context) return unreachable(host_port);
  const SslPointer ssl(SSL_new(context.get()));
  if (!ssl || SSL_set_fd(ssl.get(), socket.number()) != 1) return unreachable(host_port);
  expect_host(ssl.get(), host_of(host_port));
  ERR_clear_error();
  const bool shaken = SSL_connect(ssl.get()) == 1;
  Fault fault = unreachable(host_port);
  if (!shaken) {
    fault = refusal_before(host_port, credentials);
  } else if (!credentials) {
    fault = unpaired(host_port);
  } else if (const auto of_rig = rig_fault(host_port, ssl.get())) {
    fault = *of_rig;
  } else if (const auto refused = refusal_after(host_port, ssl.get())) {
    fault = *refused;
  }
  ERR_clear_error();
  return fault;
}

}  // namespace focalstage
