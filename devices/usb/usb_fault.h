#pragma once

#include <string>

#include "core/base/result.h"

namespace focalstage {

/// A libusb error code (libusb.h: LIBUSB_ERROR_...) as a fault of the device at `where`. Its codes: "usb.lost"
/// (unplugged), "usb.timeout", "usb.stall" (the device refused the request), "usb.permission", "usb.busy",
/// "usb.failed".
Fault usb_fault(int error, const std::string& where);

/// The same for a transfer's status (LIBUSB_TRANSFER_...).
Fault usb_transfer_fault(int status, const std::string& where);

}  // namespace focalstage
