#include "devices/uno/board.h"

#include <chrono>
#include <system_error>
#include <utility>

#include "devices/roles/clock.h"
#include "devices/uno/probe.h"
#include "devices/uno/table.h"
#include "devices/uno/uno.h"

namespace focalstage {

std::unique_ptr<TriggerBoard> make_uno(const UnoSettings& settings) {
  return std::make_unique<uno::UnoBoard>(settings);
}

namespace uno {

namespace {

constexpr unsigned our_protocol = 1;
constexpr double answer_s = 0.1;
constexpr double job_s = 2.0;
constexpr std::chrono::milliseconds dark_within{45};

/// What waiting will not mend.
bool is_final(const Fault& fault) {
  return fault.code == "serial.busy" || fault.code == "serial.denied" || fault.code == "uno.protocol" ||
         fault.code == "uno.several";
}

Fault not_open() { return {"uno.closed", "trigger board", "it is not open", "open it"}; }

Fault odd_answer(const std::string& path, const std::string& command) {
  return {"uno.protocol", path, "the board does not answer " + command + " as it should",
          "write the firmware of this version to it (devices/firmware/README.md)"};
}

Status expect_ok(Dialogue& dialogue, const std::string& command) {
  const Result<Reply> reply = dialogue.insist(command, monotonic_s() + answer_s, answer_s / 4.0);
  if (!reply) return reply.fault();
  return reply->kind == ReplyKind::ok ? focalstage::Status{} : odd_answer(dialogue.path(), command);
}

std::string polarity(const char* eye, bool opens_high) {
  return std::string("POL ") + eye + (opens_high ? " H" : " L");
}

}  // namespace

UnoBoard::UnoBoard(UnoSettings settings) : settings_(std::move(settings)) {}

focalstage::Status UnoBoard::open() {
  const std::lock_guard lifecycle(lifecycle_);
  {
    const std::lock_guard lock(mutex_);
    if (at_work_) return {};
  }
  stop_worker();
  return connect();
}

focalstage::Status UnoBoard::connect() {
  UnoSettings meant = settings_;
  if (meant.serial.empty()) meant.serial = id().serial;
  Result<DeviceId> found = find_uno(meant);
  if (!found) return fail(found.fault());
  {
    const std::lock_guard lock(mutex_);
    id_ = *found;
  }
  Result<SerialPort> port = SerialPort::open(found->address);
  if (!port) return fail(port.fault());
  Dialogue dialogue(std::move(port).value(), waker_);
  const Result<StatusLine> first = greet(dialogue);
  if (!first) return fail(first.fault());
  start(std::move(dialogue), *first);
  return {};
}

/// Finds the firmware, and makes it safe.
Result<StatusLine> UnoBoard::greet(Dialogue& dialogue) const {
  const Result<Reply> hello = dialogue.insist("HELLO", monotonic_s() + settings_.boot_s, answer_s);
  if (!hello) return hello.fault();
  if (hello->kind != ReplyKind::ok || decode_hello(hello->words) != our_protocol) {
    return odd_answer(dialogue.path(), "HELLO");
  }
  for (const std::string& command :
       {std::string("SAFE"), polarity("L", settings_.opens_high.left), polarity("R", settings_.opens_high.right)}) {
    if (const focalstage::Status ok = expect_ok(dialogue, command); !ok) return ok.fault();
  }
  const Result<Reply> reply = dialogue.insist("STAT", monotonic_s() + answer_s, answer_s / 4.0);
  if (!reply) return reply.fault();
  const std::optional<StatusLine> status = decode_status(reply->words);
  if (!status) return odd_answer(dialogue.path(), "STAT");
  dialogue.take_unasked();  // that it has started is no news here
  return *status;
}

void UnoBoard::start(Dialogue dialogue, const StatusLine& first) {
  {
    const std::lock_guard lock(mutex_);
    phase_ = DevicePhase::ready;
    fault_.reset();
    heard_s_ = dialogue.heard_s();
    report_ = {};
    board_bad_lines_ = 0;
    loaded_ = false;
    newest_ = first;
    at_work_ = true;
    stopping_ = false;
  }
  try {
    worker_ = std::jthread([this, talk = std::move(dialogue)]() mutable { run(talk); });
  } catch (const std::system_error& error) {
    const std::lock_guard lock(mutex_);
    at_work_ = false;
    phase_ = DevicePhase::refused;
    fault_ = Fault{"uno.thread", "trigger board", std::string("no thread can be had: ") + error.what(), ""};
  }
}

void UnoBoard::stop_worker() {
  if (!worker_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  waker_.ring();
  worker_.join();
}

void UnoBoard::close() {
  const std::lock_guard lifecycle(lifecycle_);
  stop_worker();
  const std::lock_guard lock(mutex_);
  phase_ = DevicePhase::off;
  fault_.reset();
}

focalstage::Status UnoBoard::fail(const Fault& fault) {
  const std::lock_guard lock(mutex_);
  phase_ = is_final(fault) ? DevicePhase::refused : DevicePhase::lost;
  fault_ = fault;
  return fault;
}

DeviceId UnoBoard::id() const {
  const std::lock_guard lock(mutex_);
  return id_;
}

DeviceState UnoBoard::state() const {
  const std::lock_guard lock(mutex_);
  return {phase_, fault_, heard_s_, {}};
}

BoardReport UnoBoard::report() const {
  const std::lock_guard lock(mutex_);
  return report_;
}

focalstage::Status UnoBoard::hand_over(Job job) {
  const std::lock_guard asking(asking_);
  std::unique_lock lock(mutex_);
  if (!at_work_) return fault_ ? *fault_ : not_open();
  job_ = &job;
  waker_.ring();
  changed_.wait(lock, [&] { return job.outcome.has_value(); });
  return *job.outcome;
}

focalstage::Status UnoBoard::load(const BoardTable& table) {
  Result<std::vector<std::string>> commands = table_commands(table);
  if (!commands) return commands.fault();
  return hand_over({Purpose::load, std::move(commands).value(), monotonic_s() + job_s, {}});
}

focalstage::Status UnoBoard::arm() { return hand_over({Purpose::arm, {"ARM"}, monotonic_s() + job_s, {}}); }

focalstage::Status UnoBoard::identify() {
  return hand_over({Purpose::identify, {"TEST", "BLINK"}, monotonic_s() + job_s, {}});
}

bool UnoBoard::dark() noexcept {
  try {
    std::unique_lock lock(mutex_);
    if (!at_work_) return false;
    const std::uint64_t ticket = ++dark_asked_;
    waker_.ring();
    changed_.wait_for(lock, dark_within, [&] { return dark_told_ >= ticket || !at_work_; });
    return dark_told_ >= ticket;
  } catch (const std::system_error&) {
    return false;
  }
}

}  // namespace uno

}  // namespace focalstage
