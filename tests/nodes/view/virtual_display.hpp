// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace rodeira::nodes {

// A display of its own (Xvfb), named by DISPLAY as long as this lives; no name where Xvfb is not there.
class VirtualDisplay {
 public:
  explicit VirtualDisplay(std::vector<std::string> more = {}) {
    int told[2];
    if (::pipe(told) != 0) return;
    pid_ = ::fork();
    if (pid_ == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGTERM);  // it does not outlive a test that ends at once
      ::dup2(told[1], 3);
      ::close_range(4, ~0U, 0);  // what it holds open is not waited for
      std::vector<std::string> words = {"Xvfb", "-noreset", "-displayfd", "3", "-screen", "0", "640x480x24"};
      words.insert(words.end(), more.begin(), more.end());
      std::vector<char*> argv;
      for (std::string& word : words) argv.push_back(word.data());
      argv.push_back(nullptr);
      if (::freopen("/dev/null", "w", stdout) == nullptr || ::freopen("/dev/null", "w", stderr) == nullptr)
        ::_exit(127);
      ::execvp(argv[0], argv.data());
      ::_exit(127);
    }
    ::close(told[1]);
    for (char c = 0; ::read(told[0], &c, 1) == 1 && c != '\n';)
      number_ += c;  // it says so when it answers; nothing where it does not start
    ::close(told[0]);
    if (!number_.empty()) ::setenv("DISPLAY", name().c_str(), 1);
  }
  ~VirtualDisplay() {
    if (!number_.empty()) ::unsetenv("DISPLAY");
    if (pid_ <= 0) return;
    ::kill(pid_, SIGTERM);
    ::waitpid(pid_, nullptr, 0);
  }
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;

  bool there() const { return !number_.empty(); }
  std::string name() const { return ":" + number_; }

 private:
  pid_t pid_ = -1;
  std::string number_;
};

}  // namespace rodeira::nodes
