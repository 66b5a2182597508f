// SPDX-License-Identifier: Apache-2.0
// Law L7: the same bits on every x86-64 processor. An emulator plays those that are not at hand: one of 2006 without
// AVX, one with AVX2 and FMA, another maker's.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/long_form.hpp"
#include "tests/system/command.hpp"

namespace rodeira {
namespace {

using system_test::Bin;
using system_test::RunCommand;

const std::string kEmulator = "/usr/bin/qemu-x86_64";
// What a program sets itself before it begins again (common/core/base/mathematics.cpp); beginning again would leave the
// emulator.
const std::string kFixed = "GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2";

class Processors : public ::testing::Test {
 protected:
  void SetUp() override {
    if (::access(kEmulator.c_str(), X_OK) != 0)
      GTEST_SKIP() << "no emulator plays other processors here: " << kEmulator << " is missing (package qemu-user)";
  }
  // On this processor where none is named.
  static std::string OutputOf(const std::string& processor, const std::vector<std::string>& environment,
                              const std::vector<std::string>& program) {
    std::vector<std::string> command = environment;
    if (!processor.empty()) command.insert(command.end(), {kEmulator, "-cpu", processor});
    command.insert(command.end(), program.begin(), program.end());
    const auto ended = RunCommand(command);
    EXPECT_EQ(ended.status, 0) << ended.out;
    return ended.out;
  }
  static std::string RunDigest(const std::string& processor, const std::string& model) {
    return system_test::DigestIn(
        OutputOf(processor, {kFixed},
                 {Bin("rodeira"), "run", system_test::LaunchFile("first_drive.yaml"), "--in-process", "--no-record",
                  "--for", BriefOrLong<std::string>("0.3", "1"), "--set", "vehicle.model=" + model}));
  }
};

TEST_F(Processors, ComputeTheSameRun) {
  for (const char* model : {"multibody", "ode"}) {
    const std::string here = RunDigest("", model);
    ASSERT_EQ(here.size(), 16u);
    for (const char* processor : {"Conroe", "Haswell"})
      EXPECT_EQ(RunDigest(processor, model), here) << model << " on " << processor;
  }
  EXPECT_EQ(RunDigest("EPYC", "bicycle"), RunDigest("", "bicycle"));
}

// The counter-example: left to itself, the mathematics library computes other bits with FMA than without.
TEST_F(Processors, WouldDifferIfTheyWereLetAlone) {
  const auto digest = [](const std::string& processor, const std::vector<std::string>& environment) {
    const std::string out = OutputOf(processor, environment, {Bin("mathematics_digest")});
    return out.substr(out.size() - std::min<std::size_t>(out.size(), 17));  // the emulator may have warned before
  };
  const std::vector<std::string> alone{"RODEIRA_TEST_KEEP_MATHEMATICS=1", "GLIBC_TUNABLES="}, fixed{kFixed};
  EXPECT_NE(digest("Conroe", alone), digest("Haswell", alone));
  EXPECT_EQ(digest("Conroe", fixed), digest("Haswell", fixed));
}

}  // namespace
}  // namespace rodeira
