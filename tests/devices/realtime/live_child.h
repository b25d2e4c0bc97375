#pragma once

#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <string>
#include <vector>

namespace focalstage {

/// This test program once more, as the editor that is killed: runs the one test case that is an editor.
class LiveChild {
 public:
  /// Begins, and returns once that editor says that its revision is seen; false where it never does.
  bool start(const std::string& address) {
    int out[2] = {-1, -1};
    if (::pipe(out) != 0) return false;
    const std::string variable = std::string(address_variable) + "=" + address;
    const std::string to = std::string(pipe_variable) + "=" + std::to_string(out[1]);
    std::array<char*, 4> argv{const_cast<char*>("child"), const_cast<char*>("--no-skip"),
                              const_cast<char*>("--test-case=the editor that is killed"), nullptr};
    std::array<char*, 3> variables{const_cast<char*>(variable.c_str()), const_cast<char*>(to.c_str()), nullptr};
    const int failed = ::posix_spawn(&process_, "/proc/self/exe", nullptr, nullptr, argv.data(), variables.data());
    ::close(out[1]);
    char word = 0;
    const bool said = failed == 0 && ::read(out[0], &word, 1) == 1;
    ::close(out[0]);
    return said;
  }
  LiveChild() = default;
  LiveChild(const LiveChild&) = delete;
  LiveChild& operator=(const LiveChild&) = delete;
  ~LiveChild() {
    send(SIGKILL);
    if (process_ > 0) ::waitpid(process_, nullptr, 0);
  }

  void send(int signal) {
    if (process_ > 0) ::kill(process_, signal);
  }

  static constexpr const char* address_variable = "FOCALSTAGE_TEST_RIG";
  static constexpr const char* pipe_variable = "FOCALSTAGE_TEST_PIPE";

 private:
  pid_t process_ = -1;
};

}  // namespace focalstage
