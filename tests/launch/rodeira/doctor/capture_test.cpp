// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/doctor/capture.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>

namespace rodeira::cli {
namespace {

using namespace std::chrono_literals;

TEST(Capture, TakesBothOutputsAndTheStatus) {
  const Captured said = CaptureProgram({"/bin/sh", "-c", "echo one; echo two >&2; exit 3"}, 20s);
  EXPECT_EQ(said.status, 3);
  EXPECT_FALSE(said.well());
  EXPECT_EQ(said.output, "one\ntwo\n");
  EXPECT_EQ(said.FirstLine(), "one");
  EXPECT_TRUE(CaptureProgram({"/bin/sh", "-c", "exit 0"}, 20s).well());
}

TEST(Capture, WhatCannotBeStartedLeavesWith127) { EXPECT_EQ(CaptureProgram({"/no/such/program"}, 20s).status, 127); }

TEST(Capture, AProgramThatTakesTooLongIsKilled) {
  const Captured slow = CaptureProgram({"/bin/sh", "-c", "echo begun; exec sleep 1000"}, 300ms);
  EXPECT_TRUE(slow.too_late);
  EXPECT_FALSE(slow.status.has_value());
  EXPECT_EQ(slow.output, "begun\n");
  // Also one that has closed its outputs.
  EXPECT_TRUE(CaptureProgram({"/bin/sh", "-c", "exec sleep 1000 >&- 2>&-"}, 300ms).too_late);
}

TEST(Capture, ACrashIsNoStatus) {
  const Captured crashed = CaptureFork([] { return std::raise(SIGKILL); }, 20s);
  EXPECT_FALSE(crashed.status.has_value());
  EXPECT_FALSE(crashed.too_late);
}

}  // namespace
}  // namespace rodeira::cli
