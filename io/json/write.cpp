#include <algorithm>
#include <array>
#include <cmath>

#include "core/scene/number_text.h"
#include "io/json/json.h"
#include "io/json/utf8.h"

namespace focalstage {
namespace {

/// Objects that hold no others stay on one line up to this many characters: a viewer, a keyframe, a depth.
constexpr std::size_t short_object = 88;

void write_text(std::string& out, const std::string& text) {
  out += '"';
  for (const char c : valid_utf8(text)) {
    switch (c) {
      case '"':
        out += "\\\"";
        break;
      case '\\':
        out += "\\\\";
        break;
      case '\n':
        out += "\\n";
        break;
      case '\t':
        out += "\\t";
        break;
      case '\r':
        out += "\\r";
        break;
      default:
        if (static_cast<unsigned char>(c) < 0x20) {
          constexpr std::string_view digits = "0123456789abcdef";
          out += "\\u00";
          out += digits[static_cast<unsigned char>(c) >> 4];
          out += digits[c & 0xf];
        } else {
          out += c;
        }
    }
  }
  out += '"';
}

void write_number(std::string& out, double number) {
  out += std::isfinite(number) ? number_text(number) : "null";  // JSON has no infinities
}

bool is_container(const Value& value) { return value.array() || value.object(); }

bool is_flat_list(const Value& value) {
  return value.array() && std::none_of(value.array()->begin(), value.array()->end(), is_container);
}

/// Neither lists of lists nor objects within: what may share a line.
bool is_leaf(const Value& value) {
  if (value.array()) return is_flat_list(value);
  return value.object() && std::all_of(value.object()->begin(), value.object()->end(), [](const auto& member) {
           return !is_container(member.second) || is_flat_list(member.second);
         });
}

class Writer {
 public:
  explicit Writer(int indent) : indent_(indent) {}

  void write(const Value& value, int level) {
    if (const bool* flag = value.boolean()) {
      out_ += *flag ? "true" : "false";
    } else if (const double* number = value.number()) {
      write_number(out_, *number);
    } else if (const std::string* text = value.text()) {
      write_text(out_, *text);
    } else if (const Value::Array* items = value.array()) {
      write_list(value, *items, level);
    } else if (const Value::Object* members = value.object()) {
      write_object(value, *members, level);
    } else {
      out_ += "null";
    }
  }

  std::string take() { return std::move(out_); }

 private:
  void write_list(const Value& value, const Value::Array& items, int level) {
    const bool broken = indent_ >= 0 && !items.empty() && !is_flat_list(value);
    out_ += '[';
    for (std::size_t i = 0; i < items.size(); ++i) {
      if (i > 0) separate(broken);
      if (broken) new_line(level + 1);
      write(items[i], level + 1);
    }
    if (broken) new_line(level);
    out_ += ']';
  }

  void write_object(const Value& value, const Value::Object& members, int level) {
    const bool broken = indent_ >= 0 && !members.empty() && !fits(value);
    const bool spaced = indent_ >= 0 && !broken && !members.empty();
    out_ += spaced ? "{ " : "{";
    for (std::size_t i = 0; i < members.size(); ++i) {
      if (i > 0) separate(broken);
      if (broken) new_line(level + 1);
      write_text(out_, members[i].first);
      out_ += indent_ >= 0 ? ": " : ":";
      write(members[i].second, level + 1);
    }
    if (broken) new_line(level);
    out_ += spaced ? " }" : "}";
  }

  static bool fits(const Value& value) {
    if (!is_leaf(value)) return false;
    Writer one_line(-1);
    one_line.write(value, 0);
    return one_line.out_.size() <= short_object;
  }

  void separate(bool broken) { out_ += indent_ >= 0 && !broken ? ", " : ","; }

  void new_line(int level) {
    out_ += '\n';
    out_.append(static_cast<std::size_t>(indent_ * level), ' ');
  }

  int indent_;
  std::string out_;
};

}  // namespace

std::string write_json(const Value& value, int indent) {
  Writer writer(indent);
  writer.write(value, 0);
  return writer.take();
}

}  // namespace focalstage
