#include <chrono>
#include <csignal>
#include <cstdio>
#include <thread>

#include <CLI/CLI.hpp>

#include "tests/devices/optotune/emulator/line.h"

namespace {

volatile std::sig_atomic_t asked_to_end = 0;

}  // namespace

int main(int argc, char** argv) {
  using namespace focalstage::optotune_emulator;
  CLI::App app("A Lens Driver 4 behind a pseudo terminal, whose path is the first line, until it is interrupted");
  Options options;
  Misbehaviour how;
  double celsius = 25.0;
  std::size_t hang_up_at = 0;
  app.add_option("--lens", options.lens_serial, "serial of its lens, 8 characters")->capture_default_str();
  app.add_flag("--wide-limits", options.wide_limits, "CwUA and CwLA have four bytes of data");
  app.add_option("--celsius", celsius, "of the lens")->capture_default_str();
  app.add_flag("--silent", how.silent, "answers nothing");
  app.add_option("--error", how.error, "refuses with this number")->check(CLI::Range(1, 4));
  app.add_option("--error-on", how.error_on, "only of this command, such as TCA");
  app.add_flag("--error-as-digit", how.error_as_digit, "the number as a character");
  app.add_option("--half", how.half, "answers end after so many bytes");
  app.add_flag("--damage", how.damage, "checksums are wrong");
  app.add_flag("--stale", how.stale, "the answer before comes once more, before the right one");
  app.add_option("--delay", how.delay_s, "seconds before each answer");
  app.add_option("--hang-up-at", hang_up_at, "the line ends after so many bytes");
  CLI11_PARSE(app, argc, argv);
  if (hang_up_at > 0) how.hang_up_at = hang_up_at;

  const auto line = Line::open(options);
  if (!line) {
    std::fputs("no pseudo terminal can be had\n", stderr);
    return 1;
  }
  line->heat(celsius);
  line->misbehave(how);
  std::printf("%s\n", line->path().c_str());
  std::fflush(stdout);
  std::signal(SIGINT, [](int) { asked_to_end = 1; });
  std::signal(SIGTERM, [](int) { asked_to_end = 1; });
  while (asked_to_end == 0) {
    std::this_thread::sleep_for(std::chrono::seconds(1));
    const LensDriver now = line->snapshot();
    std::fprintf(stderr, "mode %d, %.2f mA of %.2f\n", now.mode(), now.counts() * now.centi_ma() / 100.0 / 4095.0,
                 now.centi_ma() / 100.0);
  }
  return 0;
}
