#include <doctest/doctest.h>
#include <fcntl.h>
#include <pty.h>
#include <unistd.h>

#include <array>
#include <optional>
#include <random>
#include <string>
#include <thread>

#include "devices/roles/clock.h"
#include "devices/uno/packets.h"
#include "devices/uno/uno.h"
#include "tests/devices/uno/emulator/line_sum.h"

using namespace focalstage;

namespace {

/// Random, of what the line is made of more often than of anything.
std::string random_text(std::mt19937& random, std::size_t most) {
  static const std::string usual = "0123456789 !*OKERRDARKBOOTfocalstage-uno\n";
  std::string text;
  for (std::size_t left = random() % (most + 1); left > 0; --left) {
    const bool odd = random() % 8 == 0;
    text.push_back(odd ? static_cast<char>(random()) : usual[random() % usual.size()]);
  }
  return text;
}

}  // namespace

TEST_CASE("decoders take any bytes, and understand only what is whole") {
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    for (int i = 0; i < 500; ++i) {
      const std::string text = random_text(random, 70);
      const uno::Reply as_it_is = uno::decode(text);
      const uno::Reply with_sum = uno::decode(uno_emulator::with_sum(text));
      // A good sum makes what has no meaning no answer.
      if (with_sum.kind == uno::ReplyKind::ok) REQUIRE(with_sum.number.has_value());
      if (as_it_is.kind != uno::ReplyKind::damaged) REQUIRE(text.rfind('*') + 5 == text.size());
      const auto status = uno::decode_status(text);
      if (status) REQUIRE(status->period_s <= 65535 * 0.5e-6);
      (void)uno::decode_hello(text);
    }
  }
}

TEST_CASE("whatever cuts a line and joins it again, whole lines come out whole") {
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    uno::ReplyReader reader;
    int good = 0;
    for (int i = 0; i < 40; ++i) {
      std::string noise = random_text(random, 100);
      for (const char byte : noise + "\n" + uno_emulator::with_sum("7 OK " + std::to_string(i)) + "\n") {
        const std::optional<uno::Reply> reply = reader.push(byte);
        if (reply && reply->kind == uno::ReplyKind::ok && reply->words == std::to_string(i)) ++good;
      }
    }
    CHECK(good == 40);
  }
}

TEST_CASE("a port that says anything at all is no board, and opening it ends in time") {
  for (unsigned seed = 0; seed < 6; ++seed) {
    int master = -1;
    int slave = -1;
    std::array<char, 128> name{};
    REQUIRE(::openpty(&master, &slave, name.data(), nullptr, nullptr) == 0);
    REQUIRE(::fcntl(master, F_SETFL, O_NONBLOCK) == 0);
    UnoSettings settings;
    settings.path = name.data();
    settings.boot_s = 0.2;
    const auto uno = make_uno(settings);
    std::jthread babbler([&](const std::stop_token& stop) {
      for (std::mt19937 random(seed); !stop.stop_requested();) {
        const std::string text = random_text(random, 200);
        [[maybe_unused]] const ssize_t said = ::write(master, text.data(), text.size());
        std::array<char, 512> heard{};
        [[maybe_unused]] const ssize_t got = ::read(master, heard.data(), heard.size());
        sleep_until(monotonic_s() + 0.5e-3);
      }
    });
    const double begin_s = monotonic_s();
    const Status opened = uno->open();
    CHECK(monotonic_s() - begin_s < 3.0);
    REQUIRE_FALSE(opened.ok());
    CHECK(opened.fault().code == "uno.silent");
    babbler.request_stop();
    babbler.join();
    ::close(slave);
    ::close(master);
  }
}
