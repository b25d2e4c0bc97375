#include "devices/usb/usb_bulk_out.h"

#include <libusb.h>

#include <chrono>
#include <utility>

#include "devices/usb/usb_fault.h"

namespace focalstage {

namespace {

// A cancelled transfer comes back at once; a device that takes longer than the second is beyond help.
constexpr double stop_s = 0.05;
constexpr double last_wait_s = 2.0;

}  // namespace

struct UsbBulkOut::Slot {
  UsbBulkOut* owner = nullptr;
  libusb_transfer* transfer = nullptr;
  std::vector<std::uint8_t> bytes;
  bool under_way = false;
};

UsbBulkOut::UsbBulkOut(UsbDevice& device, std::uint8_t endpoint, int transfers, UsbBulkCalls calls)
    : device_(device), calls_(std::move(calls)) {
  for (int i = 0; i < transfers; ++i) {
    auto slot = std::make_unique<Slot>();
    slot->owner = this;
    slot->transfer = libusb_alloc_transfer(0);
    const auto back = [](libusb_transfer* transfer) {
      Slot& ended_slot = *static_cast<Slot*>(transfer->user_data);
      ended_slot.owner->ended(ended_slot);
    };
    libusb_fill_bulk_transfer(slot->transfer, device.handle(), endpoint, nullptr, 0, back, slot.get(), 0);
    slots_.push_back(std::move(slot));
  }
}

UsbBulkOut::~UsbBulkOut() {
  stop();
  drained(last_wait_s);
  for (auto& slot : slots_) {
    if (slot->under_way) {
      slot.release();  // NOLINT: libusb may still write to it; better lost than used after its end
    } else {
      libusb_free_transfer(slot->transfer);
    }
  }
}

Status UsbBulkOut::start() {
  std::unique_lock lock(mutex_);
  if (under_way_ > 0) return Fault{"usb.busy", device_.address(), "an earlier transfer has not come back", ""};
  running_ = true;
  for (const auto& slot : slots_) {
    if (!submit_next(*slot, lock)) break;
  }
  if (running_) return {};
  return Fault{"usb.failed", device_.address(), "the first transfers could not be sent", "plug it in again"};
}

bool UsbBulkOut::stop() noexcept {
  {
    const std::lock_guard lock(mutex_);
    running_ = false;
    for (const auto& slot : slots_) {
      if (slot->under_way) libusb_cancel_transfer(slot->transfer);
    }
  }
  return drained(stop_s);
}

bool UsbBulkOut::drained(double longest_s) noexcept {
  std::unique_lock lock(mutex_);
  return idle_.wait_for(lock, std::chrono::duration<double>(longest_s), [this] { return under_way_ == 0; });
}

// With the lock, before and after. False: nothing was sent.
bool UsbBulkOut::submit_next(Slot& slot, std::unique_lock<std::mutex>& lock) {
  slot.bytes.clear();
  calls_.fill(slot.bytes);
  if (slot.bytes.empty()) return false;
  slot.transfer->buffer = slot.bytes.data();
  slot.transfer->length = static_cast<int>(slot.bytes.size());
  slot.under_way = true;
  ++under_way_;
  const int error = libusb_submit_transfer(slot.transfer);
  if (error == LIBUSB_SUCCESS) return true;
  slot.under_way = false;
  --under_way_;
  fail(usb_fault(error, device_.address()), lock);
  return false;
}

void UsbBulkOut::ended(Slot& slot) {
  std::unique_lock lock(mutex_);
  slot.under_way = false;
  --under_way_;
  if (running_) {
    const auto taken = static_cast<std::size_t>(slot.transfer->actual_length);
    if (slot.transfer->status != LIBUSB_TRANSFER_COMPLETED) {
      fail(usb_transfer_fault(slot.transfer->status, device_.address()), lock);
    } else if (taken != slot.bytes.size()) {
      fail({"usb.short", device_.address(),
            "the device took " + std::to_string(taken) + " of " + std::to_string(slot.bytes.size()) + " bytes", ""},
           lock);
    } else {
      calls_.sent(taken);
      submit_next(slot, lock);
    }
  }
  if (under_way_ == 0) idle_.notify_all();
}

void UsbBulkOut::fail(const Fault& fault, std::unique_lock<std::mutex>& lock) {
  running_ = false;
  for (const auto& slot : slots_) {
    if (slot->under_way) libusb_cancel_transfer(slot->transfer);
  }
  lock.unlock();
  calls_.failed(fault);
  lock.lock();
}

}  // namespace focalstage
