#include "devices/service/http_responder.h"

#include <atomic>
#include <vector>

#include <doctest/doctest.h>

#include "tests/devices/service/http_client.h"

namespace focalstage {
namespace {

using std::chrono::milliseconds;

std::unique_ptr<HttpResponder> responder(std::function<std::string()> body, milliseconds patience = milliseconds(300)) {
  HttpResponder::Settings settings;
  settings.listen = "127.0.0.1:0";
  settings.patience = patience;
  auto started = HttpResponder::start(std::move(settings), std::move(body));
  REQUIRE(started);
  return std::move(*started);
}

TEST_CASE("a GET of its path is answered, anything else is refused") {
  const auto http = responder([] { return std::string("up 1\n"); });
  const std::string page = ask(http->address(), "GET /metrics HTTP/1.1\r\nHost: x\r\n\r\n");
  CHECK(page.starts_with("HTTP/1.0 200 OK\r\n"));
  CHECK(page.find("Content-Type: text/plain; version=0.0.4") != std::string::npos);
  CHECK(page.find("Content-Length: 5\r\n") != std::string::npos);
  CHECK(page.ends_with("\r\n\r\nup 1\n"));
  CHECK(ask(http->address(), "GET /metrics?x=1 HTTP/1.0\r\n\r\n").starts_with("HTTP/1.0 200"));
  CHECK(ask(http->address(), "GET /other HTTP/1.0\r\n\r\n").starts_with("HTTP/1.0 404"));
  CHECK(ask(http->address(), "POST /metrics HTTP/1.0\r\n\r\n").starts_with("HTTP/1.0 405"));
  CHECK(ask(http->address(), "nonsense\r\n\r\n").starts_with("HTTP/1.0 400"));
}

TEST_CASE("a request without an end, and one that is too long, take no longer than its patience") {
  std::atomic<int> made = 0;
  const auto http = responder([&] {
    ++made;
    return std::string("x");
  });
  CHECK_FALSE(ask(http->address(), std::string(100'000, 'a')).starts_with("HTTP/1.0 200"));
  const auto begun = std::chrono::steady_clock::now();
  const int slow = connect_to(http->address());
  REQUIRE(slow >= 0);
  (void)::send(slow, "GET", 3, MSG_NOSIGNAL);
  const std::string answer = ask(http->address(), "GET /metrics HTTP/1.0\r\n\r\n");
  CHECK(answer.starts_with("HTTP/1.0 200"));  // after the slow one
  CHECK(std::chrono::steady_clock::now() - begun < milliseconds(3000));
  ::close(slow);
  CHECK(made == 1);
}

TEST_CASE("who does not read a long answer keeps it no longer than its patience") {
  const auto http = responder([] { return std::string(64u << 20, 'x'); });
  const int deaf = connect_to(http->address());
  REQUIRE(deaf >= 0);
  const std::string request = "GET /metrics HTTP/1.0\r\n\r\n";
  (void)::send(deaf, request.data(), request.size(), MSG_NOSIGNAL);
  const auto begun = std::chrono::steady_clock::now();
  CHECK(ask(http->address(), "GET /other HTTP/1.0\r\n\r\n").starts_with("HTTP/1.0 404"));
  CHECK(std::chrono::steady_clock::now() - begun < milliseconds(3000));
  ::close(deaf);
}

TEST_CASE("it listens on loopback alone, and says why it can't") {
  const auto fails = [](const std::string& listen, const std::string& code) {
    HttpResponder::Settings settings;
    settings.listen = listen;
    const auto http = HttpResponder::start(settings, [] { return std::string(); });
    REQUIRE_FALSE(http);
    CHECK(http.fault().code == code);
  };
  fails("0.0.0.0:0", "runtime.not-loopback");
  fails("here", "runtime.address");
  const auto first = responder([] { return std::string(); });
  fails(first->address(), "runtime.address-in-use");
}

}  // namespace
}  // namespace focalstage
