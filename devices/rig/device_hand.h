#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

#include "devices/roles/device.h"
#include "devices/roles/rig.h"

namespace focalstage {

/// Keeps one device open, however often it is unplugged, and makes it dark when asked to, in a thread of its own: no
/// device waits for another (hardware that is slow to answer must not keep the rest lit).
class DeviceHand {
 public:
  /// `dark` makes the device safe and is true if it could be told.
  DeviceHand(std::string name, std::shared_ptr<Device> device, std::function<bool()> dark);
  ~DeviceHand();  ///< dark first, and closed

  const std::string& name() const { return name_; }
  RigPart part() const { return {device_->id(), device_->state()}; }

  /// Returns at once. A device that is just being opened becomes safe by that.
  void darken();

  /// No fault while it answers and did not go dark by itself.
  Status fit() const;

  /// Nothing that was asked of it is still to be done.
  bool settled();

 private:
  void run(const std::stop_token& stop);

  std::string name_;
  std::shared_ptr<Device> device_;
  std::function<bool()> dark_;
  std::mutex mutex_;
  std::condition_variable_any asked_;
  std::uint64_t to_darken_ = 0;  ///< asked for
  std::uint64_t darkened_ = 0;   ///< done, of those
  std::jthread thread_;
};

}  // namespace focalstage
