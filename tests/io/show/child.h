#pragma once

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <string>
#include <vector>

// The sample's writer as a process of its own, to be killed.
namespace focalstage::sample {

class Child {
 public:
  /// `write_sample` with `arguments`, its errors thrown away; `environment` is added to this process's.
  explicit Child(std::vector<std::string> arguments, std::vector<std::string> environment = {}) {
    arguments.insert(arguments.begin(), FOCALSTAGE_BINARY_DIR "/bin/write_sample");
    for (char** entry = ::environ; *entry; ++entry) environment.emplace_back(*entry);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
    if (::posix_spawn(&id_, arguments[0].c_str(), &actions, nullptr, pointers(arguments).data(),
                      pointers(environment).data()) != 0)
      id_ = -1;
    posix_spawn_file_actions_destroy(&actions);
  }
  ~Child() {
    if (id_ > 0) kill();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  bool started() const { return id_ > 0; }

  /// Its exit status, or -1 where a signal ended it.
  int wait() {
    int status = 0;
    ::waitpid(id_, &status, 0);
    id_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  /// kill -9; its exit status if it was done before.
  int kill() {
    ::kill(id_, SIGKILL);
    return wait();
  }

 private:
  static std::vector<char*> pointers(std::vector<std::string>& texts) {
    std::vector<char*> out;
    for (std::string& text : texts) out.push_back(text.data());
    out.push_back(nullptr);
    return out;
  }

  pid_t id_ = -1;
};

}  // namespace focalstage::sample
