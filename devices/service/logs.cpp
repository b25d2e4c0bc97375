#include "devices/service/logs.h"

#include <chrono>
#include <ctime>
#include <string>

#include <spdlog/async.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include "io/json/json.h"
#include "io/json/utf8.h"

namespace focalstage {

namespace {

constexpr std::size_t most_waiting = 8192;

std::string utc(spdlog::log_clock::time_point time) {
  const auto micros = std::chrono::duration_cast<std::chrono::microseconds>(time.time_since_epoch()).count();
  const std::time_t seconds = static_cast<std::time_t>(micros / 1'000'000);
  std::tm parts{};
  gmtime_r(&seconds, &parts);
  char text[64];
  const std::size_t length = std::strftime(text, sizeof text, "%FT%T", &parts);
  char fraction[16];
  std::snprintf(fraction, sizeof fraction, ".%06dZ", static_cast<int>(micros % 1'000'000));
  return std::string(text, length) + fraction;
}

class JsonLines final : public spdlog::formatter {
 public:
  void format(const spdlog::details::log_msg& message, spdlog::memory_buf_t& into) override {
    const auto level = spdlog::level::to_string_view(message.level);
    Value line;
    line.set("time", utc(message.time));
    line.set("level", std::string(level.data(), level.size()));
    line.set("message", valid_utf8({message.payload.data(), message.payload.size()}));
    const std::string text = write_json(line, -1) + "\n";
    into.append(text.data(), text.data() + text.size());
  }
  std::unique_ptr<spdlog::formatter> clone() const override { return json_lines(); }
};

spdlog::level::level_enum level_of(LogLevel level) {
  switch (level) {
    case LogLevel::debug:
      return spdlog::level::debug;
    case LogLevel::info:
      return spdlog::level::info;
    case LogLevel::warning:
      return spdlog::level::warn;
    case LogLevel::error:
      return spdlog::level::err;
  }
  return spdlog::level::info;
}

}  // namespace

std::unique_ptr<spdlog::formatter> json_lines() { return std::make_unique<JsonLines>(); }

Logs::Logs(LogLevel level, bool json) {
  spdlog::init_thread_pool(most_waiting, 1);
  auto sink = std::make_shared<spdlog::sinks::stderr_sink_mt>();
  auto logger = std::make_shared<spdlog::async_logger>("runtime", std::move(sink), spdlog::thread_pool(),
                                                       spdlog::async_overflow_policy::overrun_oldest);
  logger->set_level(level_of(level));
  logger->flush_on(spdlog::level::warn);
  if (json) logger->set_formatter(json_lines());
  spdlog::set_default_logger(std::move(logger));
}

Logs::~Logs() { spdlog::shutdown(); }

}  // namespace focalstage
