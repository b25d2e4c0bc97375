#include "editor/preview/preview.h"

#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include "core/check/check.h"
#include "core/compile/coverage.h"
#include "core/optics/image_plan.h"
#include "editor/preview/eye_painter.h"
#include "editor/preview/slice_maker.h"

namespace focalstage {
namespace {

/// A drag is to show new slices with every frame of the window.
constexpr double within_frame_ms = 14.0;
constexpr int lower_priority = 10;

int worker_threads() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) - 1); }

/// Whether two wishes want the same slices.
bool same_slices(const PreviewWish& a, const PreviewWish& b) {
  return a.revision == b.revision && a.frame == b.frame && a.stage == b.stage && a.uncompensated == b.uncompensated;
}

}  // namespace

struct Preview::State {
  std::function<void()> wake;

  mutable std::mutex mutex;
  std::condition_variable arrived;
  std::optional<PreviewWish> newest;
  bool pending = false;  ///< the worker has not looked at it yet
  bool working = false;
  bool ending = false;
  std::stop_source whole;  ///< stops the full-size compile under way

  std::shared_ptr<const CompiledSlices> slices;
  std::shared_ptr<const CheckedProject> checked;
  std::shared_ptr<const EyePicture> eye;
  std::optional<FocusAnswer> focus;
  std::optional<Fault> fault;
  int answered = 0;  ///< the worker's: the last question about focus

  SliceMaker maker{worker_threads()};
  EyePainter painter;
  std::thread worker;

  void run();
  void fulfil(const PreviewWish& wish, std::stop_token stop);
  bool compile(const PreviewWish& wish, int divisor, std::stop_token stop);
  void check_plan(const PreviewWish& wish);
  void check_measured(const PreviewWish& wish, const CompiledSlices& compiled);
  void paint(const PreviewWish& wish, std::stop_token stop);
  bool superseded() const;

  /// `clear` may take things away at any time: the worker looks at copies.
  template <class Shown>
  Shown copy_of(const Shown& shown) const {
    const std::lock_guard lock(mutex);
    return shown;
  }

  template <class Change>
  void publish(Change&& change) {
    {
      const std::lock_guard lock(mutex);
      change();
    }
    wake();
  }
};

bool Preview::State::superseded() const {
  const std::lock_guard lock(mutex);
  return pending || ending;
}

bool Preview::State::compile(const PreviewWish& wish, int divisor, std::stop_token stop) {
  const auto begun = std::chrono::steady_clock::now();
  auto frame = maker.make(*wish.project, *wish.stage, SliceMaker::Variant::shown, divisor, stop);
  auto made = std::make_shared<CompiledSlices>();
  if (frame) {
    made->images = std::move(frame->images);
    made->measure = std::move(frame->measure);
  }
  if (frame && wish.uncompensated) {
    auto plain = maker.make(*wish.project, *wish.stage, SliceMaker::Variant::uncompensated, divisor, stop);
    if (!plain) return false;
    made->uncompensated = std::move(plain->images);
  }
  if (!frame) {
    const Fault why = frame.fault();
    if (why.code != "compile.cancelled") publish([&] { fault = why; });
    return false;
  }
  made->revision = wish.revision;
  made->frame = wish.frame;
  made->divisor = divisor;
  made->project = wish.project;
  made->stage = wish.stage;
  made->settings = SliceMaker::settings_of(*wish.project, SliceMaker::Variant::shown, divisor);
  made->compile_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun).count();
  publish([&] {
    slices = std::move(made);
    fault.reset();
  });
  return true;
}

void Preview::State::check_plan(const PreviewWish& wish) {
  const auto before = copy_of(checked);
  if (before && before->revision == wish.revision) return;
  auto made = std::make_shared<CheckedProject>();
  made->revision = wish.revision;
  made->images = image_plan(*wish.project);
  made->schedule = make_schedule(*wish.project, made->images);
  // Until the frame is measured again, what was measured last still stands for what only measuring can tell.
  if (before) made->findings = before->findings;
  publish([&] { checked = std::move(made); });
}

void Preview::State::check_measured(const PreviewWish& wish, const CompiledSlices& compiled) {
  const auto plan = copy_of(checked);
  // Without a plan of this revision the project was closed meanwhile.
  if (!plan || plan->revision != wish.revision || plan->measured) return;
  auto made = std::make_shared<CheckedProject>(*plan);
  made->measured = true;
  Measured measured;
  measured.frames.push_back(compiled.measure);
  const CompileSettings& settings = compiled.settings;
  const double aperture_m = wish.project->glasses.lens_aperture_mm / 1000.0;
  measured.coverage.push_back(
      CoverageMeter(projectors_of(settings), settings.lens_to_pupil_m, aperture_m).measure(*wish.stage));
  measured.meshes = mesh_states(*wish.project, *wish.stage);
  measured.lit = surfaces_in_light(*wish.project, *wish.stage);
  made->findings = check(*wish.project, made->schedule, measured, wish.models ? *wish.models : ProjectorModels{});
  publish([&] { checked = std::move(made); });
}

