// SPDX-License-Identifier: Apache-2.0
#include "nodes/empty/sudden_end.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <vector>

#include "common/core/base/assert.hpp"

namespace rodeira::nodes {
namespace {

// Address space beyond what the process has mapped: enough for a library, too little to go on for long.
constexpr std::uint64_t kRoom_bytes = std::uint64_t{64} << 20;
constexpr std::size_t kPiece_bytes = std::size_t{1} << 20;

// Bytes of this process's address space (proc(5), statm).
std::uint64_t AddressSpace_bytes() {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

// Until a control group's limit is reached, but at most 2 GiB.
void FillMemory() {
  std::vector<std::unique_ptr<char[]>> pieces(2048);
  for (auto& piece : pieces) {
    piece = std::make_unique<char[]>(kPiece_bytes);
    std::memset(piece.get(), 1, kPiece_bytes);
  }
}

[[noreturn]] void RunOutOfMemory() {
  const rlimit limit{AddressSpace_bytes() + kRoom_bytes, AddressSpace_bytes() + kRoom_bytes};
  RODEIRA_ASSERT(::setrlimit(RLIMIT_AS, &limit) == 0);
  std::vector<std::unique_ptr<char[]>> pieces;
  for (;;) {
    pieces.push_back(std::make_unique<char[]>(kPiece_bytes));
    std::memset(pieces.back().get(), 1, kPiece_bytes);
  }
}

}  // namespace

SuddenEnd SuddenEnd::Read(const config::Map& config) {
  SuddenEnd end;
  end.step_ = config.Integer("end_at_step", -1, INT64_MAX, -1);
  end.cause_ = config.Choice(
      "end_by", {"failure", "exit_0", "exit_1", "exception", "assertion", "memory", "memory_of_group"}, "failure");
  end.once_ = config.Text("end_once", "");
  return end;
}

base::Status SuddenEnd::At(lockstep::Step step) const {
  if (step != step_ || !IsFirst()) return {};
  if (cause_ == "exit_0") std::_Exit(0);
  if (cause_ == "exit_1") std::_Exit(1);
  if (cause_ == "exception") throw std::runtime_error("told to throw here by its configuration (end_by)");
  if (cause_ == "memory") RunOutOfMemory();
  if (cause_ == "memory_of_group") FillMemory();
  RODEIRA_ASSERT(cause_ != "assertion");
  return base::Failed("node.told_to_fail", "told to fail here by its configuration (end_by)");
}

bool SuddenEnd::IsFirst() const {
  if (once_.empty()) return true;
  const int made = ::open(once_.c_str(), O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (made >= 0) ::close(made);
  return made >= 0;
}

}  // namespace rodeira::nodes
