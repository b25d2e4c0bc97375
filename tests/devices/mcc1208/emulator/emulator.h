#pragma once

#include <functional>
#include <memory>
#include <string>

#include "tests/devices/mcc1208/emulator/device.h"

typedef struct _UMockdevTestbed UMockdevTestbed;  // NOLINT: its own name

namespace focalstage::mcc1208_emulator {

/// Where it is plugged in.
struct Place {
  int bus = 1;
  int port = 2;
};

/// An emulated USB-1208FS-Plus as programs of this process and its children see it, through umockdev's usbfs: they must
/// run under umockdev-wrapper. Its time is driven from outside.
class Emulator {
 public:
  /// Not plugged in yet. `testbed`: that of other emulators of this process, of which there can be only one; null makes
  /// one. Null where this process does not run under umockdev-wrapper.
  static std::unique_ptr<Emulator> create(const Options& options = {}, UMockdevTestbed* testbed = nullptr,
                                          const Place& place = {});
  virtual ~Emulator() = default;

  /// At power-on levels and with another device number each time.
  virtual void plug_in() = 0;
  virtual void unplug() = 0;
  virtual void misbehave(const Misbehaviour& how) = 0;

  /// Plays all scans that are due by then, in order, and tells of each output through `on_output`, without any lock and
  /// in the calling thread. Wall time only paces: whoever calls lets the host have the time to queue what is played.
  virtual void advance_to(double device_time_s) = 0;
  virtual void on_output(std::function<void(const Output&)> heard) = 0;

  /// How often the program that has claimed it asked for finished transfers; none: nobody has. A host that is alive
  /// asks about each millisecond, so whoever paces can see whether it had the processor at all.
  virtual std::optional<std::uint64_t> host_looks() const = 0;

  virtual double time_s() const = 0;
  virtual bool plugged_in() const = 0;
  virtual std::array<int, 2> codes() const = 0;
  virtual std::optional<std::uint8_t> pins(int port) const = 0;
  virtual std::vector<Request> requests() const = 0;
  virtual std::uint64_t bulk_bytes() const = 0;  ///< taken since it was plugged in
};

}  // namespace focalstage::mcc1208_emulator
