// SPDX-License-Identifier: Apache-2.0
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <charconv>
#include <cstdio>
#include <span>
#include <string_view>

#include "common/core/base/files.hpp"
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

void SayRefusal(const base::Error& error) { SayNext("refused: " + error.message); }

// What is tried besides the start.
struct StateTrial {
  enum class What { kNone, kSave, kSet };
  What what = What::kNone;
  std::filesystem::path file;
};

base::Status SaveState(Instance& instance, const std::filesystem::path& file) {
  const auto bytes = instance.State();
  if (!bytes) return bytes.error();
  return base::WriteWhole(file,
                          std::string_view(reinterpret_cast<const char*>(bytes.value().data()), bytes.value().size()));
}

// An error of the step is none of the state: some FMUs take steps of one length only.
base::Status SetState(Instance& instance, const std::filesystem::path& file) {
  constexpr double kStep_s = 0.001;
  const auto text = base::ReadText(file, std::size_t{1} << 30);
  if (!text) return text.error();
  SayNext("fmi2SetFMUstate");
  if (auto status = instance.SetState(std::as_bytes(std::span(text.value()))); !status) return status;
  SayNext("fmi2DoStep behind fmi2SetFMUstate");
  (void)instance.DoStep(0.0, kStep_s);
  return {};
}

void Try(const std::filesystem::path& folder, const std::string& file, const StateTrial& state) {
  SayNext("loading");
  auto unit = Unit::LoadUnpacked(folder, file);
  if (!unit) return;
  SayNext("fmi2Instantiate");
  auto instance = unit.value()->Instantiate("trial");
  if (!instance) return SayRefusal(instance.error());
  SayNext("fmi2EnterInitializationMode");
  bool runs = false;
  if (instance.value()->EnterInitialisation(0.0)) {
    SayNext("fmi2ExitInitializationMode");
    runs = instance.value()->ExitInitialisation().ok();
  }
  if (runs && state.what != StateTrial::What::kNone) {
    SayNext("fmi2GetFMUstate");
    const base::Status status = state.what == StateTrial::What::kSave ? SaveState(*instance.value(), state.file)
                                                                      : SetState(*instance.value(), state.file);
    if (!status) SayRefusal(status.error());
  }
  SayNext("fmi2FreeInstance");
  instance.value().reset();
  SayNext("unloading");
}

}  // namespace

int RunTrial(int argc, char** argv) {
  const std::string_view first = argc > 1 ? argv[1] : "";
  constexpr const char* kUsage =
      "rodeira-fmu-trial FOLDER FILE CPU_SECONDS [save|set STATE_FILE]\n"
      "Loads the FMU unpacked in FOLDER and makes an instance of it; saves its state into STATE_FILE, or sets it from\n"
      "there. Started by Rodeira before it uses an FMU.\n";
  if (first == "--help") {
    std::fputs(kUsage, stdout);
    return 0;
  }
  unsigned cpu_s = 0;
  const std::string_view number = argc == 4 || argc == 6 ? argv[3] : "";
  StateTrial state;
  if (argc == 6) {
    const std::string_view what = argv[4];
    state = {what == "save" ? StateTrial::What::kSave : StateTrial::What::kSet, argv[5]};
  }
  const auto [end, problem] = std::from_chars(number.data(), number.data() + number.size(), cpu_s);
  if (problem != std::errc{} || end != number.data() + number.size() || cpu_s == 0) {
    std::fputs(kUsage, stderr);
    return 2;
  }
  const pid_t parent = ::getppid();
  LimitThisProcess(cpu_s);
  if (::getppid() != parent) return 1;  // it ended before
  Try(argv[1], argv[2], state);
  SayNext("");
  return 0;
}

}  // namespace rodeira::fmi
