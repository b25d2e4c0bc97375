#include "tests/support/hidraw_node.h"

#include <fcntl.h>
#include <termios.h>
#include <umockdev.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <utility>

namespace focalstage::support {

namespace {

std::string hex4(unsigned value) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "%04x", value);
  return text.data();
}

void report(GError* error) {
  std::fprintf(stderr, "umockdev: %s\n", error != nullptr ? error->message : "refused");
  if (error != nullptr) g_error_free(error);
}

std::string root_of(UMockdevTestbed* bed) {
  gchar* root = umockdev_testbed_get_root_dir(bed);
  std::string path = root;
  g_free(root);
  return path;
}

}  // namespace

HidrawNode::HidrawNode(UMockdevTestbed* bed, HidIdentity identity, int first_node, Serve serve)
    : bed_(bed), identity_(std::move(identity)), number_(first_node - 1), serve_(std::move(serve)) {
  plug();
}

/// One of its own for each plugging in: the test bed keeps links to those that are gone.
std::string HidrawNode::port() const { return "1-" + std::to_string(20 + number_); }

std::string HidrawNode::usb() const { return "/devices/pci0000:00/0000:00:14.0/usb1/" + port(); }

std::string HidrawNode::hid() const {
  return usb() + "/" + port() + ":1.0/0003:" + hex4(identity_.vendor) + ":" + hex4(identity_.product) + ".00" +
         std::to_string(20 + number_);
}

void HidrawNode::plug() {
  unplug();
  ++number_;
  load_ioctls();  // first: an opener that comes between the node and what answers its requests is ended by the test bed
  add_devices();
  descriptor_ = umockdev_testbed_get_dev_fd(bed_, path().c_str());
  if (descriptor_ < 0) {
    std::fprintf(stderr, "no node for %s: does this run under umockdev-wrapper?\n", path().c_str());
    return;
  }
  termios line{};
  tcgetattr(descriptor_, &line);
  cfmakeraw(&line);
  tcsetattr(descriptor_, TCSANOW, &line);
  thread_ = std::jthread([this, line_end = descriptor_](const std::stop_token& stop) { serve_(line_end, stop); });
}

void HidrawNode::unplug() {
  thread_ = {};
  leave();
}

void HidrawNode::leave() {
  const std::lock_guard lock(leaving_);
  if (descriptor_ < 0) return;
  umockdev_testbed_uevent(bed_, ("/sys" + hid() + "/hidraw/" + name()).c_str(), "remove");
  for (const std::string& device : {hid() + "/hidraw/" + name(), hid(), usb() + "/" + port() + ":1.0", usb()}) {
    umockdev_testbed_remove_device(bed_, ("/sys" + device).c_str());
  }
  // The test bed remembers which terminal stood for the node, and stumbles when its number comes again.
  std::string terminal = ::ptsname(descriptor_);
  std::ranges::replace(terminal, '/', '_');
  ::unlink((root_of(bed_) + "/dev/.ptymap/" + terminal).c_str());
  // The test bed owns the descriptor and closes it at its end: what hangs up is another one put in its place.
  const int nothing = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  ::dup2(nothing, descriptor_);
  ::close(nothing);
  descriptor_ = -1;
}

void HidrawNode::add_devices() {
  const std::string minor = std::to_string(number_);
  const std::string vendor = hex4(identity_.vendor), product = hex4(identity_.product);
  const std::string text =
      "P: " + usb() + "\nE: DEVTYPE=usb_device\nE: SUBSYSTEM=usb\nA: idVendor=" + vendor +
      "\\n\nA: idProduct=" + product + "\\n\nA: manufacturer=" + identity_.maker + "\\n\nA: product=" + identity_.name +
      "\\n\nA: serial=" + identity_.serial + "\\n\nA: busnum=1\\n\nA: devnum=5\\n\nA: bcdDevice=0100\\n\n\n" +  //
      "P: " + usb() + "/" + port() +
      ":1.0\nE: DEVTYPE=usb_interface\nE: SUBSYSTEM=usb\nA: bInterfaceNumber=00\\n\n\n" +  //
      "P: " + hid() + "\nE: SUBSYSTEM=hid\nE: HID_ID=0003:0000" + vendor + ":0000" + product +
      "\nE: HID_NAME=" + identity_.maker + " " + identity_.name + "\nE: HID_UNIQ=" + identity_.serial +
      "\nH: report_descriptor=" + identity_.report_descriptor + "\n\n" +  //
      "P: " + hid() + "/hidraw/" + name() + "\nN: " + name() + "\nE: DEVNAME=" + path() +
      "\nE: SUBSYSTEM=hidraw\nE: MAJOR=240\nE: MINOR=" + minor + "\nA: dev=240:" + minor + "\\n\nL: device=../../../" +
      hid().substr(hid().rfind('/') + 1) + "\n\n";
  GError* error = nullptr;
  if (umockdev_testbed_add_from_string(bed_, text.c_str(), &error) == FALSE) report(error);
}

/// hidapi asks for the size and the bytes of the report descriptor.
void HidrawNode::load_ioctls() {
  const std::string file = root_of(bed_) + "/" + name() + ".ioctl";
  std::string hex = identity_.report_descriptor;
  const auto bytes = static_cast<unsigned>(hex.size() / 2);
  std::array<char, 16> size{};
  std::snprintf(size.data(), size.size(), "%02X%02X0000", bytes & 0xffU, bytes >> 8U);
  hex.resize(std::size_t{2} * 4096, '0');
  std::ofstream(file) << "@DEV " << path() << "\nHIDIOCGRDESCSIZE 0 " << size.data() << "\nHIDIOCGRDESC 0 "
                      << size.data() << hex << "\n";
  GError* error = nullptr;
  if (umockdev_testbed_load_ioctl(bed_, path().c_str(), file.c_str(), &error) == FALSE) report(error);
}

}  // namespace focalstage::support
