#pragma once

#include <string>

#include "core/study/plan.h"

namespace focalstage {

/// What a scripted participant's kind begins with; "human" is the other kind.
inline constexpr const char* scripted_prefix = "scripted:";
inline constexpr const char* human_kind = "human";

/// One trial as it went: a row of the responses.
struct Response {
  std::string participant;
  std::string kind = human_kind;  ///< or "scripted:NAME"
  int block = 0;                  ///< from 1
  int condition = 0;              ///< of the study's
  int trial = 0;                  ///< within its block, from 1
  bool training = false;
  int target = 0;      ///< of the study's
  int repetition = 0;  ///< from 1; 0 in training
  double actual_m = 0.0;
  double pointer_start_m = 0.0;
  double response_m = 0.0;  ///< meaningless where given up or spoiled
  bool gave_up = false;
  std::string spoiled;      ///< the code of what went wrong with the rig; the trial is repeated. Empty: nothing
  int sitting = 0;          ///< how many times the participant was called to the rig so far, this one included
  double started_s = 0.0;   ///< monotonic, since this sitting's part of the block began
  double duration_s = 0.0;  ///< from light to answer
  std::string show_sha256;
  double interpupillary_mm = 0.0;  ///< that the show was made for
  std::string rig;                 ///< the kind it says it is: "sim" or the hardware's

  bool operator==(const Response&) const = default;

  bool counts() const { return !training && spoiled.empty(); }
  bool answered() const { return spoiled.empty() && !gave_up; }
};

/// The row of a trial of the plan, before anybody answers: what the plan says of it.
Response response_to(const Study& study, const TrialBlock& block, const Trial& trial);

inline bool is_scripted(const std::string& kind) { return kind.starts_with(scripted_prefix); }

}  // namespace focalstage
