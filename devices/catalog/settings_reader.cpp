#include "devices/catalog/settings_reader.h"

#include <algorithm>
#include <cmath>

#include "core/base/number_words.h"

namespace focalstage {

const Value* SettingsReader::find(const std::string& key) {
  known_.insert(key);
  const auto member = std::ranges::find(device_.settings, key, &Value::Member::first);
  return member == device_.settings.end() ? nullptr : &member->second;
}

void SettingsReader::refuse(const std::string& key, const std::string& message) {
  if (fault_) return;
  fault_ = Fault{"rig.config", place_ + "/settings/" + key, message,
                 "see the README of devices/" + folder_ + " for its settings"};
}

std::string SettingsReader::text_of(const Value& value) {
  if (const std::string* text = value.text()) return *text;
  if (const double* number = value.number()) return short_text(*number, 17);
  if (const bool* flag = value.boolean()) return *flag ? "true" : "false";
  return "";
}

void SettingsReader::take(const std::string& key, std::string& value) {
  const Value* found = find(key);
  if (found == nullptr) return;
  if (const std::string* text = found->text()) {
    value = *text;
  } else {
    refuse(key, "this is to be a text");
  }
}

void SettingsReader::take(const std::string& key, bool& value) {
  const Value* found = find(key);
  if (found == nullptr) return;
  if (const bool* flag = found->boolean()) {
    value = *flag;
  } else {
    refuse(key, "this is to be true or false");
  }
}

void SettingsReader::take(const std::string& key, double& value, double least, double most) {
  const Value* found = find(key);
  if (found == nullptr) return;
  const double* number = found->number();
  if (number == nullptr || !(*number >= least && *number <= most)) {
    refuse(key, "this is to be a number from " + short_text(least) + " to " + short_text(most));
    return;
  }
  value = *number;
}

void SettingsReader::take(const std::string& key, int& value, int least, int most) {
  double number = value;
  take(key, number, least, most);
  if (number != std::floor(number)) refuse(key, "this is to be a whole number");
  value = static_cast<int>(number);
}

void SettingsReader::take(const std::string& key, std::optional<int>& value, int least, int most) {
  if (find(key) == nullptr) return;
  int number = value.value_or(least);
  take(key, number, least, most);
  value = number;
}

Status SettingsReader::done() {
  for (const auto& [key, value] : device_.settings) {
    if (!known_.contains(key)) refuse(key, "the driver \"" + device_.driver + "\" has no such setting");
  }
  return fault_ ? Status(*fault_) : Status();
}

}  // namespace focalstage
