#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace focalstage {

/// Which plugin, and what it is told.
struct PluginSettings {
  std::filesystem::path library;               ///< absolute: a plugin is a program that somebody chose
  std::map<std::string, std::string> options;  ///< handed to it as they are; its own documentation says which there are
  double poll_s = 0.001;                       ///< between two calls of its `status`
  double silent_s = 1.0;                       ///< without a word from the device for so long, it is lost
};

struct PluginProjectorSettings {
  PluginSettings plugin;
  /// Somebody has made sure that the light of this projector harms no eye (its risk group after IEC 62471, no laser or
  /// ultraviolet engine), and says so by this. Without it no plugin is as much as loaded.
  bool eye_safe = false;
};

struct PluginDriveSettings {
  PluginSettings plugin;
  double most_a = 0.25;  ///< either way; where the plugin states less, that
};

}  // namespace focalstage
