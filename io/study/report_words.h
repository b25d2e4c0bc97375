#pragma once

#include <string>

#include "core/study/least_squares.h"
#include "io/study/report.h"

namespace focalstage {

/// A length as millimetres, with `decimals` places.
std::string mm_text(double length_m, int decimals = 2);

/// "p = 0.64", "p < 0.001"
std::string p_text(double p);

/// "F(1,96) = 0.218, p = 0.64"; says where there is nothing to test.
std::string test_text(const std::optional<FTest>& test);

/// A name safe in Markdown's tables and in XML.
std::string escaped(const std::string& text);

const std::string& condition_name(const Study& study, int condition);
const std::string& target_name(const Study& study, int target);
const std::string& participant_name(const Study& study, int participant);

/// What a report of scripted participants says first.
inline constexpr const char* scripted_warning =
    "Scripted participants answered, not people: this is a rehearsal and no human result.";

}  // namespace focalstage
