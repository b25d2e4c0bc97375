#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "editor/cli/command_list.h"
#include "editor/cli/output.h"
#include "io/credentials/certificates.h"
#include "io/credentials/credentials.h"
#include "io/files/files.h"
#include "io/protocol/client.h"

namespace focalstage {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t size_limit = 1u << 20;
constexpr int authority_days = 3650;

struct Options {
  std::string action;
  std::string what;
  std::string name;
  std::vector<std::string> hosts;
  std::string out;
  std::string rig;
  int days = 825;
};

Result<std::string> text_of(const fs::path& path) {
  const auto bytes = read_file(path, size_limit);
  if (!bytes) return bytes.fault();
  return std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size());
}

Status write_issued(const Issued& issued, const fs::path& certificate, const fs::path& key) {
  if (Status written = write_secret(key, issued.key); !written) return written;
  return write_file_atomically(certificate, issued.certificate);
}

Result<Issued> authority_in(const fs::path& folder) {
  Result<std::string> certificate = text_of(folder / "ca.pem");
  if (!certificate) return certificate.fault();
  Result<std::string> key = text_of(folder / "ca.key");
  if (!key) return key.fault();
  return Issued{std::move(*certificate), std::move(*key)};
}

Status make_rig(const Options& options) {
  const fs::path folder = options.what;
  const Result<Issued> authority = authority_in(folder);
  if (!authority) return authority.fault();
  const Result<Issued> rig = make_rig_certificate(*authority, options.hosts, valid_for(options.days));
  if (!rig) return rig.fault();
  if (Status written = write_issued(*rig, folder / "rig.pem", folder / "rig.key"); !written) return written;
  const auto facts = read_certificate(rig->certificate, "rig.pem");
  std::printf("%s: the rig's certificate, until %s\n", (folder / "rig.pem").c_str(),
              date_text(facts->validity.until_s).c_str());
  return {};
}

Status init(const Options& options) {
  const fs::path folder = options.what;
  std::error_code problem;
  if (fs::exists(folder / "ca.key", problem)) {
    return Fault{"credentials.exists", (folder / "ca.key").string(),
                 "an authority is there already, and all that it signed would be worthless",
                 "focalstage pair rig makes a new certificate for the rig alone"};
  }
  fs::create_directories(folder, problem);
  const Result<Issued> authority =
      make_authority("Focalstage rig " + options.hosts.front().substr(0, 40), valid_for(authority_days));
  if (!authority) return authority.fault();
  if (Status written = write_issued(*authority, folder / "ca.pem", folder / "ca.key"); !written) return written;
  return make_rig(options);
}

Status make_client(const Options& options) {
  const Result<Issued> authority = authority_in(options.what);
  if (!authority) return authority.fault();
  const Result<Issued> client = make_client_certificate(*authority, options.name, valid_for(options.days));
  if (!client) return client.fault();
  const std::string out = options.out.empty() ? options.name + ".pair" : options.out;
  const Credentials pair{client->certificate, client->key, authority->certificate};
  if (Status written = write_secret(out, pair_text(pair)); !written) return written;
  const auto facts = read_certificate(client->certificate, out);
  std::printf(
      "%s: bring it to that computer in secret; there: focalstage pair import FILE --to HOST:PORT\n"
      "rig.json: {\"name\": \"%s\", \"fingerprint\": \"%s\", \"rights\": [\"watch\"]}\n",
      out.c_str(), facts->common_name.c_str(), facts->fingerprint.c_str());
  return {};
}

Status import(const Options& options) {
  const Result<std::string> text = text_of(options.what);
  if (!text) return text.fault();
  const Result<Credentials> pair = parse_pair(*text, options.what);
  if (!pair) return pair.fault();
  const Result<fs::path> kept = keep_pair(*pair, options.rig);
  if (!kept) return kept.fault();
  std::printf("%s: kept for %s\n", kept->c_str(), options.rig.c_str());
  return {};
}

Status show(const Options& options) {
  const Result<std::string> text = text_of(options.what);
  if (!text) return text.fault();
  const Result<CertificateFacts> facts = read_certificate(*text, options.what);
  if (!facts) return facts.fault();
  std::printf("name         %s\nfingerprint  %s\nuntil        %s\n", facts->common_name.c_str(),
              facts->fingerprint.c_str(), date_text(facts->validity.until_s).c_str());
  for (const std::string& host : facts->hosts) std::printf("host         %s\n", host.c_str());
  return {};
}

Status act(const Options& options) {
  if (options.action == "init") return init(options);
  if (options.action == "rig") return make_rig(options);
  if (options.action == "client") return make_client(options);
  if (options.action == "import") return import(options);
  return show(options);
}

/// What is wrong with the words after the action, if anything.
const char* wrong(const Options& options) {
  const bool for_rig = options.action == "init" || options.action == "rig";
  if (for_rig && options.hosts.empty()) return "a rig's certificate needs --host, by which it is reached";
  if (!for_rig && !options.hosts.empty()) return "only init and rig take --host";
  if ((options.action == "client") == options.name.empty()) {
    return options.name.empty() ? "client needs the NAME of the client" : "only client takes a NAME";
  }
  if ((options.action == "import") == options.rig.empty()) {
    return options.rig.empty() ? "import needs --to HOST:PORT" : "only import takes --to";
  }
  return nullptr;
}

ExitStatus run(const Options& options) {
  if (const char* what = wrong(options)) {
    std::fprintf(stderr, "focalstage pair: %s; see focalstage pair --help\n", what);
    return ExitStatus::usage;
  }
  if (const Status acted = act(options); !acted) return report(acted.fault());
  return ExitStatus::done;
}

}  // namespace

Command::Run declare_pair(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option(
         "ACTION", options->action,
         "init DIR (an authority and the rig's certificate), rig DIR (the rig's anew), client DIR NAME (for one "
         "computer), import FILE (on that computer), show FILE")
      ->required()
      ->type_name("")
      ->check(CLI::IsMember({"init", "rig", "client", "import", "show"}).name(""));
  app.add_option("WHAT", options->what, "the folder or file")->required()->type_name("");
  app.add_option("NAME", options->name, "client: what it is known by")->type_name("");
  app.add_option("--host", options->hosts, "init, rig: a host name or IP address of the rig; as often as it has some")
      ->type_name("HOST")
      ->allow_extra_args(false);
  app.add_option("-o", options->out, "client: the file to make; NAME.pair by default")->type_name("FILE");
  app.add_option("--to", options->rig, "import: the rig's address, or its host for all ports")->type_name("HOST:PORT");
  app.add_option("--days", options->days, "how long the certificate is good")
      ->check(CLI::Range(1, 3650))
      ->capture_default_str();
  return [options] { return run(*options); };
}

}  // namespace focalstage
