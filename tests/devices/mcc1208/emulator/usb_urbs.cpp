// What the bus does with the host's transfers.
#include <sys/ioctl.h>

#include <linux/usbdevice_fs.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstring>

#include "tests/devices/mcc1208/emulator/usb_bus.h"

namespace focalstage::mcc1208_emulator {

namespace {

// A host that asks for finished transfers in a loop is let wait so long, or it would fill a core.
constexpr auto reap_wait = std::chrono::milliseconds(1);
constexpr std::size_t setup_bytes = 8;

double wall_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

}  // namespace

int UsbBus::submit(UMockdevIoctlClient* client) {
  const std::size_t size = umockdev_ioctl_client_get_request(client) >> 16 & 0x3fff;
  Urb urb;
  urb.client = static_cast<UMockdevIoctlClient*>(g_object_ref(client));
  urb.urb = umockdev_ioctl_data_resolve(umockdev_ioctl_client_get_arg(client), 0, size, nullptr);
  if (urb.urb == nullptr) {
    forget(urb);
    return EFAULT;
  }
  usbdevfs_urb asked{};
  std::memcpy(&asked, urb.urb->data, sizeof asked);
  urb.address = urb.urb->client_addr;
  urb.length = static_cast<std::size_t>(asked.buffer_length);
  urb.buffer = umockdev_ioctl_data_resolve(urb.urb, offsetof(usbdevfs_urb, buffer), urb.length, nullptr);
  urb.control = asked.type == USBDEVFS_URB_TYPE_CONTROL;
  if (urb.buffer == nullptr || (urb.control && urb.length < setup_bytes)) {
    forget(urb);
    return EFAULT;
  }
  if (urb.control) {
    submit_control(urb);
  } else if (asked.type != USBDEVFS_URB_TYPE_BULK || asked.endpoint != 0x02) {
    forget(urb);
    return ENOENT;
  } else if (gadget_.halted()) {
    complete(urb, -EPIPE);
  } else {
    bulk_.push_back(urb);
    gadget_.bulk_queued();
  }
  return 0;
}

void UsbBus::submit_control(Urb urb) {
  const guint8* bytes = urb.buffer->data;
  const auto u16 = [bytes](int at) { return static_cast<std::uint16_t>(bytes[at] | bytes[at + 1] << 8); };
  const Setup setup{bytes[0], bytes[1], u16(2), u16(4), u16(6)};
  const bool in = (setup.type & 0x80) != 0;
  const std::span<const std::uint8_t> data(bytes + setup_bytes, in ? 0 : urb.length - setup_bytes);
  Answer answer = gadget_.control(setup, data);
  if (cut_) return complete(urb, -ESHUTDOWN);
  if (answer.reply == Reply::none) {
    unanswered_.push_back(urb);
    return;
  }
  urb.ready_s = wall_s() + gadget_.delay_s();
  urb.done = in ? std::min(answer.data.size(), urb.length - setup_bytes) : data.size();
  if (in && urb.done > 0) {
    umockdev_ioctl_data_update(urb.buffer, setup_bytes, answer.data.data(), static_cast<gint>(urb.done));
  }
  complete(urb, answer.reply == Reply::stall ? -EPIPE : 0);
}

int UsbBus::discard(UMockdevIoctlClient* client) {
  gulong address = 0;
  std::memcpy(&address, umockdev_ioctl_client_get_arg(client)->data, sizeof address);
  const auto mine = [&](const Urb& urb) { return urb.client == client && urb.address == address; };
  for (auto* queue : {&bulk_, &unanswered_}) {
    const auto found = std::find_if(queue->begin(), queue->end(), mine);
    if (found == queue->end()) continue;
    const Urb urb = *found;
    queue->erase(found);
    complete(urb, -ENOENT);
    return 0;
  }
  const auto late = std::find_if(done_.begin(), done_.end(), mine);
  if (late == done_.end() || late->ready_s <= wall_s()) return EINVAL;  // it is finished
  late->status = -ENOENT;
  late->ready_s = 0.0;
  return 0;
}

bool UsbBus::reap(UMockdevIoctlClient* client, std::unique_lock<std::mutex>& lock) {
  const auto first = [this, client] {
    return std::find_if(done_.begin(), done_.end(),
                        [client](const Urb& urb) { return urb.client == client && urb.ready_s <= wall_s(); });
  };
  if (client == claimed_by_ && first() == done_.end()) ++looks_;
  if (first() == done_.end()) reapable_.wait_for(lock, reap_wait, [&] { return first() != done_.end(); });
  const auto found = first();
  if (found == done_.end()) return false;
  Urb urb = *found;
  done_.erase(found);
  gint status = urb.status;
  gint length = static_cast<gint>(urb.done);
  umockdev_ioctl_data_update(urb.urb, offsetof(usbdevfs_urb, status), reinterpret_cast<guint8*>(&status),
                             sizeof status);
  umockdev_ioctl_data_update(urb.urb, offsetof(usbdevfs_urb, actual_length), reinterpret_cast<guint8*>(&length),
                             sizeof length);
  UMockdevIoctlData* where =
      umockdev_ioctl_data_resolve(umockdev_ioctl_client_get_arg(client), 0, sizeof(void*), nullptr);
  umockdev_ioctl_data_set_ptr(where, 0, urb.urb);
  g_object_unref(where);
  forget(urb);
  return true;
}

}  // namespace focalstage::mcc1208_emulator
