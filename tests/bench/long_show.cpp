#include "tests/bench/long_show.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <numbers>
#include <optional>
#include <vector>

#include <glm/gtc/quaternion.hpp>

#include "core/compile/compile.h"
#include "core/stage/stage.h"
#include "io/assets/assets.h"
#include "io/project/project_file.h"

namespace focalstage::bench {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// A folder that goes with it.
struct Scratch {
  std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("focalstage-bench-" + std::to_string(getpid()));
  Scratch() { std::filesystem::create_directories(folder / "long"); }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
  }
};

/// The sample with every object turning and drifting to the last frame, so that no frame is like another.
Project moving(Project project, int frames) {
  project.frames.count = frames;
  const double end_s = frames / project.frames.rate_hz;
  for (Object& object : project.objects) {
    Keyframe from{0.0, object.placement.pose, {}}, to{end_s, object.placement.pose, {}};
    to.pose.rotation = to.pose.rotation * glm::angleAxis(0.9 * std::numbers::pi, glm::dvec3(0.0, 1.0, 0.0));
    to.pose.position_m.x += 0.01;
    object.placement.keys = {from, to};
  }
  return project;
}

double cpu_now_ms() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

Status time_frame_alone(const Project& project, LongShow& measured) {
  Compiler compiler(compile_settings(project));
  std::vector<double> times_ms, cpu_ms;
  constexpr int samples = 21;  // from all over the show
  for (int i = 0; i < samples; ++i) {
    const int frame = i * project.frames.count / samples;
    const auto start = Clock::now();
    const double cpu_before_ms = cpu_now_ms();
    const Result<Stage> up = stage(project, {}, frame / project.frames.rate_hz);
    if (!up) return up.fault();
    if (const auto compiled = compiler.frame(*up); !compiled) return compiled.fault();
    times_ms.push_back(1e3 * seconds_since(start));
    cpu_ms.push_back(cpu_now_ms() - cpu_before_ms);
  }
  measured.frame_ms = median(times_ms);
  measured.frame_cpu_ms = median(cpu_ms);
  return {};
}

/// Runs a program to its end, unheard; what it used.
std::optional<rusage> use_of_run(const std::filesystem::path& program, std::vector<std::string> words) {
  words.insert(words.begin(), program.string());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t silent;
  posix_spawn_file_actions_init(&silent);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {
    posix_spawn_file_actions_addopen(&silent, stream, "/dev/null", O_WRONLY, 0);
  }
  pid_t child = 0;
  const int failed = posix_spawn(&child, program.c_str(), &silent, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&silent);
  int status = 0;
  rusage used{};
  if (failed != 0 || wait4(child, &status, 0, &used) != child) return std::nullopt;
  const bool done = WIFEXITED(status) && WEXITSTATUS(status) <= 1;  // findings do not matter here
  return done ? std::optional(used) : std::nullopt;
}

}  // namespace

Result<LongShow> compile_long_show(int frames) {
  const Scratch scratch;
  Result<LoadedProject> sample = load_project(FOCALSTAGE_SOURCE_DIR "/projects/three-rabbits");
  if (!sample) return sample.fault();
  const Project project = moving(std::move(sample->project), frames);
  const std::filesystem::path file = scratch.folder / "long" / "long.focal", show = scratch.folder / "long.h5";
  if (Status saved = save_project(project, file); !saved) return saved.fault();

  LongShow measured;
  measured.frames = frames;
  if (Status timed = time_frame_alone(project, measured); !timed) return timed.fault();
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "focalstage";
  const auto start = Clock::now();
  const auto used = use_of_run(program, {"compile", file.string(), "-o", show.string()});
  measured.show_s = seconds_since(start);
  std::error_code missing;
  const auto bytes = std::filesystem::file_size(show, missing);
  if (!used || missing) {
    return Fault{"bench.compile", program.string(), "does not compile the long show", "build focalstage first"};
  }
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  measured.show_cpu_s = seconds(used->ru_utime) + seconds(used->ru_stime);
  measured.most_memory_mib = static_cast<double>(used->ru_maxrss) / 1024.0;
  measured.show_mib = static_cast<double>(bytes) / (1024.0 * 1024.0);
  return measured;
}

}  // namespace focalstage::bench
