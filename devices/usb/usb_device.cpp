#include "devices/usb/usb_device.h"

#include <libusb.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "devices/usb/usb_context.h"
#include "devices/usb/usb_fault.h"

namespace focalstage {

namespace {

// libusb reads a timeout of 0 as none.
unsigned milliseconds(double deadline_s) {
  return static_cast<unsigned>(std::clamp(std::ceil(deadline_s * 1e3), 1.0, 60000.0));
}

std::string address_of(libusb_device* device) {
  std::uint8_t ports[8] = {};
  const int depth = libusb_get_port_numbers(device, ports, 8);
  std::string address = "usb " + std::to_string(libusb_get_bus_number(device));
  for (int i = 0; i < depth; ++i) address += (i == 0 ? "-" : ".") + std::to_string(ports[i]);
  return address;
}

bool has_ids(libusb_device* device, const UsbIds& ids) {
  libusb_device_descriptor descriptor{};
  return libusb_get_device_descriptor(device, &descriptor) == LIBUSB_SUCCESS && descriptor.idVendor == ids.vendor &&
         descriptor.idProduct == ids.product;
}

struct DeviceList {
  explicit DeviceList(libusb_context* context) : count(libusb_get_device_list(context, &devices)) {}
  DeviceList(const DeviceList&) = delete;
  DeviceList& operator=(const DeviceList&) = delete;
  ~DeviceList() {
    if (devices != nullptr) libusb_free_device_list(devices, 1);
  }

  libusb_device** devices = nullptr;
  std::ptrdiff_t count;
};

std::string hexadecimal(const UsbIds& ids) {
  char text[16];
  std::snprintf(text, sizeof text, "%04x:%04x", ids.vendor, ids.product);
  return text;
}

}  // namespace

UsbDevice::UsbDevice(std::shared_ptr<UsbContext> context, libusb_device_handle* handle, std::string address)
    : context_(std::move(context)), handle_(handle), address_(std::move(address)) {}

UsbDevice::~UsbDevice() {
  if (claimed_ >= 0) libusb_release_interface(handle_, claimed_);
  libusb_close(handle_);
}

Status UsbDevice::claim(int interface) {
  libusb_set_auto_detach_kernel_driver(handle_, 1);
  if (const int error = libusb_claim_interface(handle_, interface); error != LIBUSB_SUCCESS) {
    return usb_fault(error, address_);
  }
  claimed_ = interface;
  return {};
}

Status UsbDevice::control_out(const UsbRequest& request, std::span<const std::uint8_t> data, double deadline_s) {
  std::vector<std::uint8_t> bytes(data.begin(), data.end());  // libusb takes no const
  const int sent =
      libusb_control_transfer(handle_, request.type, request.request, request.value, request.index, bytes.data(),
                              static_cast<std::uint16_t>(bytes.size()), milliseconds(deadline_s));
  if (sent < 0) return usb_fault(sent, address_);
  if (static_cast<std::size_t>(sent) != bytes.size()) return usb_fault(LIBUSB_ERROR_IO, address_);
  return {};
}

Result<std::vector<std::uint8_t>> UsbDevice::control_in(const UsbRequest& request, std::size_t most,
                                                        double deadline_s) {
  std::vector<std::uint8_t> bytes(std::min<std::size_t>(most, 4096));
  const auto type = static_cast<std::uint8_t>(request.type | LIBUSB_ENDPOINT_IN);
  const int came = libusb_control_transfer(handle_, type, request.request, request.value, request.index, bytes.data(),
                                           static_cast<std::uint16_t>(bytes.size()), milliseconds(deadline_s));
  if (came < 0) return usb_fault(came, address_);
  bytes.resize(static_cast<std::size_t>(came));
  return bytes;
}

Status UsbDevice::clear_halt(std::uint8_t endpoint) {
  const int error = libusb_clear_halt(handle_, endpoint);
  if (error != LIBUSB_SUCCESS) return usb_fault(error, address_);
  return {};
}

Result<std::vector<std::unique_ptr<UsbDevice>>> open_usb(const UsbIds& ids) {
  auto context = UsbContext::start();
  if (!context) return context.fault();
  const DeviceList list((*context)->get());
  std::vector<std::unique_ptr<UsbDevice>> opened;
  Fault why{"usb.missing", hexadecimal(ids), "no such USB device is plugged in", "see its cable and power"};
  for (std::ptrdiff_t i = 0; i < list.count; ++i) {
    libusb_device* device = list.devices[i];
    if (!has_ids(device, ids)) continue;
    libusb_device_handle* handle = nullptr;
    if (const int error = libusb_open(device, &handle); error != LIBUSB_SUCCESS) {
      why = usb_fault(error, address_of(device));
      continue;
    }
    opened.push_back(std::make_unique<UsbDevice>(*context, handle, address_of(device)));
  }
  if (opened.empty()) return why;
  return opened;
}

}  // namespace focalstage
