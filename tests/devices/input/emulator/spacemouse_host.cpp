#include "tests/devices/input/emulator/spacemouse_host.h"

#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <umockdev.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <mutex>
#include <optional>
#include <thread>

namespace focalstage::spacemouse_emulator {

namespace {

using Bytes = std::vector<std::uint8_t>;

// A multi-axis controller of the generic desktop: reports 1 and 2 of three axes, 3 of buttons, 4 of the lamp.
const std::string report_descriptor =
    "05010908A101A100850116A2FE265E010930093109327510950381"
    "06C0"
    "A1008502093309340935751095038106C0"
    "A10285030509190129021500250175019502810295"
    "0E8103C0"
    "A10285040508094B15002501950175019102950175079103C0C0";

std::string hex4(unsigned value) {
  char text[8];
  std::snprintf(text, sizeof text, "%04x", value);
  return text;
}

void append(Bytes& bytes, int counts) {
  const auto word = static_cast<std::uint16_t>(static_cast<std::int16_t>(counts));
  bytes.push_back(static_cast<std::uint8_t>(word & 0xffU));
  bytes.push_back(static_cast<std::uint8_t>(word >> 8U));
}

class Host final : public SpaceMouseHost {
 public:
  Host(UMockdevTestbed* bed, SpaceMouseKind kind, int first_node)
      : bed_(bed), kind_(std::move(kind)), number_(first_node - 1) {
    plug();
  }
  ~Host() override {
    unplug();
    for (const int terminal : kept_) ::close(terminal);
  }

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
    if (descriptor_ < 0) return;
    umockdev_testbed_uevent(bed_, ("/sys" + hid() + "/hidraw/" + name()).c_str(), "remove");
    umockdev_testbed_remove_device(bed_, ("/sys" + usb()).c_str());
    // The test bed remembers the terminal by its name: it must not become another device's.
    char terminal[64] = {};
    if (::ptsname_r(descriptor_, terminal, sizeof terminal) == 0) {
      kept_.push_back(::open(terminal, O_RDWR | O_NOCTTY | O_CLOEXEC));
    }
    // The test bed owns the descriptor and closes it at its end: what hangs up is another one put in its place.
    const int nothing = ::open("/dev/null", O_RDWR | O_CLOEXEC);
    ::dup2(nothing, descriptor_);
    ::close(nothing);
    descriptor_ = -1;
  }

  void hold(const Hand& hand) override {
    const std::lock_guard lock(mutex_);
    hand_ = hand;
  }

  void let_go(bool last_report) override {
    const std::lock_guard lock(mutex_);
    hand_.reset();
    if (last_report) report_axes(Hand{});
  }

  void press(std::uint32_t buttons) override {
    const std::lock_guard lock(mutex_);
    to_send_.push_back({3, static_cast<std::uint8_t>(buttons), static_cast<std::uint8_t>(buttons >> 8U)});
  }

  void send(std::span<const std::uint8_t> report) override {
    const std::lock_guard lock(mutex_);
    to_send_.emplace_back(report.begin(), report.end());
  }

  std::vector<bool> lamp() const override {
    const std::lock_guard lock(mutex_);
    return lamp_;
  }

 private:
  std::string name() const { return "hidraw" + std::to_string(number_); }
  /// A port of its own for each plugging in: the test bed keeps links to those that are gone.
  std::string port() const { return "1-" + std::to_string(20 + number_); }
  std::string usb() const { return "/devices/pci0000:00/0000:00:14.0/usb1/" + port(); }
  std::string hid() const {
    return usb() + "/" + port() + ":1.0/0003:" + hex4(kind_.vendor) + ":" + hex4(kind_.product) + ".00" +
           std::to_string(20 + number_);
  }

