#include "io/json/json.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

using namespace focalstage;

namespace {

Fault fault_of_text(std::string_view text, const JsonLimits& limits = {}) {
  const auto value = parse_json(text, "f");
  if (value.ok()) {
    const auto limited = parse_json(text, "f", limits);
    REQUIRE_FALSE(limited.ok());
    return limited.fault();
  }
  return value.fault();
}

Value parsed(std::string_view text) {
  const auto value = parse_json(text, "f");
  REQUIRE_MESSAGE(value.ok(), (value.ok() ? "" : describe(value.fault())));
  return *value;
}

std::string nested(int levels, char open, char close) {
  return std::string(static_cast<std::size_t>(levels), open) + std::string(static_cast<std::size_t>(levels), close);
}

}  // namespace

TEST_CASE("values come back as written, members in their order") {
  const Value value = parsed(R"( {"b":[1,-2.5e3,true,false,null,"\u00e9\n\\"],"a":{},"c":[]} )");
  const Value::Object& members = *value.object();
  CHECK(members[0].first == "b");
  CHECK(members[1].first == "a");
  const Value::Array& list = *members[0].second.array();
  CHECK(list[0] == Value(1));
  CHECK(list[1] == Value(-2500));
  CHECK(list[2] == Value(true));
  CHECK(list[4] == Value());
  CHECK(list[5] == Value("\xc3\xa9\n\\"));
  CHECK(members[1].second == Value(Value::Object{}));
  CHECK(write_json(value, -1) == "{\"b\":[1,-2500,true,false,null,\"\xc3\xa9\\n\\\\\"],\"a\":{},\"c\":[]}");
}

TEST_CASE("syntax faults name line and column") {
  CHECK(fault_of_text("{\n  \"a\": 1,\n  \"b\" 2\n}").where == "f: line 3, column 7");
  CHECK(fault_of_text("[1, 2,]").where == "f: line 1, column 7");
  CHECK(fault_of_text("{} x").where == "f: line 1, column 4");
  CHECK(fault_of_text("[nul]").code == "json.syntax");
  CHECK(fault_of_text("// no\n1").code == "json.syntax");
}

TEST_CASE("every strict beginning of a text is refused, with a place in it") {
  const std::string text = R"({"a":[1,{"b":"\u00e9x"},true],"c":-1.5e-3})";
  for (std::size_t length = 0; length < text.size(); ++length) {
    INFO(length);
    const Fault fault = fault_of_text(text.substr(0, length));
    CHECK(fault.code == "json.syntax");
    CHECK(fault.where.starts_with("f: line 1, column "));
  }
}

TEST_CASE("empty, blank and binary texts are refused") {
  CHECK(fault_of_text("").message == "is empty");
  CHECK(fault_of_text(" \n\t").message == "is empty");
  CHECK(fault_of_text(std::string_view("\0\0\0\0", 4)).code == "json.syntax");
  CHECK(fault_of_text("\x89PNG\r\n\x1a\n").code == "json.syntax");
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    std::string noise(random() % 64 + 2, ' ');
    for (char& c : noise) c = static_cast<char>(random());
    noise[0] = "[{\"x"[random() % 4];
    const auto value = parse_json(noise, "f");
    if (!value.ok()) CHECK_FALSE(value.fault().where.empty());
  }
}

TEST_CASE("depth is bounded where it is passed, for any kind of nesting") {
  CHECK(parse_json(nested(64, '[', ']'), "f").ok());
  const Fault deep = fault_of_text(nested(65, '[', ']'));
  CHECK(deep.code == "json.depth");
  CHECK(deep.where == "f: line 1, column 65");
  CHECK(fault_of_text(nested(10'000, '[', ']')).code == "json.depth");
  CHECK(fault_of_text(std::string(5'000'000, '[')).code == "json.depth");
  std::string objects;
  for (int i = 0; i < 10'000; ++i) objects += "{\"a\":";
  CHECK(fault_of_text(objects).code == "json.depth");
}

TEST_CASE("size is bounded before anything is read") {
  CHECK(fault_of_text("[1,2,3]", {.bytes = 6}).code == "json.size");
  CHECK(parse_json("[1,2,3]", "f", {.bytes = 7}).ok());
}

TEST_CASE("numbers that a double cannot hold, and words for them, are refused") {
  const Fault big = fault_of_text("[1,\n 1e999]");
  CHECK(big.code == "json.number");
  CHECK(big.where.starts_with("f: line 2, column "));
  CHECK(fault_of_text("[-1e999]").code == "json.number");
  for (const char* text : {"[NaN]", "[Infinity]", "[-inf]", "[0x10]", "[01]", "[1.]", "[.5]", "[+1]"}) {
    INFO(text);
    CHECK(fault_of_text(text).code == "json.syntax");
  }
  CHECK(parsed("1e-999") == Value(0));
}

TEST_CASE("a key may stand once in an object") {
  const Fault twice = fault_of_text("{\"a\":1,\n\"b\":{\"a\":2},\n\"a\":3}");
  CHECK(twice.code == "json.duplicate-key");
  CHECK(twice.where == "f: line 3, column 4");
  CHECK(fault_of_text(R"({"a":1,"\u0061":2})").code == "json.duplicate-key");
}

TEST_CASE("text must be UTF-8") {
  for (const char* text : {"\"\x80\"", "\"\xc3\"", "\"\xc0\xaf\"", "\"\xed\xa0\x80\"", "\"\xf5\x80\x80\x80\"",
                           "\"\\ud800\"", "\"a\nb\""}) {
    CHECK(fault_of_text(text).code == "json.syntax");
  }
  CHECK(parsed(R"("\ud83d\ude00")") == Value("\xf0\x9f\x98\x80"));
}

TEST_CASE("numbers are the shortest text that reads back to the same double") {
  CHECK(write_json(Value(0.1)) == "0.1");
  CHECK(write_json(Value(3.0)) == "3");
  CHECK(write_json(Value(-0.333)) == "-0.333");
  CHECK(write_json(Value(1e300)) == "1e+300");
  std::mt19937_64 random(2);
  for (int i = 0; i < 20'000; ++i) {
    const auto bits = random();
    double number = 0.0;
    static_assert(sizeof bits == sizeof number);
    std::memcpy(&number, &bits, sizeof number);
    if (!std::isfinite(number)) continue;
    CHECK(*parsed(write_json(Value(number))).number() == number);
  }
}

TEST_CASE("what JSON cannot say is written as what it can") {
  CHECK(write_json(Value(std::numeric_limits<double>::infinity())) == "null");
  CHECK(write_json(Value(std::string("a\x01\x80z"))) == "\"a\\u0001\xef\xbf\xbdz\"");
  CHECK(write_json(Value("\xf0\x9f\x98\x80\xed\xa0\x80")) ==
        "\"\xf0\x9f\x98\x80\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd\"");
}

TEST_CASE("files read well: lists of numbers and short objects on a line, the rest one member a line") {
  const Value value = parsed(R"({"name":"x","viewer":{"position_m":[0,0,0],"mm":63},"things":[{"mesh":{"a":1}},{"b":2}],
    "none":[],"long":{"first":"aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa","second":"bbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbb"}})");
  CHECK(write_json(value) == R"({
  "name": "x",
  "viewer": { "position_m": [0, 0, 0], "mm": 63 },
  "things": [
    {
      "mesh": { "a": 1 }
    },
    { "b": 2 }
  ],
  "none": [],
  "long": {
    "first": "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa",
    "second": "bbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbb"
  }
})");
}
