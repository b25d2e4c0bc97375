#include "devices/usb/usb_fault.h"

#include <libusb.h>

namespace focalstage {

namespace {

constexpr const char* plug_in_again = "plug it in and open it again";

}  // namespace

Fault usb_fault(int error, const std::string& where) {
  switch (error) {
    case LIBUSB_ERROR_NO_DEVICE:
      return {"usb.lost", where, "the device is no longer there", plug_in_again};
    case LIBUSB_ERROR_TIMEOUT:
      return {"usb.timeout", where, "the device did not answer in time", "see its cable and power"};
    case LIBUSB_ERROR_PIPE:
      return {"usb.stall", where, "the device refused the request", ""};
    case LIBUSB_ERROR_ACCESS:
      return {"usb.permission", where, "the device may not be opened by this user", "add the udev rule of its README"};
    case LIBUSB_ERROR_BUSY:
      return {"usb.busy", where, "another program holds the device", "end that program"};
    default:
      return {"usb.failed", where, std::string("the transfer failed: ") + libusb_error_name(error), plug_in_again};
  }
}

Fault usb_transfer_fault(int status, const std::string& where) {
  switch (status) {
    case LIBUSB_TRANSFER_NO_DEVICE:
      return usb_fault(LIBUSB_ERROR_NO_DEVICE, where);
    case LIBUSB_TRANSFER_TIMED_OUT:
      return usb_fault(LIBUSB_ERROR_TIMEOUT, where);
    case LIBUSB_TRANSFER_STALL:
      return usb_fault(LIBUSB_ERROR_PIPE, where);
    case LIBUSB_TRANSFER_OVERFLOW:
      return usb_fault(LIBUSB_ERROR_OVERFLOW, where);
    default:
      return usb_fault(LIBUSB_ERROR_IO, where);
  }
}

}  // namespace focalstage
