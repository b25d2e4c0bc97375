#include "core/scene/value.h"

#include <doctest/doctest.h>

#include "core/scene/number_text.h"
#include "core/scene/pointer.h"

using namespace focalstage;

TEST_CASE("members are set in place, appended at the end, and erased") {
  Value value;
  value.set("b", 1);
  value.set("a", "x");
  value.set("b", 2);
  REQUIRE(value.object());
  CHECK(*value.object() == Value::Object{{"b", Value(2)}, {"a", Value("x")}});
  value.erase("b");
  value.erase("none");
  CHECK(*value.object() == Value::Object{{"a", Value("x")}});
  CHECK_FALSE(value.find("b"));
  CHECK(*value.find("a") == Value("x"));
}

TEST_CASE("what is no object has no members and takes none") {
  Value number(3);
  number.set("a", 1);
  CHECK(number == Value(3));
  CHECK_FALSE(number.find("a"));
  number.erase("a");
  CHECK(number == Value(3));
}

TEST_CASE("a value is of one kind") {
  CHECK(Value().is_null());
  CHECK(Value(false) != Value(0));
  CHECK(Value("") != Value());
  CHECK(Value(Value::Array{}) != Value(Value::Object{}));
  CHECK(*Value(true).boolean());
  CHECK_FALSE(Value(true).number());
}

TEST_CASE("pointers spell slashes and tildes, and lead back (RFC 6901)") {
  CHECK(pointer_into("/a", "b/c~d") == "/a/b~1c~0d");
  CHECK(pointer_into("", std::size_t{3}) == "/3");
  CHECK(pointer_steps("/a/b~1c~0d") == std::vector<std::string>{"a", "b/c~d"});
  CHECK(pointer_steps("depth/mode") == std::vector<std::string>{"depth", "mode"});
  CHECK(pointer_steps("").empty());
  CHECK(pointer_steps("/") == std::vector<std::string>{""});
  CHECK(pointer_steps("/~01") == std::vector<std::string>{"~1"});
}

TEST_CASE("an index is digits without a leading zero") {
  CHECK(index_in("0") == 0);
  CHECK(index_in("12") == 12);
  for (const char* no : {"", "01", "-1", "1x", "x", " 1", "99999999999999999999999"}) CHECK_FALSE(index_in(no));
}

TEST_CASE("a pointer finds its value or nothing") {
  Value root;
  root.set("list", Value(Value::Array{Value(1), Value(Value::Object{{"a", Value(2)}})}));
  CHECK(value_at(root, {}) == &root);
  CHECK(*value_at(root, pointer_steps("/list/1/a")) == Value(2));
  CHECK_FALSE(value_at(root, pointer_steps("/list/2")));
  CHECK_FALSE(value_at(root, pointer_steps("/list/a")));
  CHECK_FALSE(value_at(root, pointer_steps("/list/0/a")));
}

TEST_CASE("numbers in messages are as short as they can be") {
  CHECK(number_text(0.1) == "0.1");
  CHECK(number_text(60) == "60");
  CHECK(number_text(-1.0 / 3.0) == "-0.3333333333333333");
}
