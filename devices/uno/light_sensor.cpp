#include "devices/uno/light_sensor.h"

#include <cmath>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "devices/roles/clock.h"
#include "devices/uno/dialogue.h"
#include "devices/uno/light_words.h"
#include "devices/uno/probe.h"

namespace focalstage {

namespace uno {

namespace {

constexpr double answer_s = 0.2;
constexpr double repeat_s = 0.05;
constexpr double unsynced_s = 0.5;
constexpr double tick_s = 0.5e-6;
constexpr double about_a_period_s = 1.0 / 60.0;
constexpr int most_samples = 240;
constexpr int bits = 10;
constexpr unsigned our_protocol = 1;

Fault not_open() { return {"uno.closed", "light sensor", "it is not open", "open it"}; }

Fault unsynced() {
  return {"light.unsynced", "light sensor", "no sync edge comes to it", "wire the rig's sync edge to its D8"};
}

class UnoLight final : public LightSensor {
 public:
  explicit UnoLight(UnoLightSettings settings) : settings_(std::move(settings)) {}

  focalstage::Status open() override;
  void close() override;
  DeviceId id() const override;
  DeviceState state() const override;
  focalstage::Status identify() override;
  LightAbilities abilities() const override { return {light_step_s, most_samples, bits}; }
  focalstage::Status arm(const LightRequest& request) override;
  Result<std::optional<LightRecord>> take() override;

 private:
  Result<Reply> ask(const std::string& command);
  focalstage::Status tell(const std::string& command);
  focalstage::Status lose(const Fault& fault);
  focalstage::Status greet();
  focalstage::Status look();
  Result<LightRecord> record(const LightLine& line);

  UnoLightSettings settings_;
  Waker waker_;
  mutable std::mutex mutex_;
  std::optional<Dialogue> dialogue_;
  DeviceId id_{"uno", "Arduino Uno", "", ""};
  DeviceState state_;
  std::optional<LightRequest> armed_;
  double armed_s_ = 0.0;
};

Result<Reply> UnoLight::ask(const std::string& command) {
  if (!dialogue_) return state_.fault ? *state_.fault : not_open();
  Result<Reply> reply = dialogue_->insist(command, monotonic_s() + answer_s, repeat_s);
  if (!reply) return lose(reply.fault()).fault();
  state_.heard_s = dialogue_->heard_s();
  return reply;
}

focalstage::Status UnoLight::tell(const std::string& command) {
  const Result<Reply> reply = ask(command);
  if (!reply) return reply.fault();
  if (reply->kind == ReplyKind::ok) return {};
  return Fault{"light.unable", "light sensor", "it refuses " + command + " with error " + std::to_string(reply->code),
               "see devices/firmware/README.md"};
}

focalstage::Status UnoLight::lose(const Fault& fault) {
  dialogue_.reset();
  armed_.reset();
  state_.phase = DevicePhase::lost;
  state_.fault = fault;
  return fault;
}

focalstage::Status UnoLight::open() {
  const std::lock_guard lock(mutex_);
  if (dialogue_) return {};
  Result<DeviceId> found = find_uno(settings_.board);
  if (!found) return lose(found.fault());
  id_ = *found;
  Result<SerialPort> port = SerialPort::open(found->address);
  if (!port) return lose(port.fault());
  dialogue_.emplace(std::move(*port), waker_);
  if (focalstage::Status greeted = greet(); !greeted) return lose(greeted.fault());
  state_.phase = DevicePhase::ready;
  state_.fault.reset();
  return {};
}

focalstage::Status UnoLight::greet() {
  const Result<Reply> hello = dialogue_->insist("HELLO", monotonic_s() + settings_.board.boot_s, 0.1);
  if (!hello) return hello.fault();
  if (hello->kind != ReplyKind::ok || decode_hello(hello->words) != our_protocol) {
    return Fault{"uno.protocol", dialogue_->path(), "the board does not answer HELLO as it should",
                 "write the firmware of this version to it (devices/firmware/README.md)"};
  }
  if (focalstage::Status safe = tell("SAFE"); !safe) return safe;
  const Result<Reply> seen = ask("SEEN");
  if (!seen) return seen.fault();
  if (seen->kind == ReplyKind::ok && decode_light(seen->words)) return {};
  return Fault{"uno.firmware", dialogue_->path(), "the board's firmware knows no light",
               "write the firmware of this version to it (devices/firmware/README.md)"};
}

void UnoLight::close() {
  const std::lock_guard lock(mutex_);
  dialogue_.reset();
  armed_.reset();
  state_ = {};
}

DeviceId UnoLight::id() const {
  const std::lock_guard lock(mutex_);
  return id_;
}

DeviceState UnoLight::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

focalstage::Status UnoLight::identify() {
  const std::lock_guard lock(mutex_);
  return tell("BLINK");
}

focalstage::Status UnoLight::arm(const LightRequest& request) {
  sleep_until(monotonic_s() + request.edges_to_skip * about_a_period_s);
  const std::lock_guard lock(mutex_);
  armed_ = request;
  armed_s_ = monotonic_s();
  return look();
}

focalstage::Status UnoLight::look() {
  const auto after = std::lround(armed_->after_edge_s / tick_s);
  return tell("LOOK " + std::to_string(settings_.input[armed_->eye]) + " " + std::to_string(after) + " " +
              std::to_string(armed_->samples));
}

Result<std::optional<LightRecord>> UnoLight::take() {
  const std::lock_guard lock(mutex_);
  if (!armed_) return state_.fault ? Result<std::optional<LightRecord>>(*state_.fault) : std::optional<LightRecord>();
  const Result<Reply> reply = ask("SEEN");
  if (!reply) return reply.fault();
  const std::optional<LightLine> line = decode_light(reply->words);
  if (!line)
    return Fault{"uno.protocol", "light sensor", "it does not answer SEEN as it should", "write its firmware anew"};
  if (line->state == LightLine::State::lost) {
    if (focalstage::Status again = look(); !again) return again.fault();
    return std::optional<LightRecord>();
  }
  if (line->state == LightLine::State::whole) {
    Result<LightRecord> whole = record(*line);
    if (!whole) return whole.fault();
    armed_.reset();
    return std::optional<LightRecord>(std::move(*whole));
  }
  if (monotonic_s() - armed_s_ < unsynced_s) return std::optional<LightRecord>();
  const Result<Reply> status = ask("STAT");
  if (!status) return status.fault();
  const std::optional<StatusLine> standing = decode_status(status->words);
  if (standing && standing->period_s > 0.0) return std::optional<LightRecord>();
  return unsynced();
}

Result<LightRecord> UnoLight::record(const LightLine& line) {
  const Result<Reply> status = ask("STAT");
  if (!status) return status.fault();
  const std::optional<StatusLine> standing = decode_status(status->words);
  if (!standing || !(standing->period_s > 0.0)) return unsynced();
  LightRecord record{armed_->eye, line.after_s, light_step_s, standing->period_s, {}};
  while (record.light.size() < line.samples) {
    const Result<Reply> data = ask("DATA " + std::to_string(record.light.size()));
    if (!data) return data.fault();
    const std::optional<std::vector<double>> samples = decode_samples(data->words);
    if (!samples || samples->empty()) {
      return Fault{"uno.protocol", "light sensor", "it does not answer DATA as it should", "write its firmware anew"};
    }
    record.light.insert(record.light.end(), samples->begin(), samples->end());
  }
  return record;
}

}  // namespace

}  // namespace uno

std::unique_ptr<LightSensor> make_uno_light(const UnoLightSettings& settings) {
  return std::make_unique<uno::UnoLight>(settings);
}

}  // namespace focalstage
