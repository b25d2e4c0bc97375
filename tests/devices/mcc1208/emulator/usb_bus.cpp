#include "tests/devices/mcc1208/emulator/usb_bus.h"

#include <sys/ioctl.h>

#include <linux/usbdevice_fs.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <utility>

namespace focalstage::mcc1208_emulator {

namespace {

[[noreturn]] void give_up(const char* what, const GError* error) {
  std::fprintf(stderr, "mcc1208 emulator: %s: %s\n", what, error != nullptr ? error->message : "failed");
  std::abort();
}

std::string three_digits(int number) {
  char text[8];
  std::snprintf(text, sizeof text, "%03d", number);
  return text;
}

}  // namespace

UsbBus::~UsbBus() {
  remove();
  for (UMockdevIoctlBase* handler : handlers_) {
    g_signal_handlers_disconnect_by_data(handler, this);
    g_object_unref(handler);
  }
  for (auto* queue : {&bulk_, &unanswered_, &done_}) std::for_each(queue->begin(), queue->end(), forget);
  g_clear_object(&claimed_by_);
}

void UsbBus::add(int bus, int number, const std::string& name, const std::string& attributes,
                 const std::string& descriptors) {
  const std::string node = "bus/usb/" + three_digits(bus) + "/" + three_digits(number);
  const std::string path = "/devices/pci0000:00/0000:00:14.0/usb" + std::to_string(bus) + "/" + name;
  const std::string text = "P: " + path + "\nN: " + node + "=" + descriptors + "\nE: DEVNAME=/dev/" + node +
                           "\nE: DEVTYPE=usb_device\nE: SUBSYSTEM=usb\nE: BUSNUM=" + three_digits(bus) +
                           "\nE: DEVNUM=" + three_digits(number) +
                           "\nE: MAJOR=189\nE: MINOR=" + std::to_string((bus - 1) * 128 + number - 1) +
                           "\nA: busnum=" + std::to_string(bus) + "\\n\nA: devnum=" + std::to_string(number) +
                           "\\n\nA: speed=12\\n\nA: bConfigurationValue=1\\n\nA: bNumConfigurations=1\\n\n" +
                           attributes + "H: descriptors=" + descriptors + "\n\n";
  {
    const std::lock_guard lock(mutex_);
    cut_ = false;
  }
  GError* error = nullptr;
  // Who answers comes before the node: an opener that comes between them is ended by the test bed.
  UMockdevIoctlBase* handler = umockdev_ioctl_base_new();
  g_signal_connect(handler, "handle-ioctl", G_CALLBACK(ioctl), this);
  if (!umockdev_testbed_attach_ioctl(testbed_, ("/dev/" + node).c_str(), handler, &error)) give_up("attaching", error);
  handlers_.push_back(handler);
  if (!umockdev_testbed_add_from_string(testbed_, text.c_str(), &error)) give_up("plugging in", error);
  path_ = "/sys" + path;
}

void UsbBus::remove() {
  if (path_.empty()) return;
  {
    const std::lock_guard lock(mutex_);
    cut();
  }
  umockdev_testbed_uevent(testbed_, path_.c_str(), "remove");
  umockdev_testbed_remove_device(testbed_, path_.c_str());
  path_.clear();
}

void UsbBus::cut() {
  cut_ = true;
  while (!bulk_.empty()) complete(std::exchange(bulk_.front(), {}), -ESHUTDOWN), bulk_.pop_front();
  while (!unanswered_.empty()) complete(std::exchange(unanswered_.front(), {}), -ESHUTDOWN), unanswered_.pop_front();
}

void UsbBus::refuse_bulk() {
  while (!bulk_.empty()) complete(std::exchange(bulk_.front(), {}), -EPIPE), bulk_.pop_front();
}

std::size_t UsbBus::next_packet(std::span<std::uint8_t> packet) {
  if (bulk_.empty()) return 0;
  Urb& urb = bulk_.front();
  const std::size_t count = std::min(packet.size(), urb.length - urb.done);
  std::copy_n(urb.buffer->data + urb.done, count, packet.begin());
  urb.done += count;
  if (urb.done == urb.length) {
    complete(std::exchange(urb, {}), 0);
    bulk_.pop_front();
  }
  return count;
}

void UsbBus::end_first_early() {
  if (bulk_.empty()) return;
  complete(std::exchange(bulk_.front(), {}), 0);
  bulk_.pop_front();
}

void UsbBus::complete(Urb urb, int status) {
  urb.status = status;
  done_.push_back(urb);
  reapable_.notify_all();
}

void UsbBus::forget(Urb& urb) {
  g_clear_object(&urb.buffer);
  g_clear_object(&urb.urb);
  g_clear_object(&urb.client);
}

gboolean UsbBus::ioctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self) {
  static_cast<UsbBus*>(self)->handle(client);
  return TRUE;
}

