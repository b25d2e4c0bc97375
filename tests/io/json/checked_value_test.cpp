#include "io/json/checked_value.h"

#include <doctest/doctest.h>

using namespace focalstage;

TEST_CASE("what is there is read, what is not keeps its default") {
  Value value;
  value.set("number", 2.5);
  value.set("count", 7.0);
  value.set("flag", true);
  value.set("text", "words");
  value.set("texts", Value(Value::Array{"a", "b"}));

  double number = 1.0;
  int count = 2;
  bool flag = false;
  std::string text = "before";
  std::optional<int> perhaps;
  for (const char* key : {"absent", "number"}) read(value, key, number);
  for (const char* key : {"absent", "count"}) read(value, key, count);
  for (const char* key : {"absent", "flag"}) read(value, key, flag);
  for (const char* key : {"absent", "text"}) read(value, key, text);
  CHECK(number == 2.5);
  CHECK(count == 7);
  CHECK(flag);
  CHECK(text == "words");
  read(value, "absent", number);
  read(value, "absent", text);
  CHECK(number == 2.5);
  CHECK(text == "words");

  read(value, "absent", perhaps);
  CHECK_FALSE(perhaps.has_value());
  read(value, "count", perhaps);
  CHECK(perhaps == 7);

  CHECK(text_of(value, "text") == "words");
  CHECK(text_of(value, "absent").empty());
  CHECK(number_of(value, "absent", 4.0) == 4.0);
  CHECK(texts_of(value, "texts") == std::vector<std::string>{"a", "b"});
  CHECK(texts_of(value, "absent").empty());
}
