#include <chrono>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <utility>

#include "io/protocol/live_client.h"

namespace {

using namespace focalstage;

int failed(const Fault& fault) {
  std::fprintf(stderr, "%s\n", describe(fault).c_str());
  return 1;
}

Status obey(RigClient& rig, const std::string& word) {
  if (word == "play") return rig.play();
  if (word == "go") return rig.go();
  if (word == "blackout") return rig.blackout();
  return Fault{"live-hand.word", word, "is not known", "play, go or blackout"};
}

}  // namespace

/// Holds a rig live with a project that has no assets: live-hand HOST:PORT PROJECT.focal. Each line of stdin, `play`,
/// `go` or `blackout`, is answered by a line: `done`, or what is wrong. Ends with stdin; what plays then stays.
int main(int argc, char** argv) {
  if (argc != 3) return failed({"live-hand.usage", "", "live-hand HOST:PORT PROJECT.focal", ""});
  std::ifstream file(argv[2]);
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  auto rig = RigClient::connect(argv[1], std::chrono::milliseconds(3000));
  if (!rig) return failed(rig.fault());
  auto link = LiveLink::start(*rig, {1, text, {}, 0});
  if (!link) return failed(link.fault());
  for (std::string word; std::getline(std::cin, word);) {
    const Status done = obey(*rig, word);
    std::printf("%s\n", done ? "done" : describe(done.fault()).c_str());
    std::fflush(stdout);
    for (const LiveAnswer& answer : link->poll()) {
      if (const auto* refused = std::get_if<LiveRefused>(&answer)) failed(refused->fault);
    }
  }
  return 0;
}