void UsbBus::handle(UMockdevIoctlClient* client) {
  int error = 0;
  {
    std::unique_lock lock(mutex_);
    forget_closed();
    error = answer(umockdev_ioctl_client_get_request(client), client, lock);
  }
  umockdev_ioctl_client_complete(client, error == 0 ? 0 : -1, error);
}

int UsbBus::answer(gulong request, UMockdevIoctlClient* client, std::unique_lock<std::mutex>& lock) {
  if (request == USBDEVFS_REAPURB || request == USBDEVFS_REAPURBNDELAY) {
    if (reap(client, lock)) return 0;
    return cut_ ? ENODEV : EAGAIN;
  }
  if (cut_) return ENODEV;
  switch (request) {
    case USBDEVFS_GET_CAPABILITIES: {
      UMockdevIoctlData* told = umockdev_ioctl_data_resolve(umockdev_ioctl_client_get_arg(client), 0, 4, nullptr);
      guint32 capabilities = USBDEVFS_CAP_ZERO_PACKET;
      umockdev_ioctl_data_update(told, 0, reinterpret_cast<guint8*>(&capabilities), sizeof capabilities);
      g_object_unref(told);
      return 0;
    }
    case USBDEVFS_SUBMITURB:
      return submit(client);
    case USBDEVFS_DISCARDURB:
      return discard(client);
    case USBDEVFS_CLEAR_HALT:
      gadget_.clear_halt();
      return 0;
    case USBDEVFS_GETDRIVER:
    case USBDEVFS_IOCTL:
      return ENODATA;
    case USBDEVFS_CLAIMINTERFACE:
      return claim(client);
    case USBDEVFS_RELEASEINTERFACE:
      if (claimed_by_ == client) g_clear_object(&claimed_by_);
      return 0;
    case USBDEVFS_RESET:
    case USBDEVFS_SETCONFIGURATION:
      return 0;
    default:
      return ENOTTY;
  }
}

int UsbBus::claim(UMockdevIoctlClient* client) {
  if (claimed_by_ != nullptr && claimed_by_ != client) return EBUSY;
  if (claimed_by_ == nullptr) claimed_by_ = static_cast<UMockdevIoctlClient*>(g_object_ref(client));
  return 0;
}

// A file that is closed takes its transfers and its claim with it.
void UsbBus::forget_closed() {
  const auto closed = [](UMockdevIoctlClient* client) { return !umockdev_ioctl_client_get_connected(client); };
  for (auto* queue : {&bulk_, &unanswered_, &done_}) {
    for (auto urb = queue->begin(); urb != queue->end();) {
      if (!closed(urb->client)) {
        ++urb;
        continue;
      }
      forget(*urb);
      urb = queue->erase(urb);
    }
  }
  if (claimed_by_ != nullptr && closed(claimed_by_)) g_clear_object(&claimed_by_);
}

}  // namespace focalstage::mcc1208_emulator
