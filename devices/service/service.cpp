#include "devices/service/service.h"

#include <utility>

#include <spdlog/spdlog.h>

#include "devices/service/metrics.h"

namespace focalstage {

namespace {

/// Pages made no more often than this: whoever asks more often gets the one before, and the rig's lock is not asked
/// for.
constexpr std::chrono::milliseconds page_lasts{200};

/// A page that is made anew now and then. For one thread.
std::function<std::string()> kept_page(const Runtime& runtime) {
  using Clock = std::chrono::steady_clock;
  return [&runtime, page = std::string(), made = Clock::time_point()]() mutable {
    if (page.empty() || Clock::now() - made >= page_lasts) {
      page = metrics_text(runtime.figures());
      made = Clock::now();
    }
    return page;
  };
}

}  // namespace

Service::Service(Runtime runtime, ServiceManager manager)
    : runtime_(std::move(runtime)), manager_(std::move(manager)) {}

Result<std::unique_ptr<Service>> Service::start(const RigConfig& config, const RuntimeOptions& options,
                                                ServiceManager manager) {
  Result<Runtime> runtime = Runtime::start(options);
  if (!runtime) return runtime.fault();
  std::unique_ptr<Service> service(new Service(std::move(*runtime), std::move(manager)));
  if (Status begun = service->begin(config); !begun) return begun.fault();
  return service;
}

Status Service::begin(const RigConfig& config) {
  if (!config.metrics_listen.empty()) {
    HttpResponder::Settings settings;
    settings.listen = config.metrics_listen;
    auto metrics = HttpResponder::start(std::move(settings), kept_page(runtime_));
    if (!metrics) return metrics.fault();
    metrics_ = std::move(*metrics);
    spdlog::info("metrics at http://{}/metrics", metrics_->address());
  }
  if (config.osc) {
    auto osc = OscDesk::start(*config.osc, [this, despite_lease = config.osc->despite_lease](const DeskCommand& said) {
      (void)runtime_.operate(said, despite_lease);  // a refusal is in the log
    });
    if (!osc) return osc.fault();
    osc_ = std::move(*osc);
    spdlog::info("osc at {}", osc_->address());
  }
  manager_.ready("listening on " + runtime_.address(), [this] { return runtime_.keeps_time(); });
  return {};
}

Service::~Service() { manager_.stopping(); }

}  // namespace focalstage
