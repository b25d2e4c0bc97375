#include "tests/devices/mcc1208/emulator/emulator.h"

#include <cstdlib>
#include <cstring>
#include <utility>

#include "tests/devices/mcc1208/emulator/usb_bus.h"

namespace focalstage::mcc1208_emulator {

namespace {

constexpr const char* descriptors =
    "1201000200000040DB09E80000010102030109022000010100C0320904000002000000000705810240000007050202400000";

bool under_wrapper() {
  const char* preloaded = std::getenv("LD_PRELOAD");
  return preloaded != nullptr && std::strstr(preloaded, "umockdev") != nullptr;
}

class LiveEmulator final : public Emulator, private Gadget {
 public:
  LiveEmulator(const Options& options, UMockdevTestbed* testbed, const Place& place)
      : options_(options),
        place_(place),
        own_testbed_(testbed == nullptr ? umockdev_testbed_new() : nullptr),
        device_(options),
        bus_(testbed == nullptr ? own_testbed_ : testbed, *this) {}

  ~LiveEmulator() override {
    bus_.remove();
    if (own_testbed_ != nullptr) g_object_unref(own_testbed_);
  }

  void plug_in() override {
    const std::lock_guard plugging(plugging_);
    bus_.remove();
    {
      const std::lock_guard lock(bus_.mutex());
      device_.power_on();
      taken_ = 0;
      answered_ = 0;
    }
    const std::string attributes = "A: idVendor=09db\\n\nA: idProduct=00e8\\n\nA: serial=" + options_.serial + "\\n\n";
    const std::string name = std::to_string(place_.bus) + "-" + std::to_string(place_.port);
    bus_.add(place_.bus, number_++, name, attributes, descriptors);
  }

  void unplug() override {
    const std::lock_guard plugging(plugging_);
    if (!bus_.added()) return;
    bus_.remove();
    const std::lock_guard lock(bus_.mutex());
    device_.power_on();  // no power: its outputs are at rest
  }

  void misbehave(const Misbehaviour& how) override {
    const std::lock_guard lock(bus_.mutex());
    how_ = how;
  }

  void advance_to(double device_time_s) override {
    std::vector<Output> outputs;
    bool fell_out = false;
    {
      const std::lock_guard lock(bus_.mutex());
      device_.advance_to(device_time_s, [this](std::span<std::uint8_t> bytes) { return packet(bytes); });
      if (device_.halted()) bus_.refuse_bulk();
      outputs = device_.outputs_since();
      fell_out = bus_.cut_off();
    }
    if (fell_out) unplug();
    if (!heard_) return;
    for (const Output& output : outputs) heard_(output);
  }

  void on_output(std::function<void(const Output&)> heard) override { heard_ = std::move(heard); }

  double time_s() const override {
    return with_device([](const Device& d) { return d.time_s(); });
  }
  std::array<int, 2> codes() const override {
    return with_device([](const Device& d) { return d.codes(); });
  }
  std::vector<Request> requests() const override {
    return with_device([](const Device& d) { return d.requests(); });
  }
  std::optional<std::uint8_t> pins(int port) const override {
    return with_device([port](const Device& d) { return d.pins(port); });
  }
  bool plugged_in() const override {
    return with_device([this](const Device&) { return !bus_.cut_off(); });
  }
  std::optional<std::uint64_t> host_looks() const override {
    return with_device([this](const Device&) { return bus_.looks(); });
  }
  std::uint64_t bulk_bytes() const override {
    return with_device([this](const Device&) { return taken_; });
  }

 private:
  template <class Ask>
  auto with_device(Ask&& ask) const -> decltype(ask(std::declval<const Device&>())) {
    const std::lock_guard lock(bus_.mutex());
    return ask(device_);
  }

  // One packet from the host, cut where it is unplugged.
  std::size_t packet(std::span<std::uint8_t> bytes) {
    if (how_.starve || how_.silent || bus_.cut_off()) return 0;
    if (how_.short_write && bus_.has_bulk()) {
      const std::size_t count = bus_.next_packet(bytes.first(std::min(bytes.size(), *how_.short_write)));
      how_.short_write.reset();
      bus_.end_first_early();
      taken_ += count;
      return count;
    }
    std::size_t most = bytes.size();
    if (how_.cut_at_byte) most = std::min<std::uint64_t>(most, *how_.cut_at_byte - std::min(*how_.cut_at_byte, taken_));
    if (most == 0) {
      bus_.cut();
      return 0;
    }
    const std::size_t count = bus_.next_packet(bytes.first(most));
    taken_ += count;
    return count;
  }

  Answer control(const Setup& setup, std::span<const std::uint8_t> data) override {
    const std::uint64_t number = answered_++;
    if (how_.cut_at_request && number >= *how_.cut_at_request) bus_.cut();
    if (bus_.cut_off()) return {Reply::none, {}};
    return device_.control(setup, data, how_);
  }
  void bulk_queued() override {
    device_.take([this](std::span<std::uint8_t> bytes) { return packet(bytes); });
  }
  void clear_halt() override { device_.clear_halt(); }
  bool halted() const override { return device_.halted(); }
  double delay_s() const override { return how_.delay_s; }

  Options options_;
  Place place_;
  UMockdevTestbed* own_testbed_;
  Device device_;
  mutable UsbBus bus_;
  std::mutex plugging_;  ///< before that of the bus
  Misbehaviour how_;
  std::function<void(const Output&)> heard_;
  std::uint64_t taken_ = 0;
  std::uint64_t answered_ = 0;
  int number_ = 5;
};

}  // namespace

std::unique_ptr<Emulator> Emulator::create(const Options& options, UMockdevTestbed* testbed, const Place& place) {
  if (!under_wrapper()) return nullptr;
  return std::make_unique<LiveEmulator>(options, testbed, place);
}

}  // namespace focalstage::mcc1208_emulator
