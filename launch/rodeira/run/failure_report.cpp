// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/failure_report.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/utsname.h>

#include <ctime>
#include <thread>

#include "common/core/base/mathematics.hpp"
#include "common/core/base/version.hpp"
#include "launch/rodeira/run/resolve_recording.hpp"
#include "nodes/recorder/program.hpp"

namespace rodeira::cli {

std::string FailureText(const std::string& fault, const launch::Launch& launch, const std::vector<FailedPart>& parts) {
  utsname machine{};
  (void)::uname(&machine);
  std::string text = fmt::format(
      "fault       {}\n"
      "time        {:%Y-%m-%dT%H:%M:%SZ}\n"
      "rodeira     {} (commit {}, mathematics {})\n"
      "machine     {} {} {}, {} cores\n"
      "launch file {}\n",
      fault, fmt::gmtime(std::time(nullptr)), base::Version(), nodes::ProgramCommit(),
      base::Hex(base::MathLibraryFingerprint()), machine.sysname, machine.release, machine.machine,
      std::thread::hardware_concurrency(), launch.path().string());
  for (const auto& [key, value] : launch.overrides()) text += fmt::format("changed     {}={}\n", key, value);
  for (const FailedPart& part : parts) text += fmt::format("part        {}: {}\n", part.name, part.fate);
  for (const FailedPart& part : parts) {
    if (part.log == nullptr || part.log->last_lines().empty()) continue;
    text += fmt::format("\n== last lines of {} ==\n{}\n", part.name, fmt::join(part.log->last_lines(), "\n"));
  }
  return text + fmt::format("\n== {} ==\n{}", launch.path().filename().string(), launch.text());
}

std::filesystem::path FailureFile(const std::string& recording, const std::string& launch_name) {
  std::filesystem::path file(recording.empty() ? DatedRecording(launch_name) : recording);
  return file.replace_extension().string() + "-failure.txt";
}

}  // namespace rodeira::cli
