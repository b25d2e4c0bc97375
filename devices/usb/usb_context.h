#pragma once

#include <atomic>
#include <memory>
#include <thread>

#include "core/base/result.h"

struct libusb_context;

namespace focalstage {

/// libusb with one thread that handles its events for as long as this lives. Each `start` looks at the bus anew, so
/// that nothing depends on a udev daemon telling what was plugged in.
class UsbContext {
 public:
  static Result<std::shared_ptr<UsbContext>> start();
  explicit UsbContext(libusb_context* context);
  UsbContext(const UsbContext&) = delete;
  UsbContext& operator=(const UsbContext&) = delete;
  ~UsbContext();

  libusb_context* get() const { return context_; }

 private:
  void handle_events();

  libusb_context* context_;
  std::atomic<bool> ending_ = false;
  std::thread events_;
};

}  // namespace focalstage
