#pragma once

#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/compile/frame.h"
#include "core/optics/image_plan.h"
#include "core/schedule/schedule.h"
#include "devices/runtime/sim_description.h"
#include "io/project/project_file.h"
#include "io/show/writer.h"

namespace focalstage::sample {

/// A folder that goes with the test.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "focalstage-runtime-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// A project for the simulated rig: +-2 D at 60 Hz, slices at -1, -0.1, 0.4 and 1 D. Small images unless said.
inline Project project(int width_px = 64, int height_px = 48) {
  Project project;
  project.name = "Sample";
  SimSettings sim;
  project.glasses = describe_sim(sim, {}, 60.0).glasses;
  project.sweep.min_power_d = -2.0;
  project.sweep.max_power_d = 2.0;
  Projector projector;
  projector.name = "main";
  projector.width_px = width_px;
  projector.height_px = height_px;
  projector.latency_ms = 0.15;
  projector.fx_px = projector.fy_px = 1.4 * width_px;
  projector.cx_px = 0.5 * width_px;
  projector.cy_px = 0.5 * height_px;
  project.projectors.push_back(projector);
  project.slices.powers_d = {-1.0, -0.1, 0.4, 1.0};
  Surface surface;
  surface.name = "screen";
  surface.placement.pose.position_m = {0.0, 0.0, -0.6};
  project.surfaces.push_back(surface);
  return project;
}

/// The simulated rig with images of that size.
inline SimSettings sim(int width_px = 64, int height_px = 48) {
  SimSettings settings;
  settings.width_px = width_px;
  settings.height_px = height_px;
  return settings;
}

inline ShowHeader header_of(const Project& project) {
  const std::vector<ImageSpec> images = image_plan(project);
  return make_show_header(project, project_text(project), {}, make_schedule(project, images).schedule,
                          compile_settings(project), {0, project.frames.count});
}

/// Noise, which does not compress: each image of each frame another.
inline FrameImages noise(const ShowHeader& header, std::uint64_t seed) {
  FrameImages images{header.images.size(), header.width_px, header.height_px, header.channels, {}};
  images.codes.resize(images.count * images.bytes_per_image());
  std::uint64_t state = 0x9E3779B97F4A7C15u * (seed + 1);
  for (std::uint8_t& code : images.codes) {
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    code = static_cast<std::uint8_t>(state >> 32);
  }
  return images;
}

/// Writes a show of `project` with noise for images.
inline Status write_show(const std::filesystem::path& path, const Project& project, std::uint64_t seed = 1) {
  const ShowHeader header = header_of(project);
  Result<ShowWriter> writer = ShowWriter::start(path, header, false, 1);
  if (!writer) return writer.fault();
  for (int frame = 0; frame < header.frames; ++frame) {
    const auto images = noise(header, 1000 * seed + static_cast<std::uint64_t>(frame));
    if (Status added = writer->add_frame(frame, images); !added) return added;
  }
  return writer->finish();
}

}  // namespace focalstage::sample
