#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"

struct libusb_context;
struct libusb_device_handle;

namespace focalstage {

struct UsbIds {
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
};

/// A control request (USB 2.0, 9.3) as the device sees it. `type` is its bmRequestType without the direction.
struct UsbRequest {
  std::uint8_t type = 0x40;  ///< vendor, to the device
  std::uint8_t request = 0;
  std::uint16_t value = 0;
  std::uint16_t index = 0;
};

/// libusb with one thread that handles its events; shared by what was opened in it.
class UsbContext;

/// An open device. Requests may come from any thread and never wait longer than their deadline. Nothing here knows what
/// the device is.
class UsbDevice {
 public:
  UsbDevice(std::shared_ptr<UsbContext> context, libusb_device_handle* handle, std::string address);
  UsbDevice(const UsbDevice&) = delete;
  UsbDevice& operator=(const UsbDevice&) = delete;
  ~UsbDevice();

  /// Where it is plugged in: "usb 1-2" is port 2 of bus 1.
  const std::string& address() const { return address_; }
  libusb_device_handle* handle() const { return handle_; }

  /// For this process alone. "usb.busy" where another has it.
  Status claim(int interface);

  Status control_out(const UsbRequest& request, std::span<const std::uint8_t> data, double deadline_s);
  /// As many bytes as came, `most` at most.
  Result<std::vector<std::uint8_t>> control_in(const UsbRequest& request, std::size_t most, double deadline_s);
  /// After a stall: the endpoint takes transfers again.
  Status clear_halt(std::uint8_t endpoint);

 private:
  std::shared_ptr<UsbContext> context_;
  libusb_device_handle* handle_;
  std::string address_;
  int claimed_ = -1;
};

/// All devices with these ids, opened but not claimed, which disturbs nobody. "usb.missing" where there is none;
/// "usb.permission" where none of them may be opened.
Result<std::vector<std::unique_ptr<UsbDevice>>> open_usb(const UsbIds& ids);

}  // namespace focalstage
