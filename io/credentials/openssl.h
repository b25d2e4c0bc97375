#pragma once

#include <memory>
#include <string>

#include <openssl/bio.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/ssl.h>
#include <openssl/x509.h>

namespace focalstage {

template <auto free>
struct OpensslFree {
  template <class T>
  void operator()(T* thing) const {
    free(thing);
  }
};
template <class T, auto free>
using OpensslPointer = std::unique_ptr<T, OpensslFree<free>>;

using BioPointer = OpensslPointer<BIO, BIO_free_all>;
using KeyPointer = OpensslPointer<EVP_PKEY, EVP_PKEY_free>;
using CertificatePointer = OpensslPointer<X509, X509_free>;

inline BioPointer reading(const std::string& text) {
  return BioPointer(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
}

inline CertificatePointer certificate_from(const std::string& pem) {
  const BioPointer bio = reading(pem);
  return CertificatePointer(PEM_read_bio_X509(bio.get(), nullptr, nullptr, nullptr));
}

inline KeyPointer key_from(const std::string& pem) {
  const BioPointer bio = reading(pem);
  // No password is ever asked for: the file's mode protects it.
  const auto no_password = [](char*, int, int, void*) { return 0; };
  return KeyPointer(PEM_read_bio_PrivateKey(bio.get(), nullptr, no_password, nullptr));
}

}  // namespace focalstage
