#include "io/credentials/credentials.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "io/credentials/certificates.h"
#include "io/files/descriptor.h"
#include "io/files/files.h"

namespace focalstage {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t size_limit = 1u << 20;
constexpr const char* pair_suffix = ".pair";

Result<std::string> read_text(const fs::path& path) {
  const auto bytes = read_file(path, size_limit);
  if (!bytes) return bytes.fault();
  return std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size());
}

Status kept_secret(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0 || (status.st_mode & 077) == 0) return {};
  return Fault{"credentials.mode", path.string(), "others than its owner may read this private key",
               "chmod 600 " + path.string()};
}

/// Whether they can be used at all, now.
Status check(const Credentials& credentials, const std::string& source) {
  const auto facts = read_certificate(credentials.certificate, source);
  if (!facts) return facts.fault();
  if (!belong_together(credentials.certificate, credentials.key)) {
    return Fault{"credentials.key", source, "the private key is not this certificate's", "pair again"};
  }
  if (const auto authority = read_certificate(credentials.authority, source); !authority) return authority.fault();
  const std::int64_t now_s = valid_for(0).until_s;
  if (now_s <= facts->validity.until_s) return {};
  return Fault{"credentials.expired", source,
               "the certificate of " + facts->common_name + " ended on " + date_text(facts->validity.until_s),
               "make a new one with focalstage pair"};
}

/// The parts of a PEM text between the lines that begin and end with that word.
std::string block(const std::string& text, const std::string& what, std::size_t& from) {
  const std::string begin = "-----BEGIN " + what + "-----";
  const std::string end = "-----END " + what + "-----";
  const std::size_t first = text.find(begin, from);
  const std::size_t last = first == std::string::npos ? first : text.find(end, first);
  if (last == std::string::npos) return {};
  from = last + end.size();
  return text.substr(first, from - first) + "\n";
}

/// A file's name for an address: what is no letter, digit, dot, colon or dash is no address.
Result<fs::path> file_for(const std::string& address) {
  const bool fine = !address.empty() && address.front() != '.' &&
                    address.find_first_not_of(
                        "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ.:-_[]%") == std::string::npos;
  if (!fine) return Fault{"credentials.name", address, "this is no address of a rig", "give HOST or HOST:PORT"};
  return credentials_folder() / (address + pair_suffix);
}

}  // namespace

Status write_secret(const fs::path& path, const std::string& text) {
  // What is put in its place keeps its mode: first an empty one with the right mode, then all of it at once.
  const Descriptor made(::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600));
  if (!made.open() || ::fchmod(made.number(), 0600) != 0) {
    return Fault{"file.unwritable", path.string(), "cannot be written: " + std::generic_category().message(errno),
                 "choose another folder"};
  }
  return write_file_atomically(path, text);
}

Result<Credentials> load_credentials(const fs::path& certificate, const fs::path& key, const fs::path& authority) {
  Credentials credentials;
  for (const auto& [path, text] : {std::pair{certificate, &credentials.certificate}, std::pair{key, &credentials.key},
                                   std::pair{authority, &credentials.authority}}) {
    Result<std::string> read = read_text(path);
    if (!read) return read.fault();
    *text = std::move(*read);
  }
  if (Status secret = kept_secret(key); !secret) return secret.fault();
  if (const auto issuer = read_certificate(credentials.authority, authority.string()); !issuer) return issuer.fault();
  if (Status usable = check(credentials, certificate.string()); !usable) return usable.fault();
  return credentials;
}

std::string pair_text(const Credentials& credentials) {
  return credentials.key + credentials.certificate + credentials.authority;
}

Result<Credentials> parse_pair(const std::string& text, const std::string& source) {
  Credentials credentials;
  std::size_t at = 0;
  credentials.key = block(text, "PRIVATE KEY", at);
  credentials.certificate = block(text, "CERTIFICATE", at);
  credentials.authority = block(text, "CERTIFICATE", at);
  if (credentials.key.empty() || credentials.authority.empty()) {
    return Fault{"credentials.damaged", source, "it does not hold a key and two certificates",
                 "make it with focalstage pair client, and bring it here whole"};
  }
  if (Status usable = check(credentials, source); !usable) return usable.fault();
  return credentials;
}

fs::path credentials_folder() {
  if (const char* folder = std::getenv("FOCALSTAGE_CREDENTIALS"); folder != nullptr && *folder != '\0') return folder;
  if (const char* config = std::getenv("XDG_CONFIG_HOME"); config != nullptr && *config == '/') {
    return fs::path(config) / "focalstage" / "rigs";
  }
  const char* home = std::getenv("HOME");
  return fs::path(home != nullptr && *home == '/' ? home : "/var/tmp") / ".config" / "focalstage" / "rigs";
}

Result<fs::path> keep_pair(const Credentials& credentials, const std::string& host_port) {
  const Result<fs::path> file = file_for(host_port);
  if (!file) return file.fault();
  std::error_code problem;
  fs::create_directories(file->parent_path(), problem);
  if (Status written = write_secret(*file, pair_text(credentials)); !written) return written.fault();
  return *file;
}

Result<std::optional<Credentials>> find_pair(const std::string& host_port) {
  for (const std::string& address : {host_port, host_of(host_port)}) {
    const Result<fs::path> file = file_for(address);
    std::error_code problem;
    if (!file || !fs::exists(*file, problem)) continue;
    if (Status secret = kept_secret(*file); !secret) return secret.fault();
    const Result<std::string> text = read_text(*file);
    if (!text) return text.fault();
    Result<Credentials> credentials = parse_pair(*text, file->string());
    if (!credentials) return credentials.fault();
    return std::optional<Credentials>(std::move(*credentials));
  }
  return std::optional<Credentials>();
}

std::string host_of(const std::string& host_port) {
  const std::size_t colon = host_port.rfind(':');
  std::string host = host_port.substr(0, colon);
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
  return host;
}

}  // namespace focalstage
