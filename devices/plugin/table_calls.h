#pragma once

#include <memory>
#include <string>
#include <vector>

#include "devices/plugin/plugin_seat.h"
#include "devices/plugin/plugin_words.h"
#include "devices/plugin/settings.h"

namespace focalstage {

/// The calls that the tables of projectors and of lens drives have in common but for the types in them. A `Kind` names
/// those: Table, Device, Abilities, Counts.
template <class Kind>
class TableCalls {
 public:
  using Table = typename Kind::Table;
  using Device = typename Kind::Device;
  using Abilities = typename Kind::Abilities;
  using Counts = typename Kind::Counts;

  static Device* device_of(void* device) { return static_cast<Device*>(device); }

  /// Opens a device and asks what it can do; "plugin.abilities" where that is not `believable`, as `of_what` says.
  template <class Believable>
  static Result<Device*> open(const Table& table, const PluginSettings& settings, Abilities& abilities,
                              const char* of_what, Believable believable) {
    const std::string library = settings.library.string();
    std::vector<focalstage_setting> options;
    for (const auto& [key, value] : settings.options) options.push_back({key.c_str(), value.c_str()});
    Device* device = nullptr;
    PluginWords words{};
    const auto count = static_cast<std::uint32_t>(options.size());
    const std::int32_t code = table.open(options.data(), count, &device, words.data());
    if (code != FOCALSTAGE_OK) return plugin_fault(code, words, library, "plugin.unable");
    if (device == nullptr) return Fault{"plugin.fault", library, "it opened nothing and said that all is well", ""};
    focalstage_identity identity{};
    table.describe(device, &identity, &abilities);
    if (believable(abilities)) return device;
    table.close(device);
    return Fault{"plugin.abilities", library, std::string("what it says of its ") + of_what + " cannot be",
                 "this plugin is broken"};
  }

  /// How it stands, in `counts` too.
  static PluginWord status(const Table& table, void* device, Counts& counts) {
    PluginWord word;
    word.code = table.status(device_of(device), &counts, word.words.data());
    word.told_ns = counts.told_ns;
    word.temperature_c = counts.temperature_c;
    return word;
  }

  /// `describe`, `identify` and `close` by the table that is on the desk by then.
  template <class Desk>
  static PluginCalls of(const std::shared_ptr<Desk>& desk) {
    PluginCalls calls;
    calls.describe = [desk](void* device) {
      focalstage_identity identity{};
      Abilities abilities{};
      desk->table->describe(device_of(device), &identity, &abilities);
      return plugin_id(identity);
    };
    calls.identify = [desk](void* device, char* error) { return desk->table->identify(device_of(device), error); };
    calls.close = [desk](void* device) { desk->table->close(device_of(device)); };
    return calls;
  }
};

}  // namespace focalstage
