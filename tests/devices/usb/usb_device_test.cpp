#include "devices/usb/usb_device.h"

#include <atomic>
#include <cstring>
#include <thread>

#include <doctest/doctest.h>

#include "devices/roles/clock.h"
#include "devices/usb/usb_bulk_out.h"
#include "devices/usb/usb_fault.h"
#include "tests/devices/mcc1208/emulator/emulator.h"
#include "tests/devices/mcc1208/emulator/real_time.h"

namespace focalstage {
namespace {

namespace emulated = mcc1208_emulator;

constexpr UsbIds ids{0x09db, 0x00e8};
constexpr std::uint8_t serial_request = 0x48;

std::unique_ptr<emulated::Emulator> plugged() {
  auto emulator = emulated::Emulator::create();
  REQUIRE_MESSAGE(emulator, "these tests run under umockdev-wrapper, as ctest does it");
  emulator->plug_in();
  return emulator;
}

TEST_CASE("none is a fault that names the ids, and so is one that left") {
  const auto emulator = plugged();
  CHECK(open_usb({0x1234, 0x5678}).fault().code == "usb.missing");
  CHECK(open_usb({0x1234, 0x5678}).fault().where == "1234:5678");
  auto devices = open_usb(ids);
  REQUIRE(devices.ok());
  REQUIRE(devices->size() == 1);
  emulator->unplug();
  CHECK(devices->front()->control_in({0x40, serial_request, 0, 0}, 8, 0.1).fault().code == "usb.lost");
  CHECK(open_usb(ids).fault().code == "usb.missing");
}

TEST_CASE("requests end in an answer, a stall or their deadline") {
  const auto emulator = plugged();
  auto devices = open_usb(ids);
  REQUIRE(devices.ok());
  UsbDevice& device = *devices->front();
  CHECK(device.address() == "usb 1-2");
  const auto serial = device.control_in({0x40, serial_request, 0, 0}, 64, 0.1);
  REQUIRE(serial.ok());
  CHECK(std::string(serial->begin(), serial->end()) == "01D0F1A2");
  CHECK(device.control_in({0x40, 0x77, 0, 0}, 8, 0.1).fault().code == "usb.stall");
  CHECK(device.control_out({0x40, 0x77, 0, 0}, {}, 0.1).fault().code == "usb.stall");
  emulated::Misbehaviour how;
  how.silent = true;
  emulator->misbehave(how);
  const double start_s = monotonic_s();
  CHECK(device.control_in({0x40, serial_request, 0, 0}, 8, 0.05).fault().code == "usb.timeout");
  CHECK(monotonic_s() - start_s < 0.15);
  emulator->misbehave({});
  CHECK(device.control_in({0x40, serial_request, 0, 0}, 8, 0.1).ok());
}

TEST_CASE("two may look at a device, and one may have it") {
  const auto emulator = plugged();
  auto first = open_usb(ids);
  auto second = open_usb(ids);
  REQUIRE((first.ok() && second.ok()));
  REQUIRE(first->front()->claim(0).ok());
  CHECK(second->front()->claim(0).fault().code == "usb.busy");
  CHECK(second->front()->control_in({0x40, serial_request, 0, 0}, 8, 0.1).ok());
  first->clear();
  CHECK(second->front()->claim(0).ok());
}

TEST_CASE("a queue is filled again as it is taken, stops at once and can be started again") {
  const auto emulator = plugged();
  const emulated::RealTime real_time(*emulator);
  auto devices = open_usb(ids);
  REQUIRE(devices.ok());
  std::atomic<int> filled = 0;
  std::atomic<int> sent = 0;
  std::atomic<int> failed = 0;
  UsbBulkCalls calls;
  calls.fill = [&](std::vector<std::uint8_t>& bytes) { bytes.assign(1000, static_cast<std::uint8_t>(++filled)); };
  calls.sent = [&](std::size_t bytes) { sent += bytes == 1000 ? 1 : 0; };
  calls.failed = [&](const Fault&) { ++failed; };
  UsbBulkOut queue(*devices->front(), 0x02, 3, calls);
  REQUIRE(queue.start().ok());
  sleep_until(monotonic_s() + 0.1);
  CHECK(sent == 4);  // the device keeps 4096 bytes and plays nothing
  CHECK(filled == 7);
  const double start_s = monotonic_s();
  CHECK(queue.stop());
  CHECK(monotonic_s() - start_s < 0.05);
  CHECK(failed == 0);
  REQUIRE(queue.start().ok());
  CHECK(filled == 10);
  emulator->unplug();
  for (int i = 0; i < 500 && failed == 0; ++i) sleep_until(monotonic_s() + 0.001);
  CHECK(failed == 1);
  CHECK(queue.stop());
}

TEST_CASE("each way to fail has its own code") {
  CHECK(usb_fault(-3, "here").code == "usb.permission");
  CHECK(usb_fault(-4, "here").code == "usb.lost");
  CHECK(usb_fault(-99, "here").code == "usb.failed");
  CHECK(usb_fault(-99, "here").where == "here");
  CHECK(usb_transfer_fault(5, "here").code == "usb.lost");
  CHECK(usb_transfer_fault(4, "here").code == "usb.stall");
}

}  // namespace
}  // namespace focalstage