void Preview::State::paint(const PreviewWish& wish, std::stop_token stop) {
  const auto shown = copy_of(slices);
  if (!shown || shown->revision != wish.revision || shown->frame != wish.frame) return;
  auto picture = painter.paint(*shown, wish.eye, maker, std::move(stop));
  if (picture) publish([&] { eye = std::make_shared<const EyePicture>(std::move(*picture)); });
  if (!wish.focus_at || wish.focus_at->serial == answered) return;
  answered = wish.focus_at->serial;
  const auto focus_d = painter.focus_at(*shown, wish.eye, wish.focus_at->at);
  if (focus_d && *focus_d) publish([&] { focus = FocusAnswer{wish.focus_at->serial, **focus_d}; });
}

void Preview::State::fulfil(const PreviewWish& wish, std::stop_token stop) {
  const auto shown = copy_of(slices);
  const bool stands = shown && shown->revision == wish.revision && shown->frame == wish.frame &&
                      shown->stage == wish.stage && (!wish.uncompensated || !shown->uncompensated.codes.empty());
  if (!stands || (shown->divisor > 1 && !wish.moving)) {
    const int divisor = maker.divisor_within(within_frame_ms);
    check_plan(wish);
    if (!stands) {
      if (!compile(wish, divisor, divisor == 1 ? stop : std::stop_token{})) return;
      paint(wish, {});
    }
    if (wish.moving || superseded()) return;
    if ((!stands && divisor > 1) || (stands && shown->divisor > 1)) {
      if (!compile(wish, 1, stop) || superseded()) return;
    }
  }
  paint(wish, {});
  const auto exact = copy_of(slices);
  if (!wish.moving && !superseded() && exact && exact->divisor == 1) check_measured(wish, *exact);
}

void Preview::State::run() {
  // Background work gives way to the window; threads that the engine starts from here inherit it.
  setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), lower_priority);
  std::unique_lock lock(mutex);
  for (;;) {
    arrived.wait(lock, [&] { return pending || ending; });
    if (ending) return;
    const PreviewWish now = *newest;
    pending = false;
    working = true;
    whole = std::stop_source();
    const std::stop_token stop = whole.get_token();
    lock.unlock();
    fulfil(now, stop);
    lock.lock();
    working = false;
    if (!pending) {
      lock.unlock();
      wake();
      lock.lock();
    }
  }
}

Preview::Preview(std::function<void()> wake) : state_(std::make_unique<State>()) {
  state_->wake = std::move(wake);
  state_->worker = std::thread([this] { state_->run(); });
}

Preview::~Preview() {
  {
    const std::lock_guard lock(state_->mutex);
    state_->ending = true;
    state_->whole.request_stop();
  }
  state_->arrived.notify_all();
  state_->worker.join();
}

void Preview::want(PreviewWish wish) {
  const std::lock_guard lock(state_->mutex);
  if (state_->newest && same_slices(*state_->newest, wish) && state_->newest->moving == wish.moving &&
      state_->newest->eye == wish.eye && state_->newest->focus_at == wish.focus_at) {
    return;
  }
  if (!state_->newest || !same_slices(*state_->newest, wish)) state_->whole.request_stop();
  state_->newest = std::move(wish);
  state_->pending = true;
  state_->arrived.notify_one();
}

void Preview::clear() {
  const std::lock_guard lock(state_->mutex);
  state_->whole.request_stop();
  state_->newest.reset();
  state_->pending = false;
  state_->slices = nullptr;
  state_->checked = nullptr;
  state_->eye = nullptr;
  state_->fault.reset();
}

std::shared_ptr<const CompiledSlices> Preview::slices() const {
  const std::lock_guard lock(state_->mutex);
  return state_->slices;
}

std::shared_ptr<const CheckedProject> Preview::checked() const {
  const std::lock_guard lock(state_->mutex);
  return state_->checked;
}

std::shared_ptr<const EyePicture> Preview::eye_picture() const {
  const std::lock_guard lock(state_->mutex);
  return state_->eye;
}

std::optional<FocusAnswer> Preview::focus_answer() const {
  const std::lock_guard lock(state_->mutex);
  return state_->focus;
}

std::optional<Fault> Preview::fault() const {
  const std::lock_guard lock(state_->mutex);
  return state_->fault;
}

bool Preview::busy() const {
  const std::lock_guard lock(state_->mutex);
  return state_->pending || state_->working;
}

}  // namespace focalstage
