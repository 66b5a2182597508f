// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/doctor/doctor_machine.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <gnu/libc-version.h>
#include <sys/socket.h>
#include <sys/statvfs.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

#include "common/core/base/installation.hpp"
#include "launch/rodeira/doctor/capture.hpp"

namespace rodeira::cli {
namespace {

using namespace std::chrono_literals;

constexpr std::uint64_t kSocketBufferBytes = 1u << 20;
constexpr std::uint64_t kMemoryBytes = 1'000'000'000;

std::optional<std::uint64_t> NumberIn(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::uint64_t number = 0;
  if (!(in >> number)) return std::nullopt;
  return number;
}

bool Reaches(const std::filesystem::path& socket_file) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string path = socket_file.string();
  if (path.size() >= sizeof(address.sun_path)) return false;
  std::memcpy(address.sun_path, path.c_str(), path.size());
  const int socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (socket < 0) return false;
  const bool reached = ::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
  ::close(socket);
  return reached;
}

std::string EnvironmentValue(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

// ":0", ":0.0", "unix:0" → 0; a display of another PC has no number here.
std::optional<int> LocalDisplay(const std::string& x11) {
  const auto colon = x11.find(':');
  if (colon == std::string::npos || (colon != 0 && x11.substr(0, colon) != "unix")) return std::nullopt;
  return std::atoi(x11.c_str() + colon + 1);
}

// What keeps one of the node programs from working; empty where nothing does.
std::string ProblemOf(const std::filesystem::path& program) {
  std::error_code problem;
  if (!std::filesystem::is_regular_file(program, problem)) return "is missing";
  if (::access(program.c_str(), X_OK) != 0) return "may not be executed";
  const Captured help = CaptureProgram({program.string(), "--help"}, 20s);
  if (help.well()) return {};
  return help.too_late ? "does not answer --help within 20 s" : fmt::format("does not start ({})", help.FirstLine());
}

}  // namespace

std::string WriteProblem(const std::filesystem::path& folder) {
  const std::string file = (folder / fmt::format("rodeira-doctor-{}", ::getpid())).string();
  const int made = ::open(file.c_str(), O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC, 0600);
  if (made < 0) return std::strerror(errno);
  const char byte = 1;
  const bool written = ::write(made, &byte, 1) == 1;
  const std::string problem = written ? "" : std::strerror(errno);
  ::close(made);
  ::unlink(file.c_str());
  return problem;
}

std::vector<std::string> ParsePackages(std::string_view text) {
  std::vector<std::string> packages;
  std::istringstream lines{std::string(text)};
  for (std::string line; std::getline(lines, line);) {
    std::string name = line.substr(0, line.find_first_of(" \t#"));
    if (!name.empty()) packages.push_back(std::move(name));
  }
  return packages;
}

Finding CheckPackages(const std::vector<std::string>& packages, const std::string& dpkg_query) {
  const std::string check = "packages";
  if (packages.empty()) return Ok(check, "a run needs no packages beside those of its libraries");
  if (::access(dpkg_query.c_str(), X_OK) != 0) {
    return Warning(
        "system.no_dpkg", check,
        fmt::format("there is no {}: this is not Debian, and the packages that a run needs cannot be checked",
                    dpkg_query));
  }
  std::vector<std::string> command{dpkg_query, "-W", "-f", "is ${Package} ${Status}\n"};
  command.insert(command.end(), packages.begin(), packages.end());
  const Captured asked = CaptureProgram(command, 20s);
  if (asked.status != 0 && asked.status != 1)
    return Warning("system.no_dpkg", check, fmt::format("{} says nothing: {}", dpkg_query, asked.FirstLine()));
  std::set<std::string> installed;
  std::istringstream lines(asked.output);
  for (std::string line; std::getline(lines, line);) {
    constexpr std::string_view kInstalled = " install ok installed";
    if (line.starts_with("is ") && line.ends_with(kInstalled))
      installed.insert(line.substr(3, line.size() - 3 - kInstalled.size()));
  }
  std::vector<std::string> missing;
  for (const std::string& package : packages) {
    if (!installed.contains(package)) missing.push_back(package);
  }
  if (!missing.empty()) {
    return Fault("system.no_package", check,
                 fmt::format("{} not installed: sudo apt-get install {}",
                             missing.size() == 1 ? "a package is" : "packages are", fmt::join(missing, " ")));
  }
  return Ok(check, fmt::format("all {} packages that a run needs are installed", packages.size()));
}

Finding CheckPrograms(const std::vector<std::string>& programs, const std::filesystem::path& folder) {
  std::vector<std::string> problems;
  for (const std::string& program : programs) {
    if (const std::string problem = ProblemOf(base::FindProgram(program, folder)); !problem.empty())
      problems.push_back(program + " " + problem);
  }
  if (problems.empty())
    return Ok("programs", fmt::format("{} in {} start", fmt::join(programs, ", "), folder.string()));
  const char* remedy = base::IsInstalled(folder) ? "install the packages again (sudo apt-get install --reinstall "
                                                   "rodeira-headless rodeira)"
                                                 : "build again (ninja -C build) or copy the whole folder";
  return Fault("system.broken_program", "programs",
               fmt::format("in {}: {}; {}", folder.string(), fmt::join(problems, ", "), remedy));
}

Finding CheckGeodata(const base::Status& loaded) {
  const std::string check = "geodata";
  return loaded ? Ok(check, "elevation files and projections can be read")
                : Fault(loaded.error().id, check, loaded.error().Text());
}

Finding CheckMathematics(bool fixed, base::Digest digest) {
  const std::string check = "mathematics";
  if (!fixed) {
    return Fault(
        "system.free_mathematics", check,
        fmt::format("the mathematics library chose its code by this processor (digest {}): runs will not give "
                    "the same bits elsewhere; "
                    "set GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2 before the start (is /proc mounted?)",
                    base::Hex(digest)));
  }
  if (digest == kDebian12Mathematics) return Ok(check, fmt::format("digest {}, that of Debian 12", base::Hex(digest)));
  return Warning("system.other_mathematics", check,
                 fmt::format("digest {} (glibc {}), that of Debian 12 is {}: only PCs with the same digest can "
                             "share a run or compare digests",
                             base::Hex(digest), ::gnu_get_libc_version(), base::Hex(kDebian12Mathematics)));
}

Finding CheckSockets(const std::filesystem::path& proc) {
  const std::string check = "sockets";
  std::vector<std::string> small;
  std::string found;
  for (const char* name : {"rmem_max", "wmem_max"}) {
    const auto bytes = NumberIn(proc / "sys/net/core" / name);
    if (!bytes)
      return Warning("system.small_socket_buffer", check,
                     fmt::format("{} cannot be read; at least {} bytes were expected there",
                                 (proc / "sys/net/core" / name).string(), kSocketBufferBytes));
    found += fmt::format("{}net.core.{} is {}", found.empty() ? "" : ", ", name, *bytes);
    if (*bytes < kSocketBufferBytes) small.push_back(fmt::format("net.core.{}=4194304", name));
  }
  if (small.empty()) return Ok(check, found);
  return Warning(
      "system.small_socket_buffer", check,
      fmt::format(
          "{}; at least {} were expected, or UDP between PCs loses samples and sends them again: sudo sysctl -w {}",
          found, kSocketBufferBytes, fmt::join(small, " ")));
}

DisplayPlace DisplayPlace::OfThisProcess() {
  return {EnvironmentValue("DISPLAY"), EnvironmentValue("WAYLAND_DISPLAY"), EnvironmentValue("XDG_RUNTIME_DIR")};
}

Finding CheckDisplay(const DisplayPlace& place) {
  const std::string check = "display";
  if (!place.wayland.empty() && Reaches(std::filesystem::path(place.runtime_folder) / place.wayland)) {
    return Ok(check, fmt::format("a window can be opened (WAYLAND_DISPLAY={})", place.wayland));
  }
  if (const auto number = LocalDisplay(place.x11)) {
    if (Reaches(place.x11_sockets / fmt::format("X{}", *number)))
      return Ok(check, fmt::format("a window can be opened (DISPLAY={})", place.x11));
  } else if (!place.x11.empty()) {
    return Ok(check,
              fmt::format("DISPLAY={} is another PC's; whether it lets us in shows when a window opens", place.x11));
  }
  if (place.x11.empty() && place.wayland.empty())
    return Ok(check, "none (neither DISPLAY nor WAYLAND_DISPLAY is set): pictures are drawn off-screen");
  return Warning(
      "system.no_display", check,
      fmt::format("DISPLAY='{}' and WAYLAND_DISPLAY='{}' lead to no display server: pictures are drawn off-screen",
                  place.x11, place.wayland));
}

Finding CheckCores(unsigned int cores) {
  if (cores >= 2) return Ok("cores", fmt::format("{} are there", cores));
  return Warning("system.few_cores", "cores",
                 fmt::format("{} was found; at least 2 were expected, or a run of several processes is slow", cores));
}

Finding CheckMemory(const std::filesystem::path& proc) {
  std::ifstream in(proc / "meminfo");
  for (std::string line; std::getline(in, line);) {
    unsigned long long kib = 0;
    if (std::sscanf(line.c_str(), "MemAvailable: %llu kB", &kib) != 1) continue;
    const std::uint64_t bytes = kib * 1024;
    if (bytes >= kMemoryBytes)
      return Ok("memory", fmt::format("{:.0f} MB are free", static_cast<double>(bytes) / kBytesPerMegabyte));
    return Warning("system.little_memory", "memory",
                   fmt::format("{:.0f} MB are free; at least {:.0f} MB were expected: close other programs",
                               static_cast<double>(bytes) / kBytesPerMegabyte,
                               static_cast<double>(kMemoryBytes) / kBytesPerMegabyte));
  }
  return Warning("system.little_memory", "memory",
                 fmt::format("{} does not say how much is free", (proc / "meminfo").string()));
}

Finding CheckDisk(const std::filesystem::path& folder, std::uint64_t wanted_bytes) {
  const std::string check = "disk";
  std::error_code problem;
  std::filesystem::path there = std::filesystem::absolute(folder, problem);
  while (!std::filesystem::exists(there, problem) && there.has_relative_path()) there = there.parent_path();
  struct statvfs info {};
  if (!std::filesystem::is_directory(there, problem)) {
    return Fault("system.no_recording_folder", check,
                 fmt::format("recordings go to {}, but {} is no folder; set XDG_DATA_HOME or name each by --record",
                             folder.string(), there.string()));
  }
  std::string refused = WriteProblem(there);
  if (refused.empty() && ::statvfs(there.c_str(), &info) != 0) refused = std::strerror(errno);
  if (!refused.empty()) {
    return Fault(
        "system.no_recording_folder", check,
        fmt::format(
            "recordings are written to {}, but {} is not writable ({}); set XDG_DATA_HOME or name each by --record",
            folder.string(), there.string(), refused));
  }
  const std::uint64_t free_bytes = static_cast<std::uint64_t>(info.f_bavail) * info.f_frsize;
  const std::string found = fmt::format("recordings go to {}, where {:.0f} MB are free", folder.string(),
                                        static_cast<double>(free_bytes) / kBytesPerMegabyte);
  if (free_bytes >= wanted_bytes) return Ok(check, found);
  return Warning("system.full_disk", check,
                 fmt::format("{}; at least {:.0f} MB were expected: make room, or set XDG_DATA_HOME", found,
                             static_cast<double>(wanted_bytes) / kBytesPerMegabyte));
}

}  // namespace rodeira::cli
