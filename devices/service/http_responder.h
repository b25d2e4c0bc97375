#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "core/base/result.h"

namespace focalstage {

/// Answers GET of one path over HTTP/1.0 on loopback with a text, and everything else with an error. One connection at
/// a time, for `patience` at most, however slowly the other end reads or writes; no request beyond 4 KiB is read.
class HttpResponder {
 public:
  struct Settings {
    std::string listen;  ///< HOST:PORT; port 0 picks one
    std::string path = "/metrics";
    std::string content_type = "text/plain; version=0.0.4; charset=utf-8";
    std::chrono::milliseconds patience{1000};
  };

  /// "runtime.not-loopback", "runtime.address", "runtime.address-in-use".
  static Result<std::unique_ptr<HttpResponder>> start(Settings settings, std::function<std::string()> body);
  ~HttpResponder();

  const std::string& address() const { return address_; }

 private:
  HttpResponder(Settings settings, std::function<std::string()> body, int socket, std::string address);
  void run(const std::stop_token& stop);
  void answer(int connection);

  Settings settings_;
  std::function<std::string()> body_;
  int socket_;
  std::string address_;
  std::jthread thread_;
};

}  // namespace focalstage
