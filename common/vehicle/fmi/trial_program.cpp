// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <iterator>
#include <span>
#include <string>
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

// Steps before and behind the state: a solver has a history by then, which a state may leave out.
constexpr int kSteps = 20;
constexpr double kStep_s = 0.001;
constexpr double kInput = 0.1;  // of each input, so that there is something to compute

bool Steps(const Description& description, Instance& instance, int from) {
  for (int i = from; i < from + kSteps; ++i) {
    for (const Variable& variable : description.variables)
      if (variable.causality == "input" && variable.type == VariableType::kReal) (void)instance.Set(variable, kInput);
    if (!instance.DoStep(i * kStep_s, kStep_s)) return false;  // some FMUs take steps of one length only
  }
  return true;
}

// Its outputs as lines of name and value, to the bit; empty where one cannot be read.
std::string Outputs(const Description& description, Instance& instance) {
  std::string text;
  for (const Variable& variable : description.variables) {
    if (variable.causality != "output" || variable.type == VariableType::kOther) continue;
    const auto value = instance.Get(variable);
    if (!value) return "";
    text += fmt::format("{} = {}\n", variable.name, value.value());
  }
  return text;
}

std::filesystem::path OutputsFile(const std::filesystem::path& state) { return state.string() + ".outputs"; }

base::Status SaveState(const Description& description, Instance& instance, const std::filesystem::path& file) {
  const bool runs = Steps(description, instance, 0);
  SayNext("fmi2GetFMUstate");
  const auto bytes = instance.State();
  if (!bytes) return bytes.error();
  const std::string_view raw(reinterpret_cast<const char*>(bytes.value().data()), bytes.value().size());
  if (auto status = base::WriteWhole(file, raw); !status) return status;
  SayNext("fmi2DoStep");
  const bool goes_on = runs && Steps(description, instance, kSteps);
  return base::WriteWhole(OutputsFile(file), goes_on ? Outputs(description, instance) : "");
}

// Wrong input where the FMU goes on from the state otherwise than it went on by itself. A step that fails is no failure
// of the state.
base::Status SetState(const Description& description, Instance& instance, const std::filesystem::path& file) {
  constexpr std::size_t kMaxStateBytes = std::size_t{1} << 30;
  const auto text = base::ReadText(file, kMaxStateBytes);
  if (!text) return text.error();
  const auto expected = base::ReadText(OutputsFile(file), kMaxStateBytes);
  if (!expected) return expected.error();
  SayNext("fmi2SetFMUstate");
  if (auto status = instance.SetState(std::as_bytes(std::span(text.value()))); !status) return status;
  SayNext("fmi2DoStep behind fmi2SetFMUstate");
  const bool goes_on = Steps(description, instance, kSteps);
  const std::string found = goes_on ? Outputs(description, instance) : "";
  if (expected.value().empty() || found == expected.value()) return {};
  const auto [one, other] = std::ranges::mismatch(found, expected.value());
  const auto line = [](const std::string& whole, std::string::const_iterator at) {
    const auto is_end = [](char c) { return c == '\n'; };
    const auto begin = std::find_if(std::make_reverse_iterator(at), whole.rend(), is_end).base();
    return std::string(begin, std::find_if(at, whole.end(), is_end));
  };
  return base::WrongInput("fmu.trial_failed", fmt::format("it goes on from its own state otherwise: {}; {} without it",
                                                          line(found, one), line(expected.value(), other)));
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
    const auto& act = state.what == StateTrial::What::kSave ? SaveState : SetState;
    const base::Status status = act(unit.value()->description(), *instance.value(), state.file);
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
