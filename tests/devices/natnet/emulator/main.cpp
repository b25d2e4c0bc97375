#include <chrono>
#include <csignal>
#include <cstdio>
#include <thread>

#include <CLI/CLI.hpp>

#include "tests/devices/natnet/emulator/server.h"

namespace {

volatile std::sig_atomic_t asked_to_end = 0;

}  // namespace

int main(int argc, char** argv) {
  using namespace focalstage::natnet_emulator;
  CLI::App app("A NatNet server with two bodies, 7 Head going round and 8 Box at rest, until it is interrupted");
  Options options;
  options.command_port = 1510;
  Misbehaviour how;
  bool no_stamp = false;
  app.add_option("--address", options.address, "own IPv4 address")->capture_default_str();
  app.add_option("--port", options.command_port, "command port")->capture_default_str();
  app.add_option("--group", options.group, "multicast group, such as 239.255.42.99; without it unicast");
  app.add_option("--data-port", options.data_port, "data port")->capture_default_str();
  app.add_option("--rate", options.frames_per_s, "frames per second")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_option("--major", options.dialect.major, "NatNet version")->capture_default_str();
  app.add_option("--minor", options.dialect.minor, "NatNet version")->capture_default_str();
  app.add_flag("--no-stamp", no_stamp, "4.x: frames without the stamp of precision");
  app.add_option("--drop-every", how.drop_every, "one in so many frames is not sent");
  app.add_flag("--swap-pairs", how.swap_pairs, "frames overtake each other");
  app.add_option("--cut", how.cut_bytes, "bytes missing at each frame's end")->check(CLI::Range(0, 100));
  app.add_flag("--silent", how.silent, "answers but streams nothing");
  app.add_flag("--tracking-lost", how.tracking_lost, "body 7 is not seen");
  app.add_flag("--nan-pose", how.nan_pose, "body 7 is nowhere");
  CLI11_PARSE(app, argc, argv);
  options.dialect.stamp = !no_stamp;

  const auto server = Server::start(options);
  if (!server) {
    std::fprintf(stderr, "%s port %d cannot be had\n", options.address.c_str(), options.command_port);
    return 1;
  }
  server->misbehave(how);
  std::signal(SIGINT, [](int) { asked_to_end = 1; });
  std::signal(SIGTERM, [](int) { asked_to_end = 1; });
  while (asked_to_end == 0) {
    std::this_thread::sleep_for(std::chrono::seconds(1));
    const Record record = server->record();
    std::printf("%d frames sent, %d pings, %d model requests, %d keep-alives\n", record.frames_sent, record.pings,
                record.model_requests, record.keep_alives);
    std::fflush(stdout);
  }
  return 0;
}
