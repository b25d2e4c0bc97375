#include "editor/cli/edit_file.h"

#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "io/assets/assets.h"
#include "io/files/files.h"
#include "io/json/json.h"
#include "io/models/models.h"

namespace focalstage {
namespace {

constexpr std::uint64_t largest_edit_file_bytes = 64u << 20;

std::filesystem::path file_for(const std::filesystem::path& output, const std::filesystem::path& own) {
  if (output.empty()) return own;
  if (output.extension() == ".focal") return output;
  const std::filesystem::path folder = std::filesystem::absolute(output).lexically_normal();
  const std::filesystem::path name = folder.has_filename() ? folder.filename() : folder.parent_path().filename();
  return output / (name.string() + ".focal");
}

Fault cannot_make(const std::filesystem::path& folder, const std::error_code& problem) {
  return {"file.unwritable", folder.string(), problem.message(), "choose a folder that can be written"};
}

Status copy_assets(const Project& project, const std::filesystem::path& from, const std::filesystem::path& to) {
  const auto loaded = load_assets(project, from);
  if (!loaded) return loaded.fault();
  for (const AssetFile& file : loaded->files) {
    const std::filesystem::path target = to / file.path;
    std::error_code problem;
    std::filesystem::create_directories(target.parent_path(), problem);
    if (problem) return cannot_make(target.parent_path(), problem);
    if (Status written = write_file_atomically(target, file.bytes); !written) return written;
  }
  return {};
}

}  // namespace

Result<std::vector<Edit>> read_edits(const std::filesystem::path& file) {
  const auto bytes = read_file(file, largest_edit_file_bytes);
  if (!bytes) return bytes.fault();
  std::string_view rest(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  std::vector<Edit> edits;
  for (int number = 1; !rest.empty(); ++number) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (line.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    const std::string place = file.string() + ": line " + std::to_string(number);
    const auto value = parse_json(line, place);
    if (!value) return value.fault();
    auto edit = edit_from(*value);
    if (!edit) {
      Fault fault = edit.fault();
      fault.where = fault.where.empty() ? place : place + ": " + fault.where;
      return fault;
    }
    edits.push_back(std::move(*edit));
  }
  return edits;
}

Result<std::filesystem::path> apply_and_save(const LoadedProject& loaded, const std::vector<Edit>& edits,
                                             const std::filesystem::path& output) {
  const auto edited = apply_all(loaded.project, edits);
  if (!edited) return edited.fault();
  const std::filesystem::path file = file_for(output, loaded.file);
  const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  if (problem) return cannot_make(folder, problem);
  const bool elsewhere =
      !std::filesystem::equivalent(folder, std::filesystem::absolute(loaded.file).parent_path(), problem);
  if (elsewhere) {
    if (Status copied = copy_assets(*edited, loaded.file.parent_path(), folder); !copied) return copied.fault();
    if (Status copied = copy_models(loaded.file.parent_path(), folder); !copied) return copied.fault();
  }
  if (Status saved = save_project(*edited, file); !saved) return saved.fault();
  return file;
}

}  // namespace focalstage
