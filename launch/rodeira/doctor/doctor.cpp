// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/doctor/doctor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <thread>
#include <utility>
#include <vector>

#include "common/core/base/installation.hpp"
#include "common/core/base/json_text.hpp"
#include "common/core/base/mathematics.hpp"
#include "common/core/base/print_error.hpp"
#include "common/core/base/user_folders.hpp"
#include "common/runtime/dds/network_state.hpp"
#include "common/vehicle/input_devices/device_access.hpp"
#include "common/world/terrain/geodata.hpp"
#include "launch/rodeira/commands/joysticks_command.hpp"
#include "launch/rodeira/doctor/built_with.hpp"
#include "launch/rodeira/doctor/capture.hpp"
#include "launch/rodeira/doctor/doctor_gl.hpp"
#include "launch/rodeira/doctor/doctor_machine.hpp"
#include "launch/rodeira/doctor/doctor_network.hpp"
#include "launch/rodeira/graphics/graphics.hpp"
#include "launch/rodeira/interrupt.hpp"
#include "launch/rodeira/run/shared_memory.hpp"

namespace rodeira::cli {
namespace {

using namespace std::chrono_literals;
using CheckFunction = std::function<Finding()>;

Finding LookForJoysticks() {
  auto joysticks = input_devices::Joysticks::Start();
  if (!joysticks)
    return Warning("device.not_opened", "joysticks",
                   joysticks.error().Text() + "; a run without `source: joystick` needs none");
  joysticks.value()->Update();
  return CheckJoysticks(joysticks.value()->Connected());
}

const char* WordOf(Verdict verdict) {
  return verdict == Verdict::kOk ? "ok" : verdict == Verdict::kWarning ? "warning" : "fault";
}

// By rodeira-graphics, where this program reads no devices.
Finding AskForJoysticks() {
  const std::string check = "joysticks";
  if (input_devices::HasDeviceAccess()) return LookForJoysticks();
  if (!CanContinueInGraphics()) return Ok(check, "not looked for: built without SDL2 (RODEIRA_VIEW=OFF)");
  const Captured said = CaptureProgram({base::FindProgram("rodeira-graphics").string(), "doctor", "--devices"}, 20s);
  const std::string line = said.FirstLine();
  for (const Verdict verdict : {Verdict::kOk, Verdict::kWarning}) {
    const std::string begin = std::string(WordOf(verdict)) + "\t";
    if (said.well() && line.starts_with(begin))
      return {check, verdict, line.substr(begin.size()), "device.not_readable"};
  }
  return Warning("system.no_graphics", check,
                 fmt::format("not looked for: rodeira-graphics {}",
                             said.too_late ? "does not answer within 20 s" : "does not start: " + line));
}

// A PC with the package rodeira-headless alone.
bool DrawsNothing() {
  std::error_code problem;
  return base::IsInstalled() && !std::filesystem::exists(base::FindProgram("rodeira-graphics"), problem);
}

std::vector<CheckFunction> ChecksOfPictures() {
  if (DrawsNothing())
    return {[] { return Ok("pictures", "this PC draws none: the package rodeira is not installed"); }};
  return {
      [] { return CheckPackages(ParsePackages(PackageList())); },
      [] { return CheckGl(); },
      [] { return CheckDisplay(DisplayPlace::OfThisProcess()); },
      [] { return AskForJoysticks(); },
  };
}

std::vector<std::string> ExpectedPrograms() {
  std::vector<std::string> programs = NodePrograms();
  if (DrawsNothing())
    std::erase_if(programs, [](const std::string& name) {
      return name == "rodeira-view" || name == "rodeira-graphics" || name == "rodeira-nodes-graphics";
    });
  return programs;
}

// Pictures come before DDS: CheckGl forks, which requires a process without threads.
std::vector<CheckFunction> Checks(const DoctorOptions& options, launch::Transport transport) {
  LoopBackSettings loop_back;
  loop_back.transport = transport;
  loop_back.domain = options.domain;
  loop_back.program = base::FindProgram("rodeira").string();
  loop_back.cancelled = Interrupted;
  std::vector<CheckFunction> checks{
      [] { return CheckPrograms(ExpectedPrograms(), base::ProgramFolder()); },
      [] {
        const auto& geodata = terrain::SharedGeodata();
        return CheckGeodata(geodata ? base::Status() : geodata.error());
      },
      [] { return CheckMathematics(base::MathematicsFixed(), base::MathLibraryFingerprint()); },
  };
  for (CheckFunction& check : ChecksOfPictures()) checks.push_back(std::move(check));
  const std::vector<CheckFunction> others{
      [] { return CheckSharedMemory(); },
      [domain = options.domain] { return CheckPorts(domain); },
      [] { return CheckLoopBackInterface(dds::ReadNetworkState().addresses); },
      [loop_back] { return CheckLoopBack(loop_back); },
      [] { return CheckSockets(); },
      [] { return CheckCores(std::thread::hardware_concurrency()); },
      [] { return CheckMemory(); },
      [] { return CheckDisk(base::UserDataFolder()); },
  };
  checks.insert(checks.end(), others.begin(), others.end());
  return checks;
}

std::string Summary(std::span<const Finding> findings) {
  const auto count = [&](Verdict verdict) {
    return std::count_if(findings.begin(), findings.end(),
                         [verdict](const Finding& f) { return f.verdict == verdict; });
  };
  const auto faults = count(Verdict::kFault);
  const auto warnings = count(Verdict::kWarning);
  const auto number = [](auto n, const char* what) {
    return n == 0 ? fmt::format("no {}", what) : fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
  };
  return fmt::format("{}, {}\n", number(faults, "fault"), number(warnings, "warning"));
}

}  // namespace

std::string FindingLine(const Finding& finding) {
  if (base::ErrorsAreJson())
    return fmt::format(R"({{"id":{},"check":{},"verdict":"{}","message":{}}})"
                       "\n",
                       finding.verdict == Verdict::kOk ? "null" : base::JsonText(finding.id.text()),
                       base::JsonText(finding.check), WordOf(finding.verdict), base::JsonText(finding.sentence));
  return fmt::format("{:<7}  {:<17}  {}\n", WordOf(finding.verdict), finding.check, finding.sentence);
}

int StatusOf(std::span<const Finding> findings) {
  return std::any_of(findings.begin(), findings.end(),
                     [](const Finding& finding) { return finding.verdict == Verdict::kFault; })
             ? 1
             : 0;
}

int Doctor(const DoctorOptions& options) {
  const auto transport = options.transport == "udp" ? launch::Transport::kUdp : launch::Transport::kSharedMemory;
  if (!options.answer.empty()) return AnswerLoopBack(options.answer, options.domain, transport, options.segment_kib);
  if (options.devices) {
    const Finding finding = LookForJoysticks();
    fmt::print("{}\t{}\n", WordOf(finding.verdict), finding.sentence);
    return 0;
  }
  CatchInterrupts();
  if (options.clean) {
    const int removed = RemoveLeftOvers({});
    if (!options.quiet) fmt::print("{} files of dead processes removed from /dev/shm\n", removed);
  }
  std::vector<Finding> findings;
  for (const CheckFunction& check : Checks(options, transport)) {
    findings.push_back(check());
    if (Interrupted()) return 1;
    if (options.quiet && findings.back().verdict == Verdict::kOk) continue;
    fmt::print("{}", FindingLine(findings.back()));
    std::fflush(stdout);
  }
  if (!options.quiet && !base::ErrorsAreJson()) fmt::print("{}", Summary(findings));
  return StatusOf(findings);
}

}  // namespace rodeira::cli
