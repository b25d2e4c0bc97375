#pragma once

#include <umockdev.h>

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tests/devices/mcc1208/emulator/device.h"

namespace focalstage::mcc1208_emulator {

/// What the bus asks of the device on it, with the bus' lock held.
class Gadget {
 public:
  virtual ~Gadget() = default;
  virtual Answer control(const Setup& setup, std::span<const std::uint8_t> data) = 0;
  virtual void bulk_queued() = 0;
  virtual void clear_halt() = 0;
  virtual bool halted() const = 0;
  virtual double delay_s() const = 0;
};

/// A transfer of the host: the urb of usbfs and its buffer.
struct Urb {
  UMockdevIoctlClient* client = nullptr;  ///< the open file that it came from, and goes back to
  UMockdevIoctlData* urb = nullptr;
  UMockdevIoctlData* buffer = nullptr;
  gulong address = 0;
  bool control = false;
  std::size_t length = 0;
  std::size_t done = 0;
  int status = 0;
  double ready_s = 0.0;  ///< wall time from which the host may have it back
};

/// One device's usbfs node through umockdev (hardware.md 8.4): requests are answered by the gadget, bulk bytes wait
/// until it takes them.
class UsbBus {
 public:
  UsbBus(UMockdevTestbed* testbed, Gadget& gadget) : testbed_(testbed), gadget_(gadget) {}
  ~UsbBus();
  UsbBus(const UsbBus&) = delete;
  UsbBus& operator=(const UsbBus&) = delete;

  std::mutex& mutex() { return mutex_; }

  /// From outside, without the lock: the node comes and goes. `name` is "1-2", the text umockdev's description without
  /// it.
  void add(int bus, int number, const std::string& name, const std::string& attributes, const std::string& descriptors);
  void remove();
  bool added() const { return !path_.empty(); }

  // The rest with the lock.
  void cut();  ///< the device is gone from this moment on; its node still stands
  bool cut_off() const { return cut_; }
  /// The next bytes of the bulk transfers in their order; `most` at most, and no packet reaches into the next transfer.
  std::size_t next_packet(std::span<std::uint8_t> packet);
  void end_first_early();                       ///< the oldest bulk transfer ends short, as if it were whole
  std::optional<std::uint64_t> looks() const {  ///< by whoever has claimed it
    return claimed_by_ == nullptr ? std::nullopt : std::optional(looks_);
  }
  bool has_bulk() const { return !bulk_.empty(); }
  void refuse_bulk();  ///< the endpoint is halted: what is queued comes back with a stall

 private:
  static gboolean ioctl(UMockdevIoctlBase* base, UMockdevIoctlClient* client, gpointer self);
  void handle(UMockdevIoctlClient* client);
  int answer(gulong request, UMockdevIoctlClient* client, std::unique_lock<std::mutex>& lock);
  int claim(UMockdevIoctlClient* client);
  void forget_closed();
  int submit(UMockdevIoctlClient* client);
  void submit_control(Urb urb);
  int discard(UMockdevIoctlClient* client);
  bool reap(UMockdevIoctlClient* client, std::unique_lock<std::mutex>& lock);
  void complete(Urb urb, int status);
  static void forget(Urb& urb);

  UMockdevTestbed* testbed_;
  Gadget& gadget_;
  std::mutex mutex_;
  std::condition_variable reapable_;
  std::deque<Urb> bulk_;  ///< waiting for the device to take them
  std::deque<Urb> unanswered_;
  std::deque<Urb> done_;
  bool cut_ = true;
  std::string path_;  ///< empty: not plugged in
  std::vector<UMockdevIoctlBase*> handlers_;
  UMockdevIoctlClient* claimed_by_ = nullptr;
  std::uint64_t looks_ = 0;
};

}  // namespace focalstage::mcc1208_emulator
