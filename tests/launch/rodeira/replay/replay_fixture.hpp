// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/data/record/mcap_reader.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "launch/rodeira/replay/verify.hpp"
#include "tests/launch/rodeira/replay/copied_recording.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/system/command.hpp"

namespace rodeira::cli {

using system_test::Bin;
using system_test::LaunchFile;
using system_test::RunCommand;

// Short runs in one process, recorded in a folder of the test's own.
class ReplayTest : public ::testing::Test {
 protected:
  std::string Record(const std::string& name, const std::string& launch, std::vector<std::string> more) {
    const std::string file = (folder_.path() / name).string();
    std::vector<std::string> command{Bin("rodeira"), "run", launch, "--in-process", "--record", file};
    command.insert(command.end(), more.begin(), more.end());
    const auto ended = RunCommand(command);
    EXPECT_EQ(ended.status, 0) << ended.out;
    return file;
  }
  std::string Drive(double seconds = 3.0) {
    return Record("drive.mcap", LaunchFile("first_drive.yaml"), {"--for", std::to_string(seconds)});
  }

  static base::Result<VerifyResult> VerifyFile(const std::string& file, lockstep::Step from = 0,
                                               const launch::Overrides& extra = {}) {
    const auto run = replay::RecordedRun::Open(file, extra);
    if (!run) return run.error();
    return Verify(run.value(), from);
  }

  // A copy of the recording, its metadata and messages changed on the way; a message for which `keep` says no is left
  // out.
  std::string Copied(
      const std::string& file, const Entries& change, const Keep& keep,
      const KeepFile& keep_file = [](const std::string&) { return true; }) {
    const std::string copy = (folder_.path() / "copied.mcap").string();
    CopyRecording(file, copy, change, keep, keep_file);
    return copy;
  }
  // With one bit of one message turned.
  std::string WithABitTurned(const std::string& file, const std::string& topic, std::uint64_t message_number,
                             std::size_t byte) {
    std::uint64_t seen = 0;
    return Copied(
        file, [](const std::string&, record::TextMap&) {},
        [&](const std::string& on, const record::Message&, base::Bytes& data) {
          if (on == topic && seen++ == message_number) data[byte] ^= std::byte{1};
          return true;
        });
  }
  // The car's published state at a step.
  static msg::VehicleState CarAt(const replay::RecordedRun& run, lockstep::Step step) {
    auto samples = run.Samples(step);
    for (auto next = samples.Next(); next.ok() && next.value(); next = samples.Next()) {
      if (next.value()->valid() != step ||
          run.roster().source(next.value()->source()).topic != idl::topics::kVehicleState)
        continue;
      return idl::Decode<msg::VehicleState>(*next.value()->payload).value();
    }
    ADD_FAILURE() << "no car at step " << step;
    return {};
  }

  TemporaryFolder folder_;
};

}  // namespace rodeira::cli
