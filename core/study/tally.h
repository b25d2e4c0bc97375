#pragma once

#include <string>
#include <vector>

#include "core/study/response.h"
#include "core/study/study.h"

namespace focalstage {

/// How far one participant came.
struct Tally {
  std::string participant;
  std::string kind;
  int answered = 0;  ///< these three without training
  int given_up = 0;
  int spoiled = 0;
  int of = 0;  ///< trials that count: all but training
  int sittings = 0;

  bool finished() const { return answered + given_up == of; }
};

/// Of those who came at all, in the study's order.
std::vector<Tally> tally_of(const Study& study, const std::vector<Response>& responses);

}  // namespace focalstage
