#include "core/scene/edit.h"
#include "io/project/schemas.h"
#include "io/project/validate.h"
#include "tests/io/project/sample.h"

using namespace focalstage;

TEST_CASE("the edit schema takes what the reader of edits takes, of every kind") {
  for (const char* line :
       {R"({"edit":"set","list":"objects","name":"near","key":"position_m","value":[0,0,-1]})",
        R"({"edit":"set","list":"viewer","key":"track","value":null})", R"({"edit":"set","key":"name","value":"x"})",
        R"({"edit":"add","list":"objects","name":"a","key":"near","value":{"mesh":{"primitive":"box"}}})",
        R"({"edit":"remove","list":"objects","name":"near"})",
        R"({"edit":"rename","list":"objects","name":"near","value":"far"})",
        R"({"edit":"move","list":"objects","name":"near","value":0})",
        R"({"edit":"group","list":"objects","name":"near","value":""})"}) {
    INFO(line);
    const Value value = value_of(line);
    const auto edit = edit_from(value);
    REQUIRE(edit.ok());
    CHECK_FALSE(schema_fault(value, edit_schema()));
    CHECK(value_from(*edit).find("edit"));
    CHECK_FALSE(schema_fault(value_from(*edit), edit_schema()));
  }
}

TEST_CASE("the edit schema refuses what cannot be applied to any project") {
  for (const char* line :
       {R"(3)", R"({})", R"({"edit":"paint"})", R"({"edit":"set","list":"viewer","value":1})",
        R"({"edit":"set","list":"viewer","key":"","value":1})", R"({"edit":"set","list":"viewer","key":"track"})",
        R"({"edit":"add","list":"objects","value":3})", R"({"edit":"remove","list":"objects"})",
        R"({"edit":"rename","list":"objects","name":"a","value":""})",
        R"({"edit":"move","list":"objects","name":"a","value":-1})",
        R"({"edit":"move","list":"objects","name":"a","value":0.5})",
        R"({"edit":"group","list":"objects","name":"a","value":1})", R"({"edit":"remove","list":"thing","name":"a"})",
        R"({"edit":"remove","list":"objects","name":"a","extra":1})"}) {
    INFO(line);
    CHECK(schema_fault(value_of(line), edit_schema()));
  }
}
