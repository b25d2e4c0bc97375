#include "devices/plugin/plugin_words.h"

#include <algorithm>
#include <span>

namespace focalstage {

namespace {

/// A plugin may forget the zero at the end.
std::string text_of(std::span<const char> text) { return {text.begin(), std::find(text.begin(), text.end(), '\0')}; }

}  // namespace

Fault plugin_fault(std::int32_t code, const PluginWords& words, const std::string& where, const char* unable) {
  const std::string said = text_of(words);
  const auto fault = [&](const char* name, const char* otherwise, const char* remedy) {
    return Fault{name, where, said.empty() ? otherwise : said, remedy};
  };
  switch (code) {
    case FOCALSTAGE_ABSENT:
      return fault("plugin.absent", "there is no such device", "plug it in and switch it on");
    case FOCALSTAGE_LOST:
      return fault("plugin.lost", "it does not answer any more", "see that it is plugged in and switched on");
    case FOCALSTAGE_UNABLE:
      return fault(unable, "it cannot do this", "");
    case FOCALSTAGE_SETTINGS:
      return fault("plugin.settings", "a setting of this plugin is wrong", "see the plugin's documentation");
    case FOCALSTAGE_DARK:
      return fault("plugin.dark", "it went dark by itself", "");
    default:
      return fault("plugin.fault", "it failed without a word", "see the plugin's documentation");
  }
}

DeviceId plugin_id(const focalstage_identity& identity) {
  return {"plugin", text_of(identity.model), text_of(identity.serial), text_of(identity.address)};
}

}  // namespace focalstage
