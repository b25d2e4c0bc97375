#include "editor/session/edit_words.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <string_view>

#include "core/check/words.h"
#include "core/scene/pointer.h"
#include "editor/session/thing.h"

namespace focalstage {
namespace {

struct Word {
  std::string_view key;
  std::string_view said;
};

/// Keys that a person calls otherwise than the file does.
constexpr std::array said_otherwise{
    Word{"min_power_d", "lowest power"},
    Word{"max_power_d", "highest power"},
    Word{"powers_d", "powers"},
    Word{"illumination", "light"},
    Word{"albedo", "paint"},
    Word{"rotation_xyzw", "rotation"},
    Word{"depth/vergence_d", "image depth"},
    Word{"depth/mode", "depth mode"},
    Word{"frames_per_second", "images per second"},
    Word{"bits", "bit depth"},
    Word{"interpupillary_mm", "interpupillary distance"},
    Word{"fx_px", "focal length in x"},
    Word{"fy_px", "focal length in y"},
};

constexpr std::array units{
    Word{"_m", "m"},   Word{"_mm", "mm"}, Word{"_d", "D"},   Word{"_s", "s"},         Word{"_ms", "ms"},
    Word{"_hz", "Hz"}, Word{"_deg", "°"}, Word{"_px", "px"}, Word{"_d_per_a", "D/A"},
};

/// The unit that a key ends in; the longest, so that "_ms" is no "_s".
const Word* unit_of(std::string_view key) {
  const Word* found = nullptr;
  for (const Word& unit : units) {
    if (key.ends_with(unit.key) && (!found || unit.key.size() > found->key.size())) found = &unit;
  }
  return found;
}

std::string with_unit(const std::string& number, std::string_view unit) {
  if (unit.empty()) return number;
  return number + (unit == "°" ? "" : " ") + std::string(unit);
}

/// "1.2", "(0.1, 0, -0.5)", "sine"; none for what has too many parts to be said.
std::optional<std::string> value_words(const Value& value, std::string_view unit) {
  if (const double* number = value.number()) return with_unit(words(*number), unit);
  if (const bool* flag = value.boolean()) return *flag ? "on" : "off";
  if (const std::string* text = value.text()) return text->empty() ? "nothing" : *text;
  const Value::Array* array = value.array();
  if (!array || array->empty() || array->size() > 8) return std::nullopt;
  std::string list;
  for (const Value& item : *array) {
    if (!item.number()) return std::nullopt;
    list += (list.empty() ? "" : ", ") + words(*item.number());
  }
  return with_unit(list, unit);
}

std::string key_words(std::string_view key) {
  for (const Word& word : said_otherwise) {
    if (word.key == key) return std::string(word.said);
  }
  if (const Word* unit = unit_of(key)) key.remove_suffix(unit->key.size());
  std::string said(key);
  for (char& c : said) {
    if (c == '_' || c == '/') c = ' ';
  }
  return said;
}

/// The name of a thing within a sentence: "the sweep", "rabbit".
std::string thing_words(const Edit& edit) {
  if (!edit.name.empty()) return edit.name;
  std::string title = title_of({edit.list, {}});
  title[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(title[0])));
  return "the " + title;
}

std::vector<double> numbers_of(const Value& value) {
  std::vector<double> numbers;
  if (const Value::Array* array = value.array()) {
    for (const Value& item : *array) numbers.push_back(item.number() ? *item.number() : NAN);
  }
  return numbers;
}

/// What is in `list` and not in `other`, counted: a power may stand there twice.
std::vector<double> beyond(const std::vector<double>& list, std::vector<double> other) {
  std::vector<double> more;
  for (const double number : list) {
    const auto at = std::ranges::find(other, number);
    if (at == other.end()) {
      more.push_back(number);
    } else {
      other.erase(at);
    }
  }
  return more;
}

std::string powers_words(const std::vector<double>& powers_d) {
  std::string list;
  for (std::size_t i = 0; i < powers_d.size(); ++i) {
    const bool last = i + 1 == powers_d.size();
    list += (i == 0 ? "" : last ? " and " : ", ") + words(powers_d[i]);
  }
  return list + " D";
}

std::string slices_words(const Edit& edit, const Project& project) {
  const std::vector<double> after = numbers_of(edit.value);
  const std::vector<double>& before = project.slices.powers_d;
  const std::vector<double> added = beyond(after, before);
  const std::vector<double> dropped = beyond(before, after);
  const auto a_slice = [](const std::vector<double>& powers_d, const char* one) {
    return (powers_d.size() == 1 ? one : "slices") + std::string(" at ") + powers_words(powers_d);
  };
  if (!added.empty() && dropped.empty()) return "Add " + a_slice(added, "a slice");
  if (added.empty() && !dropped.empty()) return "Remove " + a_slice(dropped, "the slice");
  if (added.size() == 1 && dropped.size() == 1) {
    return "Move the slice at " + powers_words(dropped) + " to " + powers_words(added);
  }
  if (added.empty()) return "Put the slices into another order";
  return "Set the slices to " + powers_words(after);
}

/// A slice by its power, which says more than its place in the list.
std::string slice_words(const Project& project, const Value& index) {
  const double* number = index.number();
  const std::vector<double>& powers_d = project.slices.powers_d;
  const bool known = number && *number >= 0 && *number < static_cast<double>(powers_d.size());
  if (known) return "the slice at " + words(powers_d[static_cast<std::size_t>(*number)]) + " D";
  return "slice " + (number ? words(*number + 1) : std::string("unknown"));
}

std::string depth_words(const Edit& edit, const Project& project) {
  const Value* mode = edit.value.find("mode");
  const Value* vergence = edit.value.find("vergence_d");
  const Value* index = edit.value.find("index");
  const std::string wanted = mode && mode->text() ? *mode->text() : "";
  const double vergence_d = vergence && vergence->number() ? *vergence->number() : 0.0;
  if (wanted == "placed") return "Show " + edit.name + " in focus where it stands";
  if (wanted == "fixed") return "Show " + edit.name + " in focus at " + words(vergence_d) + " D";
  if (wanted == "offset") {
    return "Shift the image depth of " + edit.name + " by " + (vergence_d > 0 ? "+" : "") + words(vergence_d) + " D";
  }
  if (wanted == "slice") return "Pin " + edit.name + " to " + slice_words(project, index ? *index : Value());
  return "Change the depth of " + edit.name;
}

std::optional<std::string> flag_words(const Edit& edit) {
  const bool* on = edit.value.boolean();
  if (!on) return std::nullopt;
  if (edit.key == "hidden") return (*on ? "Hide " : "Show ") + edit.name;
  if (edit.key == "locked") return (*on ? "Lock " : "Unlock ") + edit.name;
  return std::nullopt;
}

/// What a step of a mesh's processing does, said of a thing.
constexpr std::array step_words{
    Word{"weld", "Weld the mesh of"},
    Word{"clean", "Clean the mesh of"},
    Word{"drop-fins", "Drop the fins of"},
    Word{"drop-bits", "Drop the loose bits of"},
    Word{"fix-winding", "Fix the winding of"},
    Word{"flip", "Flip the mesh of"},
    Word{"fill-holes", "Fill the holes of"},
    Word{"keep-part", "Keep one part of"},
    Word{"decimate", "Decimate"},
    Word{"smooth", "Smooth"},
    Word{"subdivide", "Subdivide"},
    Word{"uv-plane", "Lay a picture by a plane on"},
    Word{"uv-projector", "Lay a picture by a projector on"},
};

/// Of a whole step; its settings are keys like others.
std::optional<std::string> process_words(const Edit& edit, const std::vector<std::string>& steps) {
  if (steps.size() != 3 || steps[0] != "mesh" || steps[1] != "process") return std::nullopt;
  const Value* name = edit.value.find("step");
  if (name && name->text()) {
    const auto word = std::ranges::find(step_words, std::string_view(*name->text()), &Word::key);
    if (word != step_words.end()) return std::string(word->said) + " " + edit.name;
  }
  const auto index = index_in(steps[2]);
  const std::string step = "step " + (index ? std::to_string(*index + 1) : steps[2]);
  return (edit.value.is_null() ? "Take " + step + " from" : "Change " + step + " of") + " the mesh of " + edit.name;
}

/// "rounds of step 2 of box", "highest power of the sweep"
std::string what_words(const Edit& edit, const std::vector<std::string>& steps) {
  if (steps.size() == 4 && steps[0] == "mesh" && steps[1] == "process") {
    const auto index = index_in(steps[2]);
    return key_words(steps[3]) + " of step " + std::to_string(index.value_or(0) + 1) + " of " + thing_words(edit);
  }
  return key_words(edit.key) + " of " + thing_words(edit);
}

std::string set_words(const Edit& edit, const Project& project) {
  if (edit.list == "slices" && edit.key == "powers_d" && edit.value.array()) return slices_words(edit, project);
  if (edit.list == "objects" && edit.key == "depth" && edit.value.object()) return depth_words(edit, project);
  if (edit.list == "objects" && edit.key == "depth/index") {
    return "Pin " + edit.name + " to " + slice_words(project, edit.value);
  }
  if (const auto flag = flag_words(edit)) return *flag;
  if (edit.list.empty() && edit.key == "name") return "Call the project " + value_words(edit.value, "").value_or("");
  const std::vector<std::string> steps = pointer_steps(edit.key);
  if (const auto process = process_words(edit, steps)) return *process;
  const std::string what = what_words(edit, steps);
  if (edit.value.is_null()) return "Clear " + what;
  const Word* unit = unit_of(edit.key);
  const auto value = value_words(edit.value, unit ? unit->said : std::string_view());
  return value ? "Set " + what + " to " + *value : "Change " + what;
}

std::string lowered(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

}  // namespace

std::string edit_words(const Edit& edit, const Project& project) {
  switch (edit.kind) {
    case Edit::Kind::set:
      return set_words(edit, project);
    case Edit::Kind::add:
      return "Add " + thing_words(edit);
    case Edit::Kind::remove:
      return "Remove " + thing_words(edit);
    case Edit::Kind::rename:
      return "Rename " + thing_words(edit) + " to " + value_words(edit.value, "").value_or("another name");
    case Edit::Kind::move:
      return "Move " + thing_words(edit) + " in the list";
    case Edit::Kind::group:
      break;
  }
  const std::string* group = edit.value.text();
  if (!group || group->empty()) return "Take " + thing_words(edit) + " out of its group";
  return "Put " + thing_words(edit) + " into " + *group;
}

std::string edit_words(const std::vector<Edit>& edits, const Project& project) {
  constexpr std::size_t most = 3;
  std::string sentence;
  for (std::size_t i = 0; i < std::min(edits.size(), most); ++i) {
    const std::string said = edit_words(edits[i], project);
    sentence += i == 0 ? said : ", " + lowered(said);
  }
  if (edits.size() > most) sentence += " and " + std::to_string(edits.size() - most) + " more";
  return sentence;
}

std::string place_words(const std::string& pointer, const Project& project) {
  const std::vector<std::string> steps = pointer_steps(pointer);
  const Thing thing = thing_at(project, pointer);
  const std::vector<double>& powers_d = project.slices.powers_d;
  if (thing.list == "slices" && steps.size() == 3 && steps[1] == "powers_d") {
    const auto index = index_in(steps[2]);
    if (index && *index < powers_d.size()) return "Slice at " + words(powers_d[*index]) + " D";
  }
  return title_of(thing);
}

}  // namespace focalstage
