// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/memory_kills.hpp"

#include <fstream>
#include <string>

namespace rodeira::cli {

std::uint64_t MemoryKills() {
  std::ifstream file("/proc/vmstat");
  std::string name;
  for (std::uint64_t number = 0; file >> name >> number;) {
    if (name == "oom_kill") return number;
  }
  return 0;
}

}  // namespace rodeira::cli
