// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/doctor/doctor_network.hpp"

#include <fmt/format.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>

#include "common/runtime/dds/shared_memory_room.hpp"
#include "common/runtime/dds/udp_port.hpp"
#include "launch/rodeira/doctor/doctor_machine.hpp"
#include "launch/rodeira/run/run_network.hpp"
#include "launch/rodeira/run/shared_memory.hpp"

namespace rodeira::cli {
namespace {

constexpr int kParticipants = 10;
constexpr int kProcesses = 7;  // of the demo

// The ports that RTPS reserves (DDSI-RTPS 2.2, 9.6.1.1): one each for the multicast of discovery and of samples, then
// two a participant.
std::vector<int> PortsOf(std::uint32_t domain) {
  const int base = 7400 + 250 * static_cast<int>(domain);
  std::vector<int> ports{base, base + 1};
  for (int participant = 0; participant < kParticipants; ++participant) {
    ports.push_back(base + 10 + 2 * participant);
    ports.push_back(base + 11 + 2 * participant);
  }
  return ports;
}

double MegabytesOf(const std::set<std::string>& files, const std::filesystem::path& folder) {
  double bytes = 0.0;
  for (const std::string& file : files) {
    std::error_code gone;
    const auto size = std::filesystem::file_size(folder / file, gone);
    if (!gone) bytes += static_cast<double>(size);
  }
  return bytes / kBytesPerMegabyte;
}

}  // namespace

Finding CheckSharedMemory(const std::filesystem::path& folder, std::uint64_t wanted_bytes) {
  const std::string check = "shared memory";
  const std::string where = folder.string();
  std::error_code gone;
  if (!std::filesystem::is_directory(folder, gone)) {
    return Fault(
        "system.no_shared_memory", check,
        fmt::format(
            "there is no folder {0}; a tmpfs was expected there: sudo mount -t tmpfs tmpfs {0}, or use transport: udp",
            where));
  }
  if (const std::string problem = WriteProblem(folder); !problem.empty()) {
    return Fault("system.no_shared_memory", check,
                 fmt::format("{0} is not writable ({1}); it was expected to be writable for all users: sudo "
                             "chmod 1777 {0}, or use transport: udp",
                             where, problem));
  }
  struct statvfs info {};
  const std::uint64_t free_bytes =
      ::statvfs(folder.c_str(), &info) == 0 ? static_cast<std::uint64_t>(info.f_bavail) * info.f_frsize : 0;
  const std::set<std::string> dead = DeadFiles({}, folder);
  const std::string left =
      dead.empty() ? ""
                   : fmt::format("{} file{} of dead processes of yours ({:.0f} MB) there: rodeira doctor --clean",
                                 dead.size(), dead.size() == 1 ? "" : "s", MegabytesOf(dead, folder));
  const std::string found =
      fmt::format("{} has {:.0f} MB free", where, static_cast<double>(free_bytes) / kBytesPerMegabyte);
  if (free_bytes < wanted_bytes) {
    const std::uint32_t segment_kib = SegmentThatFits(free_bytes, kProcesses);
    return Warning("system.little_shared_memory", check,
                   fmt::format("{}; at least {:.0f} MB were expected: a run of {} processes uses {} instead; {}", found,
                               static_cast<double>(wanted_bytes) / kBytesPerMegabyte, kProcesses,
                               segment_kib == 0 ? "UDP" : fmt::format("segments of {} KiB", segment_kib),
                               left.empty() ? fmt::format("sudo mount -o remount,size=512M {}", where) : left));
  }
  if (!left.empty()) return Warning("system.left_over_files", check, fmt::format("{}; {}", found, left));
  return Ok(check, found);
}

Finding CheckPorts(std::uint32_t domain) {
  std::vector<int> taken;
  const std::vector<int> ports = PortsOf(domain);
  for (const int port : ports) {
    if (!dds::UdpPortIsFree(port)) taken.push_back(port);
  }
  if (taken.empty())
    return Ok("ports", fmt::format("UDP {} to {} (domain {}) are free", ports.front(), ports.back(), domain));
  return Warning("system.used_port", "ports",
                 fmt::format("UDP {} (domain {}) {} taken by another program, maybe of the same domain; where "
                             "that is not wanted, choose another --domain",
                             fmt::join(taken, ", "), domain, taken.size() == 1 ? "is" : "are"));
}

Finding CheckLoopBackInterface(const std::vector<std::string>& addresses) {
  const std::string check = "loop-back";
  if (std::ranges::find(addresses, "127.0.0.1") != addresses.end()) return Ok(check, "127.0.0.1 is up");
  return Warning("system.no_loop_back", check,
                 "no running interface has the address 127.0.0.1, which runs with recovery: restart and UDP on one PC "
                 "need: sudo ip link set lo up");
}

Finding CheckLoopBack(const LoopBackSettings& given) {
  LoopBackSettings settings = given;
  const bool shared = settings.transport == launch::Transport::kSharedMemory;
  const std::string check = shared ? "DDS shared memory" : "DDS udp";
  if (const auto free_bytes = dds::FreeSharedMemory(); shared && free_bytes) {
    settings.segment_kib = SegmentThatFits(free_bytes.value(), 2);
    if (settings.segment_kib == 0)
      return Warning("system.little_shared_memory", check,
                     "not measured: shared memory has no room for two processes; runs use UDP");
  }
  const auto measured = MeasureLoopBack(settings);
  if (!measured) {
    return Fault("system.no_dds", check,
                 fmt::format("{}; {}", measured.error().Text(),
                             shared ? "look at 'shared memory' above, or use transport: udp"
                                    : "is the loop-back interface up (ip link show lo), does a firewall drop UDP?"));
  }
  return Ok(check, fmt::format("{} round trips between two processes, a batch of four ground points each: median "
                               "{:.0f} us, 99 of 100 within {:.0f} us",
                               settings.round_trips, measured.value().median_us, measured.value().worst_percent_us));
}

}  // namespace rodeira::cli
