#include "io/credentials/credentials.h"

#include <sys/stat.h>

#include <cstdlib>
#include <fstream>

#include <doctest/doctest.h>

#include "io/credentials/certificates.h"
#include "tests/support/temporary_folder.h"

using namespace focalstage;

namespace {

namespace fs = std::filesystem;

Issued authority() { return *make_authority("test rig", valid_for(10)); }

unsigned mode_of(const fs::path& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 ? status.st_mode & 0777u : 0u;
}

Credentials client_of(const Issued& ca, const Validity& validity = valid_for(10)) {
  const Issued client = *make_client_certificate(ca, "studio", validity);
  return {client.certificate, client.key, ca.certificate};
}

/// Keeps pairs in a folder of the test's own.
struct Home {
  TemporaryFolder folder;
  Home() { ::setenv("FOCALSTAGE_CREDENTIALS", (folder / "rigs").c_str(), 1); }
  ~Home() { ::unsetenv("FOCALSTAGE_CREDENTIALS"); }
};

}  // namespace

TEST_CASE("a certificate says who it is for and how long") {
  const Issued ca = authority();
  const Issued rig = *make_rig_certificate(ca, {"rig.example", "127.0.0.1", "fe80::1"}, valid_for(3));
  const auto facts = read_certificate(rig.certificate, "rig");
  REQUIRE(facts);
  CHECK(facts->common_name == "rig.example");
  CHECK(facts->hosts == std::vector<std::string>{"rig.example", "127.0.0.1", "fe80::1"});
  CHECK(facts->fingerprint.size() == 64);
  CHECK(facts->validity.until_s - facts->validity.from_s == 3 * 86400 + 3600);
  CHECK(belong_together(rig.certificate, rig.key));
  CHECK_FALSE(belong_together(rig.certificate, ca.key));
  CHECK(read_certificate(client_of(ca).certificate, "c")->common_name == "studio");
  CHECK(read_certificate(client_of(ca).certificate, "c")->fingerprint !=
        read_certificate(client_of(ca).certificate, "c")->fingerprint);
  CHECK(read_certificate("nonsense", "here").fault().where == "here");
  CHECK(date_text(0) == "1970-01-01 00:00 UTC");
}

TEST_CASE("names that cannot be are refused") {
  const Issued ca = authority();
  CHECK(make_client_certificate(ca, "", valid_for(1)).fault().code == "credentials.name");
  CHECK(make_client_certificate(ca, std::string(65, 'x'), valid_for(1)).fault().code == "credentials.name");
  CHECK(make_rig_certificate(ca, {}, valid_for(1)).fault().code == "credentials.name");
  CHECK(make_rig_certificate(ca, {"a,DNS:b"}, valid_for(1)).fault().code == "credentials.name");
  CHECK(make_client_certificate({"x", "y"}, "z", valid_for(1)).fault().code == "credentials.damaged");
}

TEST_CASE("a secret is its owner's alone, also where a file was there before") {
  const TemporaryFolder folder;
  REQUIRE(write_secret(folder / "key", "a"));
  CHECK(mode_of(folder / "key") == 0600u);
  fs::permissions(folder / "key", fs::perms::all);
  REQUIRE(write_secret(folder / "key", "b"));
  CHECK(mode_of(folder / "key") == 0600u);
  CHECK(folder.count() == 1);
  CHECK(write_secret(folder / "none" / "key", "a").fault().code == "file.unwritable");
}

TEST_CASE("a rig's files are held against each other before anybody trusts them") {
  const TemporaryFolder folder;
  const Issued ca = authority();
  const auto write = [&](const Issued& rig) {
    std::ofstream(folder / "ca.pem") << ca.certificate;
    std::ofstream(folder / "rig.pem") << rig.certificate;
    REQUIRE(write_secret(folder / "rig.key", rig.key));
  };
  const auto load = [&] { return load_credentials(folder / "rig.pem", folder / "rig.key", folder / "ca.pem"); };
  write(*make_rig_certificate(ca, {"localhost"}, valid_for(1)));
  REQUIRE(load());
  CHECK(load()->authority == ca.certificate);
  fs::permissions(folder / "rig.key", fs::perms::group_read, fs::perm_options::add);
  CHECK(load().fault().code == "credentials.mode");
  CHECK(load().fault().remedy.find("chmod 600") == 0);
  REQUIRE(write_secret(folder / "rig.key", ca.key));
  CHECK(load().fault().code == "credentials.key");
  write(*make_rig_certificate(ca, {"localhost"}, {0, 86400}));
  CHECK(load().fault().code == "credentials.expired");
  CHECK(load().fault().message.find("1970-01-02") != std::string::npos);
  std::ofstream(folder / "ca.pem") << "nonsense";
  CHECK(load().fault().where.find("ca.pem") != std::string::npos);
  CHECK(load_credentials(folder / "none", folder / "rig.key", folder / "ca.pem").fault().code == "file.missing");
}

TEST_CASE("a pair is kept for a host or for one port of it, and found again") {
  const Home home;
  const Credentials pair = client_of(authority());
  const Credentials other = client_of(authority());
  CHECK_FALSE(find_pair("rig.example:5")->has_value());
  const auto file = keep_pair(pair, "rig.example");
  REQUIRE(file);
  CHECK(mode_of(*file) == 0600u);
  CHECK(**find_pair("rig.example:5") == pair);
  REQUIRE(keep_pair(other, "rig.example:6"));
  CHECK(**find_pair("rig.example:5") == pair);
  CHECK(**find_pair("rig.example:6") == other);
  CHECK_FALSE(find_pair("other.example:5")->has_value());
  CHECK(keep_pair(pair, "../up").fault().code == "credentials.name");
  CHECK(keep_pair(pair, "a/b").fault().code == "credentials.name");
  fs::permissions(*file, fs::perms::others_read, fs::perm_options::add);
  CHECK(find_pair("rig.example:5").fault().code == "credentials.mode");
}

TEST_CASE("a pair that is cut off, mixed up or over is refused") {
  const Issued ca = authority();
  const Credentials pair = client_of(ca);
  CHECK(*parse_pair(pair_text(pair), "x") == pair);
  const std::string text = pair_text(pair);
  CHECK(parse_pair(text.substr(0, text.size() / 2), "x").fault().code == "credentials.damaged");
  CHECK(parse_pair("", "x").fault().code == "credentials.damaged");
  CHECK(parse_pair(pair_text({pair.certificate, ca.key, ca.certificate}), "x").fault().code == "credentials.key");
  CHECK(parse_pair(pair_text(client_of(ca, {0, 86400})), "x").fault().code == "credentials.expired");
}
