#include "editor/trials/trial_words.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>

namespace focalstage {

std::string reading_text(double reading_m) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", reading_m * 1e3);
  std::string shortened(text);
  if (shortened.ends_with(".0")) shortened.resize(shortened.size() - 2);
  return shortened + " mm";
}

std::string block_text(const std::vector<TrialBlock>& plan, const TrialBlock& block) {
  const auto training = std::ranges::count_if(block.trials, &Trial::training);
  std::string text = "Block " + std::to_string(block.number) + " of " + std::to_string(plan.size()) + ": " +
                     std::to_string(block.trials.size()) + " trials";
  if (training == 1) text += ", the first for training";
  if (training > 1) text += ", the first " + std::to_string(training) + " for training";
  return text + ".";
}

std::string trial_text(const TrialInPlan& at) {
  return "Trial " + std::to_string(at.trial.number) + " of " + std::to_string(at.block.trials.size()) + " (block " +
         std::to_string(at.block.number) + " of " + std::to_string(at.plan.size()) +
         (at.trial.training ? ", training" : "") + "), pointer from " + reading_text(at.trial.pointer_start_m);
}

std::string complaint(const Fault& fault) {
  std::string text = fault.message + "; " + fault.remedy + ".";
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return printable(text);
}

std::string printable(const std::string& text) {
  std::string plain = text;
  std::ranges::replace_if(
      plain, [](char c) { return static_cast<unsigned char>(c) < ' ' || c == 0x7f; }, ' ');
  return plain;
}

}  // namespace focalstage
