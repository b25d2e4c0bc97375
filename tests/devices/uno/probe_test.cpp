#include "devices/uno/probe.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

using namespace focalstage;

namespace {

namespace fs = std::filesystem;

/// A sysfs of the test's own.
struct Sysfs {
  Sysfs() : root(fs::temp_directory_path() / ("focalstage-unos-" + std::to_string(::getpid()))) {
    settings.search.sysfs = root.string();
    fs::create_directories(root / "class/tty");
  }
  ~Sysfs() { fs::remove_all(root); }
  Sysfs(const Sysfs&) = delete;
  Sysfs& operator=(const Sysfs&) = delete;

  void plug(const std::string& tty, const std::string& vendor, const std::string& product,
            const std::string& serial) const {
    const fs::path device = root / "devices" / tty;
    fs::create_directories(device / "1:1.0");
    fs::create_directories(root / "class/tty" / tty);
    fs::create_directory_symlink(device / "1:1.0", root / "class/tty" / tty / "device");
    std::ofstream(device / "idVendor") << vendor << '\n';
    std::ofstream(device / "idProduct") << product << '\n';
    std::ofstream(device / "serial") << serial << '\n';
  }

  fs::path root;
  UnoSettings settings;
};

}  // namespace

TEST_CASE("Unos are told from other serial ports, and by their serials") {
  Sysfs sysfs;
  CHECK(probe_uno(sysfs.settings).empty());
  CHECK(find_uno(sysfs.settings).fault().code == "uno.absent");
  sysfs.plug("ttyACM0", "03eb", "2018", "lens");
  sysfs.plug("ttyACM1", "2341", "0043", "A");
  const auto one = probe_uno(sysfs.settings);
  REQUIRE(one.size() == 1);
  CHECK(one[0] == DeviceId{"uno", "Arduino Uno", "A", "/dev/ttyACM1"});
  CHECK(find_uno(sysfs.settings).value() == one[0]);
  sysfs.plug("ttyACM7", "2a03", "0043", "B");
  const auto several = find_uno(sysfs.settings);
  REQUIRE_FALSE(several.ok());
  CHECK(several.fault().code == "uno.several");
  CHECK(several.fault().message.find("/dev/ttyACM7 (B)") != std::string::npos);
  sysfs.settings.serial = "B";
  CHECK(find_uno(sysfs.settings).value().address == "/dev/ttyACM7");
  sysfs.settings.serial = "C";
  const auto other = find_uno(sysfs.settings);
  REQUIRE_FALSE(other.ok());
  CHECK(other.fault().code == "uno.absent");
  CHECK(other.fault().where.find('C') != std::string::npos);
}

TEST_CASE("other USB chips and given paths are the settings' own") {
  Sysfs sysfs;
  sysfs.plug("ttyUSB0", "1a86", "7523", "");
  CHECK(probe_uno(sysfs.settings).empty());
  sysfs.settings.kinds.push_back({0x1a86, 0x7523});
  CHECK(probe_uno(sysfs.settings).size() == 1);
  sysfs.settings.search.paths = {"/dev/null"};
  CHECK(probe_uno(sysfs.settings).size() == 2);
  sysfs.settings.path = "/dev/null";
  CHECK(probe_uno(sysfs.settings).size() == 2);
  CHECK(find_uno(sysfs.settings).value().address == "/dev/null");
  sysfs.settings.path = "/nowhere/ttyACM0";
  CHECK(find_uno(sysfs.settings).fault().code == "uno.absent");
}
