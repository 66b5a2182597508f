// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/checked_output.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <string>
#include <system_error>

#include "common/core/base/print_error.hpp"

namespace rodeira::cli {

int WithCheckedOutput(const std::function<int()>& command) {
  int status = 0;
  std::string reason;
  try {
    status = command();
    errno = 0;
    std::cout.flush();
    static_cast<void>(std::fflush(stdout));
    if (errno != 0) reason = std::strerror(errno);
  } catch (const std::system_error& problem) {  // thrown by fmt::print
    if (std::ferror(stdout) == 0) throw;
    reason = problem.code().message();
  }
  if (std::ferror(stdout) == 0) return status;
  const int failed = base::PrintError(
      "rodeira",
      base::Failed("file.cannot_write", "cannot write to standard output" + (reason.empty() ? reason : ": " + reason)));
  return status == 0 ? failed : status;
}

}  // namespace rodeira::cli
