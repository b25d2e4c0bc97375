#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace focalstage {

/// A certificate and its private key, PEM.
struct Issued {
  std::string certificate;
  std::string key;
};

/// Seconds since 1970, UTC.
struct Validity {
  std::int64_t from_s = 0;
  std::int64_t until_s = 0;
};

/// From an hour ago, because clocks differ, for so many days.
Validity valid_for(int days);

/// A certificate authority of a rig's own: ECDSA on P-256, X.509 v3.
Result<Issued> make_authority(const std::string& name, const Validity& validity);

/// A certificate that a rig shows, for the host names and IP addresses by which it is reached.
Result<Issued> make_rig_certificate(const Issued& authority, const std::vector<std::string>& hosts,
                                    const Validity& validity);

/// A certificate by which a client is known: `name` is its common name, at most 64 bytes.
Result<Issued> make_client_certificate(const Issued& authority, const std::string& name, const Validity& validity);

struct CertificateFacts {
  std::string common_name;
  std::string fingerprint;  ///< SHA-256 of it, lower-case hex
  Validity validity;
  std::vector<std::string> hosts;
};

/// The first certificate of a PEM text. "credentials.damaged"; `source` names it.
Result<CertificateFacts> read_certificate(const std::string& pem, const std::string& source);

/// Whether the key is the certificate's.
bool belong_together(const std::string& certificate, const std::string& key);

/// "2026-01-31 14:05 UTC"
std::string date_text(std::int64_t time_s);

}  // namespace focalstage
