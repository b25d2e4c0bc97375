#include "editor/session/export_views.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <system_error>

#include "editor/preview/eye_painter.h"
#include "editor/preview/slice_maker.h"
#include "io/image/png.h"

extern char** environ;

namespace focalstage {
namespace {

namespace fs = std::filesystem;
using Files = std::vector<fs::path>;

struct Painting {
  CompiledSlices compiled;
  SliceMaker maker{0};
  EyePainter painter;
};

Status prepare(Painting& painting, const ViewExport& wanted, std::stop_token stop) {
  std::error_code problem;
  fs::create_directories(wanted.folder, problem);
  if (problem) return Fault{"file.unwritable", wanted.folder.string(), problem.message(), "choose another folder"};
  auto frame = painting.maker.make(*wanted.project, *wanted.stage, SliceMaker::Variant::shown, 1, std::move(stop));
  if (!frame) return frame.fault();
  CompiledSlices& compiled = painting.compiled;
  compiled.project = wanted.project;
  compiled.stage = wanted.stage;
  compiled.settings = SliceMaker::settings_of(*wanted.project, SliceMaker::Variant::shown, 1);
  compiled.images = std::move(frame->images);
  return {};
}

Result<EyePicture> paint(Painting& painting, EyeWish eye, EyeLook look, std::stop_token stop) {
  eye.look = look;
  return painting.painter.paint(painting.compiled, eye, painting.maker, std::move(stop));
}

Status write(const EyePicture& picture, const fs::path& file, Files& written) {
  if (Status done = write_png(file, picture.width_px, picture.height_px, 3, picture.rgb); !done) return done;
  written.push_back(file);
  return {};
}

EyePicture side_by_side(const EyePicture& left, const EyePicture& right) {
  EyePicture both = left;
  both.width_px = 2 * left.width_px;
  both.rgb.clear();
  const auto row = static_cast<std::ptrdiff_t>(left.width_px) * 3;
  for (std::ptrdiff_t y = 0; y < left.height_px; ++y) {
    for (const EyePicture* half : {&left, &right}) {
      both.rgb.insert(both.rgb.end(), half->rgb.begin() + y * row, half->rgb.begin() + (y + 1) * row);
    }
  }
  return both;
}

/// Runs ffmpeg where it is; false where it is not or says no.
bool encode(const fs::path& pattern, const fs::path& movie) {
  std::array<std::string, 13> words{"ffmpeg",   "-y",      "-loglevel",      "error", "-framerate",
                                    "30",       "-i",      pattern.string(), "-vf",   "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                                    "-pix_fmt", "yuv420p", movie.string()};
  std::array<char*, 14> arguments{};
  for (std::size_t i = 0; i < words.size(); ++i) arguments[i] = words[i].data();
  pid_t process = 0;
  if (posix_spawnp(&process, "ffmpeg", nullptr, nullptr, arguments.data(), environ) != 0) return false;
  int status = 0;
  return waitpid(process, &status, 0) == process && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

std::string numbered(int k) {
  std::array<char, 32> name{};
  std::snprintf(name.data(), name.size(), "focal-pull-%04d.png", k);
  return name.data();
}

}  // namespace

Result<Files> export_stereo(const ViewExport& wanted, std::stop_token stop) {
  Painting painting;
  if (Status ready = prepare(painting, wanted, stop); !ready) return ready.fault();
  const auto left = paint(painting, wanted.eye, EyeLook::left, stop);
  if (!left) return left.fault();
  const auto right = paint(painting, wanted.eye, EyeLook::right, stop);
  if (!right) return right.fault();
  const auto red_cyan = paint(painting, wanted.eye, EyeLook::red_cyan, stop);
  if (!red_cyan) return red_cyan.fault();
  Files written;
  const std::array<std::pair<const char*, const EyePicture*>, 3> singles{
      {{"stereo-left.png", &*left}, {"stereo-right.png", &*right}, {"stereo-red-cyan.png", &*red_cyan}}};
  for (const auto& [name, picture] : singles) {
    if (Status done = write(*picture, wanted.folder / name, written); !done) return done.fault();
  }
  if (Status done = write(side_by_side(*left, *right), wanted.folder / "stereo-side-by-side.png", written); !done) {
    return done.fault();
  }
  return written;
}

Result<Files> export_focal_pull(const ViewExport& wanted, double from_d, double to_d, int frames,
                                const std::function<void(double)>& progress, std::stop_token stop) {
  Painting painting;
  if (Status ready = prepare(painting, wanted, stop); !ready) return ready.fault();
  Files written;
  for (int k = 0; k < frames; ++k) {
    // There and back, slowest at the ends, where something is in focus.
    const double share = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * k / frames);
    EyeWish eye = wanted.eye;
    eye.focus_d = from_d + share * (to_d - from_d);
    const auto picture = paint(painting, eye, wanted.eye.look, stop);
    if (!picture) return picture.fault();
    if (Status done = write(*picture, wanted.folder / numbered(k), written); !done) return done.fault();
    progress(static_cast<double>(k + 1) / frames);
  }
  const fs::path movie = wanted.folder / "focal-pull.mp4";
  if (encode(wanted.folder / "focal-pull-%04d.png", movie)) written.push_back(movie);
  return written;
}

}  // namespace focalstage
