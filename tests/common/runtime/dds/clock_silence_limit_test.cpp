// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/clock_silence_limit.hpp"

#include <gtest/gtest.h>

#include <string>

namespace rodeira::dds {
namespace {

using namespace std::chrono_literals;

std::chrono::milliseconds LimitOf(const std::string& keys) {
  const std::string text = "rodeira: launch/1\n" + keys + "nodes:\n  a: {kind: empty}\n";
  return ClockSilenceLimit(launch::Launch::Parse(text, "dir/a.yaml", {}).value());
}

// The table of ends says 3 s of several PCs, which exchange samples over UDP.
TEST(ClockSilenceLimit, OnOnePcANodeWaitsForAClockThatIsStartedAgain) {
  EXPECT_EQ(LimitOf(""), 3s);
  EXPECT_EQ(LimitOf("recovery: pause\n"), 3s);
  EXPECT_EQ(LimitOf("recovery: restart\n"), 9s);
  EXPECT_EQ(LimitOf("recovery: restart\ntransport: udp\n"), 3s);
}

}  // namespace
}  // namespace rodeira::dds
