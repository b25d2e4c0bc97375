#include "io/credentials/certificates.h"

#include <arpa/inet.h>

#include <array>
#include <chrono>
#include <ctime>

#include <openssl/rand.h>
#include <openssl/x509v3.h>

#include "io/credentials/openssl.h"

namespace focalstage {

namespace {

using NamesPointer = OpensslPointer<GENERAL_NAMES, GENERAL_NAMES_free>;
using ExtensionPointer = OpensslPointer<X509_EXTENSION, X509_EXTENSION_free>;

constexpr std::size_t most_name_bytes = 64;

Fault failed(const std::string& where) {
  return {"credentials.failed", where, "the certificate could not be made", "see whether its name can be one"};
}

template <class Write>
std::string pem_of(Write write) {
  const BioPointer bio(BIO_new(BIO_s_mem()));
  if (!bio || write(bio.get()) != 1) return {};
  char* bytes = nullptr;
  const long size = BIO_get_mem_data(bio.get(), &bytes);
  return {bytes, static_cast<std::size_t>(size)};
}

bool is_ip(const std::string& host) {
  in6_addr address{};
  return inet_pton(AF_INET, host.c_str(), &address) == 1 || inet_pton(AF_INET6, host.c_str(), &address) == 1;
}

bool extend(X509* certificate, X509* issuer, int kind, const std::string& value) {
  X509V3_CTX context{};
  X509V3_set_ctx(&context, issuer, certificate, nullptr, nullptr, 0);
  const ExtensionPointer extension(X509V3_EXT_conf_nid(nullptr, &context, kind, value.c_str()));
  return extension && X509_add_ext(certificate, extension.get(), -1) == 1;
}

bool set_times(X509* certificate, const Validity& validity) {
  return ASN1_TIME_set(X509_getm_notBefore(certificate), static_cast<std::time_t>(validity.from_s)) != nullptr &&
         ASN1_TIME_set(X509_getm_notAfter(certificate), static_cast<std::time_t>(validity.until_s)) != nullptr;
}

/// 127 random bits: never the same twice.
bool set_serial(X509* certificate) {
  std::array<unsigned char, 16> bytes{};
  if (RAND_bytes(bytes.data(), static_cast<int>(bytes.size())) != 1) return false;
  bytes[0] = static_cast<unsigned char>((bytes[0] & 0x7fu) | 0x40u);
  const OpensslPointer<BIGNUM, BN_free> number(BN_bin2bn(bytes.data(), static_cast<int>(bytes.size()), nullptr));
  return number && BN_to_ASN1_INTEGER(number.get(), X509_get_serialNumber(certificate)) != nullptr;
}

bool set_name(X509* certificate, const std::string& name) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(name.data());
  return X509_NAME_add_entry_by_txt(X509_get_subject_name(certificate), "CN", MBSTRING_UTF8, bytes,
                                    static_cast<int>(name.size()), -1, 0) == 1;
}

struct Wanted {
  std::string name;
  Validity validity;
  std::string usage;    ///< of the key
  std::string purpose;  ///< empty: an authority's
  std::string hosts;    ///< as the extension wants them
};

/// Signed by `authority`, or by itself where there is none.
Result<Issued> issue(const Wanted& wanted, const Issued* authority) {
  if (wanted.name.empty() || wanted.name.size() > most_name_bytes) {
    return Fault{"credentials.name", wanted.name, "a name has 1 to 64 bytes", "choose another"};
  }
  const KeyPointer key(EVP_EC_gen("P-256"));
  const CertificatePointer certificate(X509_new());
  const CertificatePointer issuer = authority ? certificate_from(authority->certificate) : nullptr;
  const KeyPointer issuer_key = authority ? key_from(authority->key) : nullptr;
  if (authority && (!issuer || !issuer_key)) {
    return Fault{"credentials.damaged", "authority", "its certificate or key cannot be read", "make a new one"};
  }
  X509* made = certificate.get();
  X509* by = issuer ? issuer.get() : made;
  const bool done =
      key && made != nullptr && X509_set_version(made, 2) == 1 && set_serial(made) &&
      set_times(made, wanted.validity) && set_name(made, wanted.name) &&
      X509_set_issuer_name(made, X509_get_subject_name(by)) == 1 && X509_set_pubkey(made, key.get()) == 1 &&
      extend(made, by, NID_basic_constraints, authority ? "critical,CA:FALSE" : "critical,CA:TRUE,pathlen:0") &&
      extend(made, by, NID_key_usage, wanted.usage) && extend(made, by, NID_subject_key_identifier, "hash") &&
      extend(made, by, NID_authority_key_identifier, "keyid:always") &&
      (wanted.purpose.empty() || extend(made, by, NID_ext_key_usage, wanted.purpose)) &&
      (wanted.hosts.empty() || extend(made, by, NID_subject_alt_name, wanted.hosts)) &&
      X509_sign(made, issuer_key ? issuer_key.get() : key.get(), EVP_sha256()) > 0;
  if (!done) return failed(wanted.name);
  Issued issued;
  issued.certificate = pem_of([&](BIO* bio) { return PEM_write_bio_X509(bio, made); });
  issued.key =
      pem_of([&](BIO* bio) { return PEM_write_bio_PrivateKey(bio, key.get(), nullptr, nullptr, 0, nullptr, nullptr); });
  if (issued.certificate.empty() || issued.key.empty()) return failed(wanted.name);
  return issued;
}

std::int64_t seconds_of(const ASN1_TIME* time) {
  std::tm parts{};
  return ASN1_TIME_to_tm(time, &parts) == 1 ? static_cast<std::int64_t>(timegm(&parts)) : 0;
}

std::vector<std::string> hosts_of(const X509* certificate) {
  std::vector<std::string> hosts;
  const NamesPointer names(
      static_cast<GENERAL_NAMES*>(X509_get_ext_d2i(certificate, NID_subject_alt_name, nullptr, nullptr)));
  for (int i = 0; i < sk_GENERAL_NAME_num(names.get()); ++i) {
    const GENERAL_NAME* name = sk_GENERAL_NAME_value(names.get(), i);
    if (name->type != GEN_DNS && name->type != GEN_IPADD) continue;
    const ASN1_STRING* text = name->type == GEN_DNS ? name->d.dNSName : name->d.iPAddress;
    const unsigned char* bytes = ASN1_STRING_get0_data(text);
    const int size = ASN1_STRING_length(text);
    if (name->type == GEN_DNS) {
      hosts.emplace_back(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(size));
      continue;
    }
    std::array<char, INET6_ADDRSTRLEN> ip{};
    if (inet_ntop(size == 4 ? AF_INET : AF_INET6, bytes, ip.data(), ip.size())) hosts.emplace_back(ip.data());
  }
  return hosts;
}

}  // namespace

