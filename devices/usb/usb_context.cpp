#include "devices/usb/usb_context.h"

#include <libusb.h>

#include <sys/time.h>

#include <system_error>

#include "devices/usb/usb_fault.h"

namespace focalstage {

Result<std::shared_ptr<UsbContext>> UsbContext::start() {
  libusb_context* context = nullptr;
  if (const int error = libusb_init(&context); error != LIBUSB_SUCCESS) return usb_fault(error, "usb");
  try {
    return std::make_shared<UsbContext>(context);
  } catch (const std::system_error& error) {
    libusb_exit(context);
    return Fault{"usb.thread", "usb", std::string("no thread can be had: ") + error.what(), ""};
  }
}

UsbContext::UsbContext(libusb_context* context) : context_(context), events_([this] { handle_events(); }) {}

UsbContext::~UsbContext() {
  ending_ = true;
  libusb_interrupt_event_handler(context_);
  events_.join();
  libusb_exit(context_);
}

void UsbContext::handle_events() {
  while (!ending_) {
    timeval longest{0, 100000};
    libusb_handle_events_timeout_completed(context_, &longest, nullptr);
  }
}

}  // namespace focalstage
