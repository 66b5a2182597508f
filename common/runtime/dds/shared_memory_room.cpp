// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/shared_memory_room.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <string>

namespace rodeira::dds {
namespace {

constexpr std::uint64_t kKib = 1024;
// Measured with Fast DDS 2.9.1: a segment's file is 193 KiB larger than its size (512 to 8192 KiB); a port of 4096
// messages has 122 KiB, and a process makes two and its share of the common ones.
constexpr std::uint64_t kSegmentOverheadKib = 196, kPortsKib = 3 * 128;

std::uint64_t SegmentFileBytes(std::uint32_t segment_kib) { return (segment_kib + kSegmentOverheadKib) * kKib; }

base::Error NoRoom(const std::filesystem::path& folder, const std::string& why) {
  return base::Failed("dds.shared_memory_full",
                      fmt::format("shared memory is full: {}; sudo mount -o remount,size=512M {}, or "
                                  "transport: udp",
                                  why, folder.string()),
                      folder.string());
}

// Name of the segment in a line of /proc/self/maps: fastrtps_ and 16 hexadecimal digits.
std::optional<std::string> SegmentIn(const std::string& line) {
  const std::string prefix = kSharedMemoryFolder.string() + "/fastrtps_";
  const auto at = line.find(prefix);
  if (at == std::string::npos) return std::nullopt;
  const std::string id = line.substr(at + prefix.size());
  if (id.size() != 16) return std::nullopt;
  for (const char digit : id) {
    if (std::isxdigit(static_cast<unsigned char>(digit)) == 0) return std::nullopt;
  }
  return line.substr(at);
}

}  // namespace

std::uint64_t SharedMemoryNeed(std::uint32_t segment_kib) { return SegmentFileBytes(segment_kib) + kPortsKib * kKib; }

base::Result<std::uint64_t> FreeSharedMemory(const std::filesystem::path& folder) {
  struct statvfs info {};
  if (::statvfs(folder.c_str(), &info) != 0) return NoRoom(folder, std::strerror(errno));
  return static_cast<std::uint64_t>(info.f_bavail) * info.f_frsize;
}

base::Status CheckSpace(std::uint64_t bytes, const std::filesystem::path& folder) {
  const auto free_bytes = FreeSharedMemory(folder);
  if (!free_bytes) return free_bytes.error();
  if (free_bytes.value() >= bytes) return {};
  return NoRoom(folder, fmt::format("{:.1f} MB are free, {:.1f} MB were expected",
                                    static_cast<double>(free_bytes.value()) * 1e-6, static_cast<double>(bytes) * 1e-6));
}

base::Status TryRoom(std::uint64_t bytes, const std::filesystem::path& folder) {
  if (auto status = CheckSpace(bytes, folder); !status) return status;
  const int file = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (file < 0) return NoRoom(folder, std::strerror(errno));
  const int problem = ::posix_fallocate(file, 0, static_cast<off_t>(bytes));
  ::close(file);
  if (problem != 0) return NoRoom(folder, std::strerror(problem));
  return {};
}

base::Status ClaimOwnSegment() {
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    const auto segment = SegmentIn(line);
    if (!segment) continue;
    const int file = ::open(segment->c_str(), O_RDWR | O_CLOEXEC);
    if (file < 0) continue;  // of another process, which has gone
    struct stat found {};
    const int problem = ::fstat(file, &found) == 0 ? ::posix_fallocate(file, 0, found.st_size) : errno;
    ::close(file);
    if (problem == ENOSPC) return NoRoom(kSharedMemoryFolder, std::strerror(problem));
  }
  return {};
}

base::Status CheckAddressSpace(std::uint32_t segment_kib) {
  const std::size_t bytes = SegmentFileBytes(segment_kib);
  void* const place = ::mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (place != MAP_FAILED) {
    ::munmap(place, bytes);
    return {};
  }
  return base::Failed("system.no_memory",
                      fmt::format("the memory that this program may use is exhausted (ulimit -v): it cannot map the "
                                  "{:.1f} MB of shared memory of another process of the run; raise the limit, or "
                                  "transport: udp",
                                  static_cast<double>(bytes) * 1e-6));
}

}  // namespace rodeira::dds
