// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/fmi/trial.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "common/vehicle/fmi/guard.hpp"

namespace rodeira::fmi {
namespace {

// A crash kills it, also where the code is guarded.
void LimitThisProcess(unsigned most_s) {
  (void)CallGuarded([] {});  // whatever installs itself does so before
  for (const int each : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGALRM, SIGXCPU}) ::signal(each, SIG_DFL);
  const rlimit no_dump{0, 0}, time{most_s, most_s + 1};
  (void)::setrlimit(RLIMIT_CORE, &no_dump);
  (void)::setrlimit(RLIMIT_CPU, &time);
  (void)::alarm(10 * most_s);
}

}  // namespace

base::Status TryInChild(const std::function<void()>& code, unsigned most_s) {
  const pid_t child = ::fork();
  if (child < 0) return base::Failed("no process can be started to try it in");
  if (child == 0) {
    LimitThisProcess(most_s);
    code();
    ::_exit(0);
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFSIGNALED(status)) return {};
  const int signal = WTERMSIG(status);
  if (signal == SIGXCPU || signal == SIGALRM)
    return base::WrongInput(
        fmt::format("its binary does not come back within {} s as it is loaded and makes an instance of itself",
                    signal == SIGXCPU ? most_s : 10 * most_s));
  return base::WrongInput(
      fmt::format("its binary crashes (signal {}) as it is loaded and makes an instance of itself", signal));
}

}  // namespace rodeira::fmi
