#include "devices/mcc1208/unit.h"

namespace focalstage {

namespace {

constexpr std::uint8_t vendor_request = 0x40;

UsbRequest usb_request(MccRequest request, int value, int index) {
  return {vendor_request, static_cast<std::uint8_t>(request), static_cast<std::uint16_t>(value),
          static_cast<std::uint16_t>(index)};
}

}  // namespace

Result<std::string> MccUnit::serial() {
  const auto bytes = ask(MccRequest::serial, 0, 8);
  if (!bytes) return bytes.fault();
  const auto serial = read_mcc_serial(*bytes);
  if (!serial) return garbled("serial number");
  return *serial;
}

Result<MccStatus> MccUnit::status() {
  const auto bytes = ask(MccRequest::status, 0, 2);
  if (!bytes) return bytes.fault();
  const auto status = read_mcc_status(*bytes);
  if (!status) return garbled("status");
  return *status;
}

Status MccUnit::clear_errors() {
  if (const Status cleared = send(MccRequest::status, 0, 0); !cleared) return cleared;
  return device_->clear_halt(mcc_bulk_out);
}

Status MccUnit::scan_start(std::uint32_t pacer) { return send(MccRequest::scan_start, 0, 0, mcc_scan_start(pacer)); }

Status MccUnit::scan_stop() { return send(MccRequest::scan_stop, 0, 0); }

Status MccUnit::clear_fifo() { return send(MccRequest::clear_fifo, 0, 0); }

Status MccUnit::set_output(int channel, int code) { return send(MccRequest::output, code, channel); }

Result<std::array<int, 2>> MccUnit::outputs() {
  const auto bytes = ask(MccRequest::output, 0, 4);
  if (!bytes) return bytes.fault();
  const auto codes = read_mcc_outputs(*bytes);
  if (!codes) return garbled("outputs");
  return *codes;
}

Status MccUnit::set_port_out(int port) { return send(MccRequest::direction, 0, port); }

Status MccUnit::set_latch(int port, std::uint8_t levels) { return send(MccRequest::latch, levels, port); }

Result<std::uint8_t> MccUnit::latch(int port) {
  const auto bytes = ask(MccRequest::latch, port, 1);
  if (!bytes) return bytes.fault();
  if (bytes->size() != 1) return garbled("latch");
  return bytes->front();
}

Status MccUnit::blink(int times) {
  const std::array<std::uint8_t, 1> count{static_cast<std::uint8_t>(times)};
  return send(MccRequest::blink, 0, 0, count);
}

Status MccUnit::send(MccRequest request, int value, int index, std::span<const std::uint8_t> data) {
  return device_->control_out(usb_request(request, value, index), data, answer_s_);
}

Result<std::vector<std::uint8_t>> MccUnit::ask(MccRequest request, int index, std::size_t most) {
  return device_->control_in(usb_request(request, 0, index), most, answer_s_);
}

Fault MccUnit::garbled(const char* what) const {
  return {"mcc1208.answer", address(), std::string("its ") + what + " makes no sense",
          "see that it is a USB-1208FS-Plus"};
}

}  // namespace focalstage
