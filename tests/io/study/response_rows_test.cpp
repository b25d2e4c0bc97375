#include "io/study/response_rows.h"

#include <algorithm>

#include <doctest/doctest.h>

#include "tests/core/study/a_study.h"

using namespace focalstage;

namespace {

Response a_response() {
  Response response;
  response.participant = "P03";
  response.block = 2;
  response.condition = 1;
  response.trial = 7;
  response.target = 3;
  response.repetition = 2;
  response.actual_m = 0.444;
  response.pointer_start_m = 0.217;
  response.response_m = 0.1 + 0.3512345678901234;
  response.sitting = 2;
  response.started_s = 12.25;
  response.duration_s = 1.0 / 3.0;
  response.show_sha256 = std::string(64, 'a');
  response.interpupillary_mm = 61.5;
  response.rig = "sim";
  return response;
}

std::size_t columns(std::string_view row) { return static_cast<std::size_t>(std::ranges::count(row, ',')) + 1; }

}  // namespace

TEST_CASE("a response reads back to the bit: answered, given up, spoiled, training, scripted") {
  const Study study = paper_study();
  Response answered = a_response();
  Response given_up = answered;
  given_up.gave_up = true;
  given_up.response_m = 0.0;
  Response spoiled = answered;
  spoiled.spoiled = "rig.unreachable";
  spoiled.response_m = 0.0;
  Response training = answered;
  training.training = true;
  training.kind = "scripted:noisy";
  for (const Response& response : {answered, given_up, spoiled, training}) {
    const std::string row = row_of(study, response);
    CHECK(columns(row) == columns(response_header));
    const auto read = response_from(study, row, "f: line 2");
    REQUIRE(read);
    CHECK(*read == response);
  }
  CHECK(row_of(study, given_up).find(",0.217,,1,,") != std::string::npos);
}

TEST_CASE("answers to questions read back, and nothing else does") {
  const Study study = paper_study();
  const QuestionAnswer answer{"P01", "human", 0, true};
  const auto read = question_answer_from(study, row_of(study, answer), "f");
  REQUIRE(read);
  CHECK(*read == answer);
  std::string row = row_of(study, answer);
  row.replace(row.rfind("yes"), 3, "maybe");
  CHECK(question_answer_from(study, row, "f: line 2").fault().message.find("maybe") != std::string::npos);
}

TEST_CASE("every column that is spoilt is named, with its line") {
  const Study study = paper_study();
  const std::string good = row_of(study, a_response());
  const std::string header(response_header);
  std::size_t start = 0;
  std::size_t name_start = 0;
  for (std::size_t column = 0; column < columns(header); ++column) {
    const std::size_t end = std::min(good.find(',', start), good.size());
    const std::size_t name_end = std::min(header.find(',', name_start), header.size());
    const std::string name = header.substr(name_start, name_end - name_start);
    std::string bad = good;
    bad.replace(start, end - start, "?!");
    CAPTURE(name);
    const auto read = response_from(study, bad, "f: line 9");
    const bool free_text = name == "participant" || name == "spoiled" || name == "rig";
    CHECK(read.ok() == free_text);
    if (!read && name != "study") {
      CHECK(read.fault().code == "study.rows");
      CHECK(read.fault().where == "f: line 9");
      CHECK(read.fault().message.starts_with(name + " \"?!\""));
    }
    if (name == "study") CHECK(read.fault().code == "study.other");
    start = end + 1;
    name_start = name_end + 1;
  }
  CHECK(response_from(study, good + ",", "f").fault().message.find("columns") != std::string::npos);
  CHECK(response_from(study, "", "f").fault().code == "study.rows");
}
