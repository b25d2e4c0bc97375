#pragma once

#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <string>
#include <vector>

namespace focalstage {

/// A focalstage-runtime of its own process; killed with the value.
class RuntimeProcess {
 public:
  explicit RuntimeProcess(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), FOCALSTAGE_BINARY_DIR "/bin/focalstage-runtime");
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    int out[2] = {-1, -1};
    int err[2] = {-1, -1};
    if (::pipe(out) != 0 || ::pipe(err) != 0) return;
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, err[1], STDERR_FILENO);
    for (const int end : {out[0], out[1], err[0], err[1]}) posix_spawn_file_actions_addclose(&actions, end);
    if (::posix_spawn(&process_, argv[0], &actions, nullptr, argv.data(), environ) != 0) process_ = -1;
    posix_spawn_file_actions_destroy(&actions);
    ::close(out[1]);
    ::close(err[1]);
    out_ = ::fdopen(out[0], "r");
    err_ = ::fdopen(err[0], "r");
  }
  RuntimeProcess(const RuntimeProcess&) = delete;
  RuntimeProcess& operator=(const RuntimeProcess&) = delete;
  ~RuntimeProcess() {
    send(SIGKILL);
    if (process_ > 0) wait();
    if (out_ != nullptr) ::fclose(out_);
    if (err_ != nullptr) ::fclose(err_);
  }

  /// Where it listens; empty when it ended instead.
  std::string address() {
    const std::string said = line(out_);
    constexpr const char* before = "listening on ";
    return said.starts_with(before) ? said.substr(std::string(before).size()) : std::string();
  }

  std::string error_line() { return line(err_); }

  void send(int signal) {
    if (process_ > 0) ::kill(process_, signal);
  }

  /// Its exit status, or minus the signal that ended it.
  int wait() {
    int status = 0;
    if (process_ <= 0 || ::waitpid(process_, &status, 0) != process_) return -1000;
    process_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

 private:
  static std::string line(std::FILE* file) {
    std::string text;
    for (int c = std::fgetc(file); c != EOF && c != '\n'; c = std::fgetc(file)) text += static_cast<char>(c);
    return text;
  }

  pid_t process_ = -1;
  std::FILE* out_ = nullptr;
  std::FILE* err_ = nullptr;
};

}  // namespace focalstage
