#include "devices/service/service.h"

#include <thread>

#include <doctest/doctest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include "devices/runtime/configured_rig.h"
#include "devices/service/logs.h"
#include "io/json/json.h"
#include "io/protocol/client.h"
#include "tests/devices/runtime/sample_project.h"
#include "tests/devices/service/http_client.h"
#include "tests/devices/service/stuck_rig.h"

namespace focalstage {
namespace {

using std::chrono::milliseconds;

/// The value of a line of the metrics page; -1 where there is none.
double figure(const std::string& page, const std::string& name) {
  const std::size_t at = page.find("\n" + name + " ");
  return at == std::string::npos ? -1.0 : std::stod(page.substr(at + name.size() + 2));
}

TEST_CASE("what the rig does is seen in its metrics") {
  spdlog::set_level(spdlog::level::off);
  const sample::Folder folder;
  RigConfig config;
  config.listen = config.metrics_listen = "127.0.0.1:0";
  config.store = folder.path() / "store";
  auto options = runtime_options(config);
  REQUIRE(options);
  options->rig.rig = simulated_rig(sample::sim());
  options->rig.clock = RigClock::virtual_time;
  const auto service = Service::start(config, *options);
  REQUIRE(service);
  CHECK((*service)->runtime().keeps_time());
  const std::string metrics = (*service)->metrics_address();
  const std::string get = "GET /metrics HTTP/1.0\r\n\r\n";
  CHECK(figure(ask(metrics, get), "focalstage_state{state=\"empty\"}") == 1.0);
  const auto show = folder.path() / "show.h5";
  REQUIRE(sample::write_show(show, sample::project()));
  auto client = RigClient::connect((*service)->runtime().address(), milliseconds(3000));
  REQUIRE(client);
  REQUIRE(client->push(show, true, {}));
  REQUIRE(client->play(60));
  while (client->state()->state == "playing") std::this_thread::sleep_for(milliseconds(5));
  CHECK_FALSE(client->cue("none"));
  std::this_thread::sleep_for(milliseconds(250));  // so long a page lasts
  const std::string page = ask(metrics, get);
  CHECK(figure(page, "focalstage_state{state=\"holding\"}") == 1.0);
  CHECK(figure(page, "focalstage_sweeps_total") == 60.0);
  CHECK(figure(page, "focalstage_push_bytes_total") == static_cast<double>(std::filesystem::file_size(show)));
  CHECK(figure(page, "focalstage_faults_total{code=\"rig.refused\"}") == 1.0);
  CHECK(figure(page, "focalstage_held") == 1.0);
  CHECK(figure(page, "focalstage_temperature_celsius{part=\"projector\"}") == 25.0);
  CHECK((*service)->runtime().keeps_time());
}

TEST_CASE("a rig whose thread is stuck no longer counts as alive, so that the watchdog starves") {
  const sample::Folder folder;
  const auto stuck = std::make_shared<std::atomic<bool>>(false);
  RuntimeOptions options;
  options.listen = "127.0.0.1:0";
  options.store = folder.path() / "store";
  options.rig.clock = RigClock::virtual_time;
  options.rig.rig = simulated_rig(sample::sim());
  options.rig.rig.make = [&] { return std::make_unique<StuckRig>(sample::sim(), stuck); };
  const auto runtime = Runtime::start(options);
  REQUIRE(runtime);
  const auto show = folder.path() / "show.h5";
  REQUIRE(sample::write_show(show, sample::project()));
  auto client = RigClient::connect(runtime->address(), milliseconds(3000));
  REQUIRE(client);
  REQUIRE(client->push(show, true, {}));
  REQUIRE(client->play());
  CHECK(runtime->keeps_time());
  *stuck = true;
  const auto begun = std::chrono::steady_clock::now();
  const auto waited = [&] { return std::chrono::steady_clock::now() - begun; };
  while (runtime->keeps_time() && waited() < milliseconds(6000)) std::this_thread::sleep_for(milliseconds(20));
  CHECK_FALSE(runtime->keeps_time());
  CHECK(waited() > milliseconds(1500));
  *stuck = false;
  while (!runtime->keeps_time() && waited() < milliseconds(9000)) std::this_thread::sleep_for(milliseconds(20));
  CHECK(runtime->keeps_time());
}

TEST_CASE("a line of the log is one JSON object, whatever is logged") {
  std::ostringstream out;
  auto sink = std::make_shared<spdlog::sinks::ostream_sink_st>(out);
  spdlog::logger logger("test", sink);
  logger.set_formatter(json_lines());
  logger.warn("dark: \"a\"\nnext {} \xff", 5);
  const std::string line = out.str();
  CHECK(line.find('\n') == line.size() - 1);
  const auto value = parse_json(line, "log");
  REQUIRE(value);
  CHECK(*value->find("level")->text() == "warning");
  CHECK(value->find("message")->text()->starts_with("dark: \"a\"\nnext 5 "));
  const std::string time = *value->find("time")->text();
  CHECK(time.size() == std::string("2026-01-02T03:04:05.123456Z").size());
  CHECK(time.back() == 'Z');
}

}  // namespace
}  // namespace focalstage
