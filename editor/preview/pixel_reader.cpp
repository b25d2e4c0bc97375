#include "editor/preview/pixel_reader.h"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include "core/reference/samples.h"

namespace focalstage {
namespace {

struct Question {
  std::shared_ptr<const CompiledSlices> compiled;
  Side side = Side::left;
  glm::ivec2 pixel{0};
  bool operator==(const Question&) const = default;
};

int code_at(const FrameImages& images, std::size_t image, glm::ivec2 pixel) {
  const auto channels = static_cast<std::size_t>(images.channels);
  const std::size_t at = (static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(images.width_px) +
                          static_cast<std::size_t>(pixel.x)) *
                         channels;
  const auto codes = images.image(image).subspan(at, channels);
  return *std::max_element(codes.begin(), codes.end());
}

SliceReading read_slice(const Question& asked, const Samples& samples, const std::optional<EyePoint>& eye,
                        std::size_t image) {
  const CompiledSlices& compiled = *asked.compiled;
  const ImageSpec& spec = compiled.settings.images[image];
  SliceReading reading;
  reading.power_d = spec.power_d;
  reading.code = code_at(compiled.images, image, asked.pixel);
  if (!eye || spec.slice < 0) return reading;
  const auto sample = samples.slice(asked.side, *eye, static_cast<std::size_t>(spec.slice));
  if (!sample) return reading;
  reading.object = compiled.stage->objects[sample->object].name;
  reading.wanted_d = sample->wanted_d;
  reading.weight = sample->weight;
  return reading;
}

PixelReading read(const Question& asked, const Samples& samples) {
  const CompiledSlices& compiled = *asked.compiled;
  PixelReading reading;
  reading.pixel = asked.pixel * compiled.divisor;
  const auto lit = samples.lit(glm::dvec2(asked.pixel) + 0.5);
  std::optional<EyePoint> eye;
  if (lit) {
    reading.surface = compiled.stage->surfaces[lit->surface].name;
    reading.point_m = lit->world_m;
    eye = samples.seen(asked.side, *lit);
    reading.seen = eye.has_value();
    if (eye) reading.surface_m = eye->surface_m;
  }
  for (std::size_t image = 0; image < compiled.settings.images.size(); ++image) {
    const ImageEye whose = compiled.settings.images[image].eye;
    const bool own = whose == ImageEye::both || static_cast<std::size_t>(whose) == index_of(asked.side);
    if (own) reading.slices.push_back(read_slice(asked, samples, eye, image));
  }
  return reading;
}

}  // namespace

struct PixelReader::State {
  std::function<void()> wake;
  mutable std::mutex mutex;
  std::condition_variable arrived;
  Question asked;
  bool pending = false;
  bool ending = false;
  std::shared_ptr<const PixelReading> answer;
  std::thread worker;

  void run();
};

void PixelReader::State::run() {
  std::shared_ptr<const CompiledSlices> held;  // what `samples` looks at
  std::optional<Samples> samples;
  std::unique_lock lock(mutex);
  for (;;) {
    arrived.wait(lock, [&] { return pending || ending; });
    if (ending) return;
    pending = false;
    const Question now = asked;
    lock.unlock();
    if (held != now.compiled) {
      samples.reset();
      held = now.compiled;
      auto made = Samples::of(*held->stage, held->settings);
      if (made) samples = std::move(*made);
    }
    std::shared_ptr<const PixelReading> reading;
    if (samples) reading = std::make_shared<const PixelReading>(read(now, *samples));
    lock.lock();
    if (asked == now) answer = std::move(reading);
    lock.unlock();
    wake();
    lock.lock();
  }
}

PixelReader::PixelReader(std::function<void()> wake) : state_(std::make_unique<State>()) {
  state_->wake = std::move(wake);
  state_->worker = std::thread([this] { state_->run(); });
}

PixelReader::~PixelReader() {
  {
    const std::lock_guard lock(state_->mutex);
    state_->ending = true;
  }
  state_->arrived.notify_all();
  state_->worker.join();
}

void PixelReader::ask(std::shared_ptr<const CompiledSlices> compiled, Side side, glm::ivec2 pixel) {
  const bool outside = !compiled || pixel.x < 0 || pixel.y < 0 || pixel.x >= compiled->images.width_px ||
                       pixel.y >= compiled->images.height_px;
  const std::lock_guard lock(state_->mutex);
  Question question{std::move(compiled), side, pixel};
  if (question == state_->asked) return;
  state_->asked = std::move(question);
  state_->answer.reset();
  state_->pending = !outside;
  state_->arrived.notify_one();
}

std::shared_ptr<const PixelReading> PixelReader::answer() const {
  const std::lock_guard lock(state_->mutex);
  return state_->answer;
}

}  // namespace focalstage
