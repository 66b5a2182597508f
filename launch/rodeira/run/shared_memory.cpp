// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/shared_memory.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <cctype>
#include <fstream>
#include <sstream>

#include "launch/rodeira/run/processes.hpp"

namespace rodeira::cli {
namespace {

bool IsFastDds(const std::string& name) {
  for (const char* start :
       {"fastrtps_", "sem.fastrtps_", "fast_datasharing", "sem.fast_datasharing", "fastdds_", "sem.fastdds_"}) {
    if (name.starts_with(start)) return true;
  }
  return false;
}

// Files of /dev/shm that some process uses, from its maps and its open descriptors.
std::set<std::string> InUse(const std::filesystem::path& folder) {
  std::set<std::string> used;
  std::error_code problem;
  const std::string prefix = folder.string() + "/";
  for (const auto& process : std::filesystem::directory_iterator("/proc", problem)) {
    const std::string pid = process.path().filename().string();
    if (pid.find_first_not_of("0123456789") != std::string::npos) continue;
    std::error_code closed;
    for (const auto& descriptor : std::filesystem::directory_iterator(process.path() / "fd", closed)) {
      std::error_code gone;
      const std::string target = std::filesystem::read_symlink(descriptor.path(), gone).string();
      if (!gone && target.starts_with(prefix)) used.insert(target.substr(prefix.size()));
    }
    // After the descriptors: a process that has just opened a file maps it, and then closes it.
    std::ifstream maps(process.path() / "maps");
    for (std::string line; std::getline(maps, line);) {
      const auto at = line.find(prefix);
      if (at != std::string::npos) used.insert(line.substr(at + prefix.size()));
    }
  }
  return used;
}

// What belongs to one segment or port: "fastrtps_port7410" of "sem.fastrtps_port7410_mutex" and "fastrtps_port7410_el".
std::string GroupOf(std::string name) {
  if (name.starts_with("sem.")) name.erase(0, 4);
  for (const std::string_view end : {"_mutex", "_el", "_sl"}) {
    if (name.ends_with(end)) name.erase(name.size() - end.size());
  }
  return name;
}

// The process that has locked the file by flock(2), by proc_locks(5); below 1: none, or of another container.
pid_t LockOwner(int file) {
  struct stat info {};
  if (::fstat(file, &info) != 0) return -1;
  const std::string inode = fmt::format("{:02x}:{:02x}:{}", major(info.st_dev), minor(info.st_dev), info.st_ino);
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);) {
    std::istringstream words(line);
    std::string number, kind, is_mandatory, access, place;
    pid_t owner = -1;
    words >> number >> kind >> is_mandatory >> access >> owner >> place;
    if (words && kind == "FLOCK" && place == inode) return owner;
  }
  return -1;
}

// Fast DDS locks a file beside each segment and port as long as it lives: this tells of processes too that /proc does
// not show, in a container with the same /dev/shm.
bool IsLocked(const std::filesystem::path& folder, const std::string& group) {
  return IsLockedByLiving(folder / (group + "_el")) || IsLockedByLiving(folder / (group + "_sl"));
}

}  // namespace

bool IsLockedByLiving(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool is_locked = ::flock(file, LOCK_EX | LOCK_NB) != 0;
  const pid_t owner = is_locked ? LockOwner(file) : -1;
  ::close(file);
  return is_locked && !(owner > 0 && KilledBy(owner) != 0);
}

std::set<std::string> SharedMemoryFiles(const std::filesystem::path& folder) {
  std::set<std::string> names;
  std::error_code problem;
  for (const auto& entry : std::filesystem::directory_iterator(folder, problem)) {
    const std::string name = entry.path().filename().string();
    if (IsFastDds(name)) names.insert(name);
  }
  return names;
}

std::set<std::string> DeadFiles(const std::set<std::string>& before, const std::filesystem::path& folder) {
  std::set<std::string> dead;
  for (const std::string& name : SharedMemoryFiles(folder)) {
    struct stat info {};
    if (!before.contains(name) && ::stat((folder / name).c_str(), &info) == 0 && info.st_uid == ::geteuid())
      dead.insert(name);
  }
  if (dead.empty()) return dead;
  const std::set<std::string> used = InUse(folder);
  // A port's semaphore is mapped, its lock file is only locked: they share the port's name and its fate.
  const auto in_use = [&](const std::string& name) {
    if (name.ends_with("_el") && used.contains(name.substr(0, name.size() - 3))) return true;
    const auto at = name.find("fastrtps_port");
    if (at == std::string::npos) return used.contains(name);
    const std::string port = name.substr(at, name.find_first_not_of("0123456789", at + 13) - at);
    for (const std::string& other : used) {
      const auto there = other.find(port);
      if (there != std::string::npos && !std::isdigit(static_cast<unsigned char>(other.c_str()[there + port.size()])))
        return true;
    }
    return false;
  };
  std::erase_if(dead, in_use);
  std::erase_if(dead, [&folder](const std::string& name) { return IsLocked(folder, GroupOf(name)); });
  return dead;
}

int RemoveLeftOvers(const std::set<std::string>& before, const std::filesystem::path& folder) {
  int removed = 0;
  for (const std::string& name : DeadFiles(before, folder)) {
    if (::unlink((folder / name).c_str()) == 0) ++removed;
  }
  return removed;
}

}  // namespace rodeira::cli
