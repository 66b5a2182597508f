// SPDX-License-Identifier: Apache-2.0
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <charconv>
#include <cstdio>
#include <string_view>

#include "common/vehicle/fmi/trial.hpp"
#include "common/vehicle/fmi/unit.hpp"

namespace rodeira::fmi {
namespace {

void SayNext(std::string_view function) {
  const std::string line = std::string(function) + "\n";
  [[maybe_unused]] const ssize_t written = ::write(kTrialDescriptor, line.data(), line.size());
}

// A crash kills this process, without a memory dump, and under sanitizers, too.
void LimitThisProcess(rlim_t cpu_s) {
  for (const int number : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT}) ::signal(number, SIG_DFL);
  const rlimit no_dump{0, 0}, time{cpu_s, cpu_s + 1};
  (void)::setrlimit(RLIMIT_CORE, &no_dump);
  (void)::setrlimit(RLIMIT_CPU, &time);
  (void)::prctl(PR_SET_PDEATHSIG, SIGKILL);
}

void Try(const std::filesystem::path& folder, const std::string& file) {
  SayNext("loading");
  auto unit = Unit::LoadUnpacked(folder, file);
  if (!unit) return;
  SayNext("fmi2Instantiate");
  auto instance = unit.value()->Instantiate("trial");
  if (!instance) return;
  SayNext("fmi2EnterInitializationMode");
  if (instance.value()->EnterInitialisation(0.0)) {
    SayNext("fmi2ExitInitializationMode");
    (void)instance.value()->ExitInitialisation();
  }
  SayNext("fmi2FreeInstance");
  instance.value().reset();
  SayNext("unloading");
}

}  // namespace

int RunTrial(int argc, char** argv) {
  const std::string_view first = argc > 1 ? argv[1] : "";
  constexpr const char* kUsage =
      "rodeira-fmu-trial FOLDER FILE CPU_SECONDS\n"
      "Loads the FMU unpacked in FOLDER and makes an instance of it. Started by Rodeira before it uses an FMU.\n";
  if (first == "--help") {
    std::fputs(kUsage, stdout);
    return 0;
  }
  unsigned cpu_s = 0;
  const std::string_view number = argc == 4 ? argv[3] : "";
  const auto [end, problem] = std::from_chars(number.data(), number.data() + number.size(), cpu_s);
  if (problem != std::errc{} || end != number.data() + number.size() || cpu_s == 0) {
    std::fputs(kUsage, stderr);
    return 2;
  }
  const pid_t parent = ::getppid();
  LimitThisProcess(cpu_s);
  if (::getppid() != parent) return 1;  // it ended before
  Try(argv[1], argv[2]);
  SayNext("");
  return 0;
}

}  // namespace rodeira::fmi
