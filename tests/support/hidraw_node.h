#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

using UMockdevTestbed = struct _UMockdevTestbed;

namespace focalstage::support {

/// Whom a device on USB says that it is, and what its reports look like.
struct HidIdentity {
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  std::string maker;
  std::string name;
  std::string serial;
  std::string report_descriptor;  ///< in hexadecimal digits
};

/// A device of reports on umockdev's USB, as /dev/hidrawN: the place, not what answers there. The process must run
/// under `umockdev-wrapper`; other devices may share the test bed.
class HidrawNode {
 public:
  /// What answers: called in a thread of its own with the device's end of the line, plain bytes, each time it is
  /// plugged in.
  using Serve = std::function<void(int descriptor, const std::stop_token& stop)>;

  /// Plugged in. `bed` must live longer.
  HidrawNode(UMockdevTestbed* bed, HidIdentity identity, int first_node, Serve serve);
  HidrawNode(const HidrawNode&) = delete;
  HidrawNode& operator=(const HidrawNode&) = delete;
  ~HidrawNode() { unplug(); }

  /// On another node than before. Where there is no test bed, stderr says so.
  void plug();
  /// When what answers is through, takes its name from the bus and the descriptor with it: who holds it open reads an
  /// error.
  void unplug();
  /// The same from within `Serve`, which should return then.
  void leave();

  std::string path() const { return "/dev/" + name(); }

 private:
  std::string name() const { return "hidraw" + std::to_string(number_); }
  std::string port() const;
  std::string usb() const;
  std::string hid() const;
  void add_devices();
  void load_ioctls();

  UMockdevTestbed* bed_;
  HidIdentity identity_;
  int number_;
  Serve serve_;
  int descriptor_ = -1;
  std::mutex leaving_;
  std::jthread thread_;
};

}  // namespace focalstage::support
