#include "editor/rig/simulated_rig.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <system_error>
#include <utility>

#include "io/files/descriptor.h"

namespace focalstage {
namespace {

constexpr std::chrono::seconds patience{5};
constexpr std::string_view greeting = "listening on ";

Fault start_fault(const std::string& message) {
  return {"rig.start", "focalstage-runtime", message, "start one by hand: focalstage runtime"};
}

Result<std::filesystem::path> program() {
  std::error_code problem;
  const std::filesystem::path own = std::filesystem::read_symlink("/proc/self/exe", problem);
  for (const char* place : {"focalstage-runtime", "../bin/focalstage-runtime"}) {
    const std::filesystem::path found = own.parent_path() / place;
    if (access(found.c_str(), X_OK) == 0) return found;
  }
  return Fault{"program.missing", (own.parent_path() / "focalstage-runtime").string(), "this program is not there",
               "build it, or install it beside this one"};
}

/// In the new process: only calls that are safe after a fork.
[[noreturn]] void become(char* const* arguments, int output, int nothing, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(127);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  dup2(output, STDOUT_FILENO);
  dup2(nothing, STDIN_FILENO);
  dup2(nothing, STDERR_FILENO);
  execv(arguments[0], arguments);
  _exit(127);
}

/// The first line the runtime says, within its patience.
std::string first_line(int pipe) {
  std::string line;
  const auto end = std::chrono::steady_clock::now() + patience;
  while (line.find('\n') == std::string::npos) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
    pollfd wanted{pipe, POLLIN, 0};
    if (left.count() <= 0 || poll(&wanted, 1, static_cast<int>(left.count())) <= 0) return {};
    std::array<char, 256> bytes{};
    const ssize_t count = read(pipe, bytes.data(), bytes.size());
    if (count <= 0) return {};
    line.append(bytes.data(), static_cast<std::size_t>(count));
  }
  return line.substr(0, line.find('\n'));
}

}  // namespace

Result<SimulatedRig> SimulatedRig::start(const std::filesystem::path& store) {
  const auto runtime = program();
  if (!runtime) return runtime.fault();
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) return start_fault(std::strerror(errno));
  Descriptor said(ends[0]), output(ends[1]);
  const Descriptor nothing(open("/dev/null", O_RDWR | O_CLOEXEC));
  std::array<std::string, 7> words{runtime->string(), "--rig",   "sim",         "--listen",
                                   "127.0.0.1:0",     "--store", store.string()};
  std::array<char*, 8> arguments{};
  for (std::size_t i = 0; i < words.size(); ++i) arguments[i] = words[i].data();
  const pid_t parent = getpid();
  const pid_t process = fork();
  if (process < 0) return start_fault(std::strerror(errno));
  if (process == 0) become(arguments.data(), output.number(), nothing.number(), parent);
  SimulatedRig rig(process, {});
  output.close();
  const std::string line = first_line(said.number());
  if (!line.starts_with(greeting)) return start_fault("it did not start within five seconds");
  rig.address_ = line.substr(greeting.size());
  return rig;
}

SimulatedRig::SimulatedRig(SimulatedRig&& other) noexcept
    : process_(std::exchange(other.process_, -1)), address_(std::move(other.address_)) {}

SimulatedRig& SimulatedRig::operator=(SimulatedRig&& other) noexcept {
  std::swap(process_, other.process_);
  std::swap(address_, other.address_);
  return *this;
}

SimulatedRig::~SimulatedRig() { stop(); }

bool SimulatedRig::running() {
  if (process_ > 0 && waitpid(process_, nullptr, WNOHANG) == process_) process_ = -1;
  return process_ > 0;
}

void SimulatedRig::stop() {
  if (!running()) return;
  kill(process_, SIGTERM);
  for (int tries = 0; tries < 100 && running(); ++tries) usleep(20'000);
  if (!running()) return;
  kill(process_, SIGKILL);
  waitpid(process_, nullptr, 0);
  process_ = -1;
}

}  // namespace focalstage
