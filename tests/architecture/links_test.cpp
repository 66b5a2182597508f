// SPDX-License-Identifier: Apache-2.0
// The shared libraries that the light programs need. cmake/RodeiraLayers.cmake checks static libraries.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "tests/system/command.hpp"

namespace rodeira {
namespace {

using system_test::Bin;
using system_test::RunCommand;
using testing::HasSubstr;
using testing::Not;

std::string NeededBy(const std::string& program) {
  const auto ended = RunCommand({"/usr/bin/env", "readelf", "--wide", "--dynamic", Bin(program)});
  EXPECT_EQ(ended.status, 0) << ended.out;
  EXPECT_THAT(ended.out, HasSubstr("[libc.so")) << program;
  return ended.out;
}

TEST(Links, FrontDoorClockAndRecorderDrawNothing) {
  for (const char* program : {"rodeira", "rodeira-clock", "rodeira-recorder"}) {
    const std::string needed = NeededBy(program);
    for (const char* library : {"[libosg", "[libOpenThreads", "[libSDL2", "[libGL", "[libEGL", "[libOpenGL", "[libpng",
                                "[libX11", "[libopenxr"})
      EXPECT_THAT(needed, Not(HasSubstr(library))) << program;
  }
}

TEST(Links, ClockAndRecorderReadNoMaps) {
  for (const char* program : {"rodeira-clock", "rodeira-recorder"}) {
    const std::string needed = NeededBy(program);
    for (const char* library : {"[libgdal", "[libproj", "[libgeos"})
      EXPECT_THAT(needed, Not(HasSubstr(library))) << program;
  }
}

// Thread-local storage is taken from every thread's stack: SDL's audio thread has 64 kB in all.
TEST(Links, ThreadLocalStorageIsSmall) {
  for (const char* program : {"rodeira", "rodeira-vehicle", "rodeira-view", "rodeira-graphics"}) {
    if (!std::filesystem::exists(Bin(program))) continue;  // built without the view
    const auto ended = RunCommand({"/usr/bin/env", "readelf", "--wide", "--segments", Bin(program)});
    ASSERT_EQ(ended.status, 0) << ended.out;
    std::istringstream lines(ended.out);
    bool found = false;
    for (std::string word; lines >> word;) {
      if (word != "TLS") continue;
      std::string offset, address, physical, in_file, in_memory;
      lines >> offset >> address >> physical >> in_file >> in_memory;
      EXPECT_LE(std::stoul(in_memory, nullptr, 16), 8192u) << program;
      found = true;
      break;
    }
    EXPECT_TRUE(found) << program;
  }
}

}  // namespace
}  // namespace rodeira
