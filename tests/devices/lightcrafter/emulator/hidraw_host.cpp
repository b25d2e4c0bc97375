#include "tests/devices/lightcrafter/emulator/hidraw_host.h"

#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <umockdev.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <thread>

namespace focalstage::lightcrafter_emulator {

namespace {

const std::string report_descriptor =
    "06 00FF 0901 A101 0901 1500 26FF00 7508 9540 8102 0901 1500 26FF00 7508 9540 9102 C0";

std::string plain_descriptor() {
  std::string hex;
  for (const char letter : report_descriptor) {
    if (letter != ' ') hex += letter;
  }
  return hex;
}

class Host final : public HidrawHost {
 public:
  Host(UMockdevTestbed* bed, Board& board, std::string serial, int first_node)
      : bed_(bed), board_(board), serial_(std::move(serial)), number_(first_node - 1) {
    plug();
  }

  ~Host() override { unplug(); }

  std::string node() const override { return "/dev/" + name(); }

  void plug() override {
    unplug();
    ++number_;
    add_devices();
    descriptor_ = umockdev_testbed_get_dev_fd(bed_, node().c_str());
    if (descriptor_ < 0) {
      std::fprintf(stderr, "no node for %s: does this run under umockdev-wrapper?\n", node().c_str());
      return;
    }
    termios line{};
    tcgetattr(descriptor_, &line);
    cfmakeraw(&line);
    tcsetattr(descriptor_, TCSANOW, &line);
    thread_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
  }

  void unplug() override {
    thread_ = {};
    leave();
  }

 private:
  std::string name() const { return "hidraw" + std::to_string(number_); }
  /// A port of its own for each plugging in: the test bed keeps links to those that are gone.
  std::string port() const { return "1-" + std::to_string(20 + number_); }
  std::string usb() const { return "/devices/pci0000:00/0000:00:14.0/usb1/" + port(); }
  std::string hid() const { return usb() + "/" + port() + ":1.0/0003:0451:6401.00" + std::to_string(20 + number_); }

  void add_devices() {
    const std::string minor = std::to_string(number_);
    const std::string text = "P: " + usb() +
                             "\nE: DEVTYPE=usb_device\nE: SUBSYSTEM=usb\nA: idVendor=0451\\n\nA: idProduct=6401\\n\n" +
                             "A: manufacturer=Texas Instruments\\n\nA: product=DLPC350\\n\nA: serial=" + serial_ +
                             "\\n\nA: busnum=1\\n\nA: devnum=5\\n\nA: bcdDevice=0100\\n\n\n" +  //
                             "P: " + usb() + "/" + port() +
                             ":1.0\nE: DEVTYPE=usb_interface\nE: SUBSYSTEM=usb\nA: bInterfaceNumber=00\\n\n\n" +
                             "P: " + hid() + "\nE: SUBSYSTEM=hid\nE: HID_ID=0003:00000451:00006401\n" +
                             "E: HID_NAME=Texas Instruments DLPC350\nE: HID_UNIQ=" + serial_ +
                             "\nH: report_descriptor=" + plain_descriptor() + "\n\n" +  //
                             "P: " + hid() + "/hidraw/" + name() + "\nN: " + name() + "\nE: DEVNAME=" + node() +
                             "\nE: SUBSYSTEM=hidraw\nE: MAJOR=240\nE: MINOR=" + minor + "\nA: dev=240:" + minor +
                             "\\n\nL: device=../../../" + hid().substr(hid().rfind('/') + 1) + "\n\n";
    GError* error = nullptr;
    if (umockdev_testbed_add_from_string(bed_, text.c_str(), &error) == FALSE) report(error);
    load_ioctls();
  }

  /// hidapi asks for the size and the bytes of the report descriptor.
  void load_ioctls() {
    gchar* root = umockdev_testbed_get_root_dir(bed_);
    const std::string path = std::string(root) + "/" + name() + ".ioctl";
    g_free(root);
    std::string hex = plain_descriptor();
    hex.resize(2 * 4096, '0');
    std::ofstream(path) << "@DEV " << node() << "\nHIDIOCGRDESCSIZE 0 22000000\nHIDIOCGRDESC 0 22000000" << hex << "\n";
    GError* error = nullptr;
    if (umockdev_testbed_load_ioctl(bed_, node().c_str(), path.c_str(), &error) == FALSE) report(error);
  }

  static void report(GError* error) {
    std::fprintf(stderr, "umockdev: %s\n", error != nullptr ? error->message : "refused");
    if (error != nullptr) g_error_free(error);
  }

  void serve(const std::stop_token& stop) {
    Bytes bytes;
    while (!stop.stop_requested()) {
      pollfd polled{descriptor_, POLLIN, 0};
      if (::poll(&polled, 1, 5) <= 0) continue;
      if ((polled.revents & POLLIN) == 0) {  // nobody has it open
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        continue;
      }
      std::array<std::uint8_t, 650> buffer{};
      const ssize_t got = ::read(descriptor_, buffer.data(), buffer.size());
      if (got > 0) bytes.insert(bytes.end(), buffer.begin(), buffer.begin() + got);
      while (bytes.size() >= 65) {  // a report number that is none comes first
        const Answers answers = board_.take(std::span(bytes).subspan(1, 64));
        bytes.erase(bytes.begin(), bytes.begin() + 65);
        if (answers.gone) {
          leave();
          return;
        }
        if (answers.delay_s > 0.0) std::this_thread::sleep_for(std::chrono::duration<double>(answers.delay_s));
        for (const Bytes& report : answers.reports) (void)!::write(descriptor_, report.data(), report.size());
      }
    }
  }

  void leave() {
    const std::lock_guard lock(leaving_);
    if (descriptor_ < 0) return;
    for (const std::string& path : {hid() + "/hidraw/" + name(), hid(), usb() + "/" + port() + ":1.0", usb()}) {
      umockdev_testbed_remove_device(bed_, ("/sys" + path).c_str());
    }
    // The test bed remembers which terminal stood for the node, and stumbles when its number comes again.
    std::string terminal = ::ptsname(descriptor_);
    std::ranges::replace(terminal, '/', '_');
    gchar* root = umockdev_testbed_get_root_dir(bed_);
    ::unlink((std::string(root) + "/dev/.ptymap/" + terminal).c_str());
    g_free(root);
    // The test bed owns the descriptor and closes it at its end: what hangs up is another one put in its place.
    const int nothing = ::open("/dev/null", O_RDWR | O_CLOEXEC);
    ::dup2(nothing, descriptor_);
    ::close(nothing);
    descriptor_ = -1;
  }

  UMockdevTestbed* bed_;
  Board& board_;
  std::string serial_;
  int number_;
  int descriptor_ = -1;
  std::mutex leaving_;
  std::jthread thread_;
};

}  // namespace

std::unique_ptr<HidrawHost> HidrawHost::start(UMockdevTestbed* bed, Board& board, const std::string& serial,
                                              int first_node) {
  return std::make_unique<Host>(bed, board, serial, first_node);
}

}  // namespace focalstage::lightcrafter_emulator