  void add_devices() {
    const std::string minor = std::to_string(number_);
    const std::string text =
        "P: " + usb() + "\nE: DEVTYPE=usb_device\nE: SUBSYSTEM=usb\nA: idVendor=" + hex4(kind_.vendor) +
        "\\n\nA: idProduct=" + hex4(kind_.product) + "\\n\nA: manufacturer=3Dconnexion\\n\nA: product=SpaceMouse\\n\n" +
        "A: serial=" + kind_.serial + "\\n\nA: busnum=1\\n\nA: devnum=5\\n\nA: bcdDevice=0100\\n\n\n" +  //
        "P: " + usb() + "/" + port() +
        ":1.0\nE: DEVTYPE=usb_interface\nE: SUBSYSTEM=usb\nA: bInterfaceNumber=00\\n\n\n" + "P: " + hid() +
        "\nE: SUBSYSTEM=hid\nE: HID_ID=0003:0000" + hex4(kind_.vendor) + ":0000" + hex4(kind_.product) +
        "\nE: HID_NAME=3Dconnexion SpaceMouse\nE: HID_UNIQ=" + kind_.serial +
        "\nH: report_descriptor=" + report_descriptor + "\n\n" +  //
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
    char size[16];
    const auto bytes = static_cast<unsigned>(report_descriptor.size() / 2);
    std::snprintf(size, sizeof size, "%02X%02X0000", bytes & 0xffU, bytes >> 8U);
    std::string hex = report_descriptor;
    hex.resize(2 * 4096, '0');
    std::ofstream(path) << "@DEV " << node() << "\nHIDIOCGRDESCSIZE 0 " << size << "\nHIDIOCGRDESC 0 " << size << hex
                        << "\n";
    GError* error = nullptr;
    if (umockdev_testbed_load_ioctl(bed_, node().c_str(), path.c_str(), &error) == FALSE) report(error);
  }

  static void report(GError* error) {
    std::fprintf(stderr, "umockdev: %s\n", error != nullptr ? error->message : "refused");
    if (error != nullptr) g_error_free(error);
  }

  void report_axes(const Hand& hand) {
    Bytes push{1};
    Bytes turn{2};
    for (int i = 0; i < 3; ++i) append(push, hand.counts[i]);
    for (int i = 3; i < 6; ++i) append(kind_.combined ? push : turn, hand.counts[i]);
    to_send_.push_back(push);
    if (!kind_.combined) to_send_.push_back(turn);
  }

  /// One report in 8 ms: what stands in for the line is a stream, and two reports at once would be read as one.
  void serve(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      Bytes next;
      {
        const std::lock_guard lock(mutex_);
        if (to_send_.empty() && hand_) report_axes(*hand_);
        if (!to_send_.empty()) {
          next = to_send_.front();
          to_send_.erase(to_send_.begin());
        }
      }
      if (!next.empty()) (void)!::write(descriptor_, next.data(), next.size());
      take_lamp();
      std::this_thread::sleep_for(std::chrono::milliseconds(8));
    }
  }

  void take_lamp() {
    pollfd polled{descriptor_, POLLIN, 0};
    if (::poll(&polled, 1, 0) <= 0 || (polled.revents & POLLIN) == 0) return;
    std::array<std::uint8_t, 64> buffer{};
    const ssize_t got = ::read(descriptor_, buffer.data(), buffer.size());
    const std::lock_guard lock(mutex_);
    for (ssize_t i = 0; i + 1 < got; i += 2) {
      const auto at = static_cast<std::size_t>(i);
      if (buffer[at] == 4) lamp_.push_back(buffer[at + 1] == 1);
    }
  }

  UMockdevTestbed* bed_;
  SpaceMouseKind kind_;
  int number_;
  int descriptor_ = -1;
  std::vector<int> kept_;
  mutable std::mutex mutex_;
  std::optional<Hand> hand_;
  std::vector<Bytes> to_send_;
  std::vector<bool> lamp_;
  std::jthread thread_;
};

}  // namespace

std::unique_ptr<SpaceMouseHost> SpaceMouseHost::start(UMockdevTestbed* bed, const SpaceMouseKind& kind,
                                                      int first_node) {
  return std::make_unique<Host>(bed, kind, first_node);
}

}  // namespace focalstage::spacemouse_emulator
