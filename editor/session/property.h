#pragma once

#include <string>
#include <vector>

#include "core/scene/edit.h"
#include "core/scene/value.h"
#include "editor/session/thing.h"

namespace focalstage {

struct Property;
struct PropertyScope;

/// The edits that give one thing that value.
using PropertyEdits = std::vector<Edit> (*)(const PropertyScope& scope, const Thing& thing, const Property& row,
                                            const Value& value);

struct PropertyChoice {
  Value value;
  std::string label;

  bool operator==(const PropertyChoice&) const = default;
};

/// One line of what is selected: what it says, what may be put there, and how that becomes edits. No pixel of it: a
/// window draws it, a test reads it.
struct Property {
  enum class Kind {
    number,
    integer,
    text,
    flag,
    choice,  ///< one of `choices`
    colour,  ///< [r, g, b], linear
    shown,   ///< can only be read
    action   ///< runs `command` with `args`
  };
  enum class Tone { plain, amber, red };

  std::string id;     ///< its own among all rows of a selection: "position x"
  std::string label;  ///< "x"
  Kind kind = Kind::shown;
  Value value;         ///< null: not set
  bool mixed = false;  ///< the selected things differ; `value` is the last one's

  std::string unit;
  int digits = 3;
  double step = 0.005;  ///< per pixel of a drag
  double least = -1e9;
  double most = 1e9;
  std::string other;  ///< the same in another unit: "0.50 m" beside 2.00 D
  Tone tone = Tone::plain;

  std::string help;
  std::string unavailable;  ///< why it can only be read now
  std::vector<PropertyChoice> choices;
  bool removable = false;  ///< a null value takes it away
  Value fresh;             ///< what an unset one begins with

  std::string key;                ///< of the edit, as a path
  PropertyEdits edits = nullptr;  ///< null: sets `key`
  std::string command;
  Value args;
};

struct PropertyGroup {
  std::string title;
  std::vector<Property> rows;
};

}  // namespace focalstage
