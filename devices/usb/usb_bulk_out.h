#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "core/base/result.h"
#include "devices/usb/usb_device.h"

struct libusb_transfer;

namespace focalstage {

/// What a queue of bulk transfers asks and tells. All are called by libusb's event thread, `fill` by `start` too: they
/// must not wait and must make no request of the device.
struct UsbBulkCalls {
  std::function<void(std::vector<std::uint8_t>&)> fill;  ///< the next bytes; none: nothing more is to be sent
  std::function<void(std::size_t bytes)> sent;           ///< the device took one filling whole
  std::function<void(const Fault&)> failed;              ///< once: nothing more is sent until `start`
};

/// Keeps a number of bulk transfers queued with the kernel, so that the device is never without bytes while the host is
/// busy for as long as they last.
class UsbBulkOut {
 public:
  /// The device must live longer than this.
  UsbBulkOut(UsbDevice& device, std::uint8_t endpoint, int transfers, UsbBulkCalls calls);
  UsbBulkOut(const UsbBulkOut&) = delete;
  UsbBulkOut& operator=(const UsbBulkOut&) = delete;
  ~UsbBulkOut();

  Status start();
  /// Cancels what is queued and waits, 50 ms at most, until nothing is under way. False: something still is.
  bool stop() noexcept;

 private:
  struct Slot;

  bool submit_next(Slot& slot, std::unique_lock<std::mutex>& lock);
  void ended(Slot& slot);
  void fail(const Fault& fault, std::unique_lock<std::mutex>& lock);
  bool drained(double longest_s) noexcept;

  UsbDevice& device_;
  UsbBulkCalls calls_;
  std::mutex mutex_;
  std::condition_variable idle_;
  bool running_ = false;
  int under_way_ = 0;
  std::vector<std::unique_ptr<Slot>> slots_;
};

}  // namespace focalstage
