#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "editor/session/folder_listing.h"

namespace focalstage {

/// A folder in view: its entries as a list to choose from.
class FileBrowser {
 public:
  void look_for(Listed wanted);
  void go(const std::filesystem::path& folder);
  /// Reads the folder again.
  void refresh();

  const std::filesystem::path& folder() const { return folder_; }
  /// Why the folder could not be read; empty: it could.
  const std::string& problem() const { return problem_; }
  const FolderEntry* chosen() const;

  /// Moves the choice with the arrow keys and pages. True if it moved.
  bool follow_keys();

  struct Press {
    bool chose = false;
    bool entered = false;  ///< a double click
  };
  /// The list, filling what the region has left of `height_px`.
  Press draw(float height_px);

  /// Places to begin from, as rows: each with a folder. The one that was pressed.
  static std::optional<std::filesystem::path> draw_places(const std::vector<std::filesystem::path>& places,
                                                          const std::filesystem::path& now);

 private:
  Press draw_entry(std::size_t index);

  Listed wanted_ = Listed::projects;
  std::filesystem::path folder_;
  std::vector<FolderEntry> entries_;
  std::string problem_;
  int chosen_ = -1;
  bool reveal_ = false;
};

/// A path cut at its front to `width_px` pixels: its end says most.
std::string path_end(const std::filesystem::path& path, float width_px);

}  // namespace focalstage
