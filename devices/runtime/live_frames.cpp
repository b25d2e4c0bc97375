#include "devices/runtime/live_frames.h"

#include <fstream>
#include <system_error>

namespace focalstage {

LiveFrames::LiveFrames(const std::filesystem::path& folder) : folder_(std::filesystem::absolute(folder) / "live") {
  std::error_code error;
  std::filesystem::remove_all(folder_, error);
  std::filesystem::create_directories(folder_, error);
}

LiveFrames::~LiveFrames() {
  std::error_code error;
  std::filesystem::remove_all(folder_, error);
}

std::string LiveFrames::write(const FrameImages& images) {
  const std::filesystem::path path = folder_ / (std::to_string(count_++) + ".codes");
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(images.codes.data()), static_cast<std::streamsize>(images.codes.size()));
  file.close();
  written_.push_back(path);
  std::error_code error;
  if (written_.size() > 2) {
    std::filesystem::remove(written_.front(), error);
    written_.pop_front();
  }
  return file ? path.string() : std::string();
}

}  // namespace focalstage
