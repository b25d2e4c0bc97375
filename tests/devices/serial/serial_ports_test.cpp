#include "devices/serial/serial_ports.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

using namespace focalstage;

namespace {

namespace fs = std::filesystem;

/// A sysfs of the test's own, as Linux lays it out.
struct Sysfs {
  Sysfs() : root(fs::temp_directory_path() / ("focalstage-sysfs-" + std::to_string(::getpid()))) {
    fs::create_directories(root / "class/tty");
  }
  ~Sysfs() { fs::remove_all(root); }
  Sysfs(const Sysfs&) = delete;
  Sysfs& operator=(const Sysfs&) = delete;

  static void put(const fs::path& file, const std::string& line) { std::ofstream(file) << line << '\n'; }

  /// `inner`: what stands between the USB device and the tty's own folder.
  void plug(const std::string& tty, const std::string& usb, const std::string& inner, const std::string& vendor,
            const std::string& product, const std::string& serial) const {
    const fs::path device = root / "devices/pci0000:00/usb1" / usb;
    const fs::path own = device / inner / "tty" / tty;
    fs::create_directories(own);
    fs::create_directory_symlink(device / inner, own / "device");
    fs::create_directory_symlink(own, root / "class/tty" / tty);
    put(device / "idVendor", vendor);
    put(device / "idProduct", product);
    put(device / "product", "A thing");
    if (!serial.empty()) put(device / "serial", serial);
  }

  fs::path root;
};

}  // namespace

TEST_CASE("ports are listed by number with what USB tells of them, and others are not") {
  const Sysfs sysfs;
  sysfs.plug("ttyUSB0", "1-9", "1-9:1.0/ttyUSB0", "1A86", "7523", "");
  sysfs.plug("ttyACM10", "1-3", "1-3:1.0", "2341", "0043", "75834");
  sysfs.plug("ttyACM2", "1-2", "1-2:1.0", "03eb", "2018", "0001");
  fs::create_directories(sysfs.root / "class/tty/ttyS0");
  fs::create_directories(sysfs.root / "class/tty/ttyACM3");
  const auto ports = serial_ports({sysfs.root.string(), "/dev", {}});
  REQUIRE(ports.size() == 4);
  CHECK(ports[0] == SerialPortId{"/dev/ttyACM2", 0x03eb, 0x2018, "0001", "A thing"});
  CHECK(ports[1] == SerialPortId{"/dev/ttyACM3", 0, 0, "", ""});
  CHECK(ports[2] == SerialPortId{"/dev/ttyUSB0", 0x1a86, 0x7523, "", "A thing"});
  CHECK(ports[3] == SerialPortId{"/dev/ttyACM10", 0x2341, 0x0043, "75834", "A thing"});
}

TEST_CASE("paths that are given come last, once, and only if they are there") {
  const Sysfs sysfs;
  sysfs.plug("ttyACM0", "1-2", "1-2:1.0", "2341", "0043", "75834");
  const auto ports = serial_ports({sysfs.root.string(), "/dev", {"/dev/ttyACM0", "/dev/null", "/nowhere/pts/3"}});
  REQUIRE(ports.size() == 2);
  CHECK(ports[0].serial == "75834");
  CHECK(ports[1] == SerialPortId{"/dev/null", 0, 0, "", ""});
}

TEST_CASE("a system without a sysfs has no ports, and damaged numbers are none") {
  CHECK(serial_ports({"/nowhere", "/dev", {}}).empty());
  const Sysfs sysfs;
  sysfs.plug("ttyACM0", "1-2", "1-2:1.0", "xyz", "123456", "");
  const auto ports = serial_ports({sysfs.root.string(), "/dev", {}});
  REQUIRE(ports.size() == 1);
  CHECK(ports[0].vendor == 0);
  CHECK(ports[0].product == 0);
}
