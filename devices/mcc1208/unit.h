#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "core/base/result.h"
#include "devices/mcc1208/packets.h"
#include "devices/usb/usb_device.h"

namespace focalstage {

/// A USB-1208FS-Plus that is open, as calls: all that is ever asked of it. Any thread; none waits longer than
/// `answer_s`.
class MccUnit {
 public:
  MccUnit(std::unique_ptr<UsbDevice> device, double answer_s) : device_(std::move(device)), answer_s_(answer_s) {}

  UsbDevice& device() { return *device_; }
  const std::string& address() const { return device_->address(); }

  Result<std::string> serial();
  Result<MccStatus> status();
  Status clear_errors();  ///< of the status, and of the bulk endpoint
  Status scan_start(std::uint32_t pacer);
  Status scan_stop();
  Status clear_fifo();
  Status set_output(int channel, int code);  ///< refused by the device while it scans
  Result<std::array<int, 2>> outputs();
  Status set_port_out(int port);
  Status set_latch(int port, std::uint8_t levels);
  Result<std::uint8_t> latch(int port);
  Status blink(int times);

 private:
  Status send(MccRequest request, int value, int index, std::span<const std::uint8_t> data = {});
  Result<std::vector<std::uint8_t>> ask(MccRequest request, int index, std::size_t most);
  Fault garbled(const char* what) const;

  std::unique_ptr<UsbDevice> device_;
  double answer_s_;
};

}  // namespace focalstage
