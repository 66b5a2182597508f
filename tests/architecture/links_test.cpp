// SPDX-License-Identifier: Apache-2.0
// The shared libraries that the light programs need. cmake/RodeiraLayers.cmake checks static libraries.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/system/command.hpp"

namespace rodeira {
namespace {

using system_test::Bin;
using system_test::RunCommand;
using system_test::Started;
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

TEST(Links, NodeProgramsMapFewSharedObjects) {
  const std::vector<std::pair<std::string, long>> programs = {
      {"rodeira", 40}, {"rodeira-clock", 40}, {"rodeira-recorder", 40}, {"rodeira-vehicle", 40}};
  for (const auto& [program, most] : programs) {
    const auto ended = RunCommand({"/usr/bin/env", "LD_TRACE_LOADED_OBJECTS=1", Bin(program)});
    ASSERT_EQ(ended.status, 0) << ended.out;
    ASSERT_THAT(ended.out, HasSubstr("libc.so")) << program;
    EXPECT_LE(std::count(ended.out.begin(), ended.out.end(), '\n'), most) << program << "\n" << ended.out;
    for (const char* library : {"libgdal", "libproj"}) EXPECT_THAT(ended.out, Not(HasSubstr(library))) << program;
  }
}

// The shared objects that are mapped into a process.
std::set<std::string> SharedObjectsOf(pid_t process) {
  std::set<std::string> objects;
  std::ifstream maps("/proc/" + std::to_string(process) + "/maps");
  for (std::string line; std::getline(maps, line);) {
    const auto path = line.find('/');
    if (path != std::string::npos && line.find(".so", path) != std::string::npos) objects.insert(line.substr(path));
  }
  return objects;
}

TEST(Links, AVehicleOnN222MapsFewSharedObjects) {
  Started run({Bin("rodeira"), "run", system_test::LaunchFile("first_drive.yaml"), "--no-record", "--for", "1000",
               "--pace", "real", "--set", "world=" + system_test::LaunchFile("../configs/worlds/n222.yaml"), "--run",
               "fewobjects"});
  ASSERT_TRUE(system_test::Runs("fewobjects"));
  const auto vehicles = system_test::ProcessesWith("--run fewobjects", "--node ego");
  ASSERT_EQ(vehicles.size(), 1u);
  const std::set<std::string> objects = SharedObjectsOf(vehicles.front());
  ::kill(run.pid(), SIGINT);
  EXPECT_EQ(run.Wait().status, 0);
  EXPECT_THAT(objects, testing::Contains(HasSubstr("/libc.so")));
  EXPECT_LE(objects.size(), 40u) << testing::PrintToString(objects);
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
