#pragma once

#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "core/base/result.h"
#include "io/rig_config/rig_config.h"

namespace focalstage {

/// Takes a driver's settings out of the file's. What the file does not say stays as it is; what is of another kind, out
/// of bounds or unknown is the fault of `done`: "rig.config", with its JSON pointer.
class SettingsReader {
 public:
  /// `place`: the device's JSON pointer, "/devices/lens_drive". `folder`: of its driver, where that is not its name.
  SettingsReader(const DeviceConfig& device, std::string place, std::string folder = {})
      : device_(device), place_(std::move(place)), folder_(folder.empty() ? device.driver : std::move(folder)) {}

  void take(const std::string& key, std::string& value);
  void take(const std::string& key, bool& value);
  void take(const std::string& key, double& value, double least, double most);
  void take(const std::string& key, int& value, int least, int most);
  void take(const std::string& key, std::optional<int>& value, int least, int most);

  /// One of these words.
  template <class T>
  void choose(const std::string& key, T& value, std::initializer_list<std::pair<const char*, T>> words) {
    if (find(key) == nullptr) return;
    std::string word;
    take(key, word);
    std::string known;
    for (const auto& [name, meaning] : words) {
      known += (known.empty() ? "" : " or ") + std::string(name);
      if (word == name) {
        value = meaning;
        return;
      }
    }
    refuse(key, "this is to be " + known);
  }

  /// All that is left is for somebody else to take, as texts.
  template <class Take>
  void rest(const Take& take) {
    for (const auto& [key, value] : device_.settings) {
      if (known_.insert(key).second) take(key, text_of(value));
    }
  }

  Status done();

 private:
  const Value* find(const std::string& key);
  void refuse(const std::string& key, const std::string& message);
  static std::string text_of(const Value& value);

  const DeviceConfig& device_;
  std::string place_;
  std::string folder_;
  std::set<std::string> known_;
  std::optional<Fault> fault_;
};

}  // namespace focalstage
