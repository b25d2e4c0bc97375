#pragma once

#include <initializer_list>
#include <string>

#include <nlohmann/json.hpp>

#include "core/base/result.h"

namespace focalstage {

/// What a member of a JSON object must be. Indices and sizes fit an int, into which tinygltf reads them.
enum class MemberKind {
  index,
  size,
  number,
  boolean,
  text,
  object,
  indices,
  numbers,
  pair,
  texts,
  objects,
  index_map,
  index_maps
};

struct Member {
  const char* name;
  MemberKind kind;
  bool required = false;
};

/// Holds objects of a glTF's JSON to the members they may have. Keeps the first fault, which names the place: "path:
/// /accessors/3/count"; after it nothing more is looked at.
class MemberChecker {
 public:
  using Json = nlohmann::json;
  using Members = std::initializer_list<Member>;

  explicit MemberChecker(std::string path) : path_(std::move(path)) {}

  const Status& status() const { return fault_; }
  bool ok() const { return fault_.ok(); }

  /// The fault at this pointer, if it is the first.
  void invalid(const std::string& at, const std::string& what);
  void unsupported(const std::string& at, const std::string& what, const std::string& remedy);

  /// Null where there is none.
  static const Json* find(const Json& object, const char* name);

  void members(const Json& object, const std::string& at, Members expected);

  /// A member object's members, where there is such a member; it must be one. Returns it, or null.
  const Json* inner(const Json& object, const std::string& at, const char* name, Members expected);

  /// An object that an extension adds.
  const Json* extension(const Json& object, const std::string& at, const char* name, Members expected);

  /// The members of every item of a list; `visit(item, pointer)` looks further.
  template <class Visit>
  void each(const Json& parent, const std::string& at, const char* list, Members expected, Visit&& visit) {
    const Json* items = list_of(parent, at, list);
    for (std::size_t i = 0; items != nullptr && i < items->size() && ok(); ++i) {
      const std::string at_item = at + "/" + list + "/" + std::to_string(i);
      members((*items)[i], at_item, expected);
      if (ok()) visit((*items)[i], at_item);
    }
  }
  void each(const Json& parent, const std::string& at, const char* list, Members expected);

 private:
  const Json* list_of(const Json& parent, const std::string& at, const char* list);

  std::string path_;
  Status fault_;
};

}  // namespace focalstage
