#include "devices/plugin/library.h"

#include <dlfcn.h>

#include <cstdint>
#include <string>

namespace focalstage {

namespace {

struct Kind {
  const char* words;
  const char* abi_symbol;
  const char* get_symbol;
  std::uint32_t abi;
};

constexpr Kind projector_kind{"projector", "focalstage_projector_abi", "focalstage_projector_get",
                              FOCALSTAGE_PROJECTOR_ABI};
constexpr Kind lens_drive_kind{"lens drive", "focalstage_lens_drive_abi", "focalstage_lens_drive_get",
                               FOCALSTAGE_LENS_DRIVE_ABI};

Fault abi_fault(const Kind& kind, const std::filesystem::path& library, std::uint32_t abi) {
  return {"plugin.abi", library.string(),
          std::string("it is a ") + kind.words + " plugin for version " + std::to_string(abi) + ", this is version " +
              std::to_string(kind.abi),
          "build it with the headers of this version"};
}

bool has_all(const focalstage_projector& table) {
  return table.open && table.close && table.describe && table.identify && table.configure && table.start &&
         table.stop && table.acquire && table.submit && table.status && table.blank;
}

bool has_all(const focalstage_lens_drive& table) {
  return table.open && table.close && table.describe && table.identify && table.start && table.refill && table.status &&
         table.stop;
}

Result<void*> open_library(const std::filesystem::path& library) {
  if (!library.is_absolute()) {
    return Fault{"plugin.path", library.string(), "the path of a plugin does not begin at the root",
                 "write the whole path in the settings"};
  }
  void* handle = ::dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (handle != nullptr) return handle;
  const char* words = ::dlerror();
  return Fault{"plugin.library", library.string(), words != nullptr ? words : "it cannot be loaded",
               "see that the file is there, and the vendor's library that it needs"};
}

template <class Table>
Result<const Table*> load(const std::filesystem::path& library, const Kind& kind) {
  const auto handle = open_library(library);
  if (!handle) return handle.fault();
  const auto abi_of = reinterpret_cast<std::uint32_t (*)()>(::dlsym(*handle, kind.abi_symbol));
  const auto get = reinterpret_cast<const Table* (*)(std::uint32_t)>(::dlsym(*handle, kind.get_symbol));
  if (abi_of == nullptr || get == nullptr) {
    return Fault{"plugin.symbol", library.string(),
                 std::string("it is no ") + kind.words + " plugin: it does not export " +
                     (abi_of == nullptr ? kind.abi_symbol : kind.get_symbol),
                 "see docs/writing-a-driver.md"};
  }
  if (abi_of() != kind.abi) return abi_fault(kind, library, abi_of());
  const Table* table = get(kind.abi);
  if (table == nullptr) return abi_fault(kind, library, 0);
  // Calls may be added at the end; what this version knows is there.
  if (table->size < sizeof(Table) || table->size > 64 * sizeof(Table) || table->abi != kind.abi) {
    return Fault{"plugin.size", library.string(),
                 "its table of calls has " + std::to_string(table->size) + " bytes for version " +
                     std::to_string(table->abi) + ", and " + std::to_string(sizeof(Table)) +
                     " are needed for version " + std::to_string(kind.abi),
                 "build it with the headers of this version, for this kind of machine"};
  }
  if (!has_all(*table)) {
    return Fault{"plugin.calls", library.string(), "one of its calls is missing", "a plugin has every call"};
  }
  return table;
}

}  // namespace

Result<const focalstage_projector*> load_projector_plugin(const std::filesystem::path& library) {
  return load<focalstage_projector>(library, projector_kind);
}

Result<const focalstage_lens_drive*> load_lens_drive_plugin(const std::filesystem::path& library) {
  return load<focalstage_lens_drive>(library, lens_drive_kind);
}

}  // namespace focalstage
