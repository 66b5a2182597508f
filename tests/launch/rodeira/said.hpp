// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>

namespace rodeira::cli {

// What a command of the front door answers, and prints to both of its streams.
struct Said {
  int status;
  std::string out;
  std::string errors;
};

template <class Options>
Said SaidBy(int (*command)(const Options&), const Options& options) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const int status = command(options);
  return {status, testing::internal::GetCapturedStdout(), testing::internal::GetCapturedStderr()};
}

}  // namespace rodeira::cli
