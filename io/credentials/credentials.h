#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/base/result.h"

namespace focalstage {

/// What one end of a mutual TLS connection has, PEM.
struct Credentials {
  std::string certificate;
  std::string key;
  std::string authority;  ///< that signed the other end's certificate

  bool operator==(const Credentials&) const = default;
};

/// Writes a file that only its owner may read (mode 0600).
Status write_secret(const std::filesystem::path& path, const std::string& text);

/// From three files: "file.*", "credentials.damaged", "credentials.mode" (others may read the key),
/// "credentials.expired", "credentials.key" (not this certificate's).
Result<Credentials> load_credentials(const std::filesystem::path& certificate, const std::filesystem::path& key,
                                     const std::filesystem::path& authority);

/// A client's credentials travel and are kept as one PEM text: key, certificate, authority.
std::string pair_text(const Credentials& credentials);
Result<Credentials> parse_pair(const std::string& text, const std::string& source);

/// Where this user keeps what rigs were paired with: $FOCALSTAGE_CREDENTIALS, or `focalstage/rigs` in the user's
/// configuration.
std::filesystem::path credentials_folder();

/// Keeps `credentials` for the rig at HOST:PORT, or at HOST on any port. Returns the file.
Result<std::filesystem::path> keep_pair(const Credentials& credentials, const std::string& host_port);

/// What is kept for HOST:PORT, else for HOST; none where there is neither. "credentials.*" where it can't be used.
Result<std::optional<Credentials>> find_pair(const std::string& host_port);

/// HOST of HOST:PORT, an IPv6 address without its brackets.
std::string host_of(const std::string& host_port);

}  // namespace focalstage