Validity valid_for(int days) {
  using namespace std::chrono;
  const std::int64_t now_s = duration_cast<seconds>(system_clock::now().time_since_epoch()).count();
  return {now_s - 3600, now_s + std::int64_t{86400} * days};
}

Result<Issued> make_authority(const std::string& name, const Validity& validity) {
  return issue({name, validity, "critical,keyCertSign,cRLSign", "", ""}, nullptr);
}

Result<Issued> make_rig_certificate(const Issued& authority, const std::vector<std::string>& hosts,
                                    const Validity& validity) {
  std::string names;
  for (const std::string& host : hosts) {
    if (host.empty() || host.find_first_of(", :/\"\\\n") != std::string::npos) {
      if (!is_ip(host)) return Fault{"credentials.name", host, "this is no host", "give a host name or an IP address"};
    }
    names += (names.empty() ? "" : ",") + std::string(is_ip(host) ? "IP:" : "DNS:") + host;
  }
  if (names.empty()) return Fault{"credentials.name", "host", "a rig has at least one host name", "name one"};
  return issue({hosts.front().substr(0, most_name_bytes), validity, "critical,digitalSignature", "serverAuth", names},
               &authority);
}

Result<Issued> make_client_certificate(const Issued& authority, const std::string& name, const Validity& validity) {
  return issue({name, validity, "critical,digitalSignature", "clientAuth", ""}, &authority);
}

Result<CertificateFacts> read_certificate(const std::string& pem, const std::string& source) {
  const CertificatePointer certificate = certificate_from(pem);
  if (!certificate) {
    return Fault{"credentials.damaged", source, "there is no certificate in it that can be read", "pair again"};
  }
  CertificateFacts facts;
  std::array<char, 256> name{};
  X509_NAME_get_text_by_NID(X509_get_subject_name(certificate.get()), NID_commonName, name.data(), name.size());
  facts.common_name = name.data();
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  X509_digest(certificate.get(), EVP_sha256(), digest.data(), &size);
  static constexpr char digits[] = "0123456789abcdef";
  for (unsigned int i = 0; i < size; ++i) {
    facts.fingerprint += digits[digest[i] >> 4];
    facts.fingerprint += digits[digest[i] & 15u];
  }
  facts.validity = {seconds_of(X509_get0_notBefore(certificate.get())),
                    seconds_of(X509_get0_notAfter(certificate.get()))};
  facts.hosts = hosts_of(certificate.get());
  return facts;
}

bool belong_together(const std::string& certificate, const std::string& key) {
  const CertificatePointer shown = certificate_from(certificate);
  const KeyPointer kept = key_from(key);
  return shown && kept && X509_check_private_key(shown.get(), kept.get()) == 1;
}

std::string date_text(std::int64_t time_s) {
  const auto time = static_cast<std::time_t>(time_s);
  std::tm parts{};
  gmtime_r(&time, &parts);
  std::array<char, 64> text{};
  std::strftime(text.data(), text.size(), "%F %R UTC", &parts);
  return text.data();
}

}  // namespace focalstage
