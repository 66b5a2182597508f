// SPDX-License-Identifier: Apache-2.0
// The table of docs/reference/ends.md about wrong samples and wrong input: each cause under each policy, with real
// processes. Wrong samples come from this test, which publishes in the name of node `b`.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/runtime/dds/participant.hpp"
#include "common/runtime/lockstep/sample.hpp"
#include "idl/topics.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/system/command.hpp"
#include "tests/system/command_line.hpp"
#include "tests/system/ends_table.hpp"
#include "tests/tree.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;

constexpr std::array kPolicies = {"stop", "pause", "restart"};

// From the newest sample of `b` that was heard.
using MakeSample = std::function<base::Bytes(base::Bytes heard)>;

base::Bytes WithStep(base::Bytes payload, lockstep::Step step) {
  auto header = lockstep::SampleHeader::Read(payload);
  header.step = step;
  header.Write(payload);
  return payload;
}

const std::map<std::string, MakeSample> kWrongSamples = {
    {"fewer bytes than a header",
     [](base::Bytes heard) {
       heard.resize(12);
       return heard;
     }},
    {"a source that the roster does not have",
     [](base::Bytes heard) {
       auto header = lockstep::SampleHeader::Read(heard);
       header.source = 1000;
       header.Write(heard);
       return heard;
     }},
    {"a step far beyond the grant", [](base::Bytes heard) { return WithStep(std::move(heard), 1'000'000); }},
    {"another value for the same step",
     [](base::Bytes heard) {
       heard.back() ^= std::byte{1};
       return heard;
     }},
    {"a value that is cut short", [](base::Bytes heard) {
       heard.resize(heard.size() - 1);
       return WithStep(heard, lockstep::SampleHeader::Read(heard).step + 50);
     }}};
// Found by a node when it starts.
const std::map<std::string, std::vector<std::string>> kWrongInput = {
    {"a start outside of the world",
     {"--set", "world=" + SourceDir() + "/configs/worlds/n222.yaml", "--set",
      "nodes.ego.config.start={x_m: 0, y_m: 1e6}"}}};

std::vector<EndsRow> ReadRows() {
  return EndsRowsOf(
      [](const std::string& cause) { return kWrongSamples.contains(cause) || kWrongInput.contains(cause); });
}

// A program of the run's domain that is not of the run: it publishes each sample of a source again, changed.
class Intruder {
 public:
  // `is_kept`: lost parts of the run can be started again, for which its processes meet in another way.
  Intruder(const std::string& run, std::uint32_t domain, bool is_kept, lockstep::SourceIndex source, MakeSample make)
      : participant_(
            dds::Participant::Open({domain, run, "intruder", launch::Transport::kSharedMemory, {}, false, is_kept})
                .value()),
        writer_(participant_->MakeWriter(idl::topics::kPulse, dds::Delivery::kBestEffortRepeated).value()),
        source_(source),
        make_(std::move(make)),
        reader_(participant_
                    ->MakeReader(idl::topics::kPulse, dds::Delivery::kObserve,
                                 [this](base::Bytes&& heard) { Answer(std::move(heard)); })
                    .value()) {}

 private:
  void Answer(base::Bytes&& heard) {
    if (is_writing_) return;  // what it writes itself comes within the call
    if (!lockstep::SampleHeader::HasHeader(heard) || lockstep::SampleHeader::Read(heard).source != source_) return;
    is_writing_ = true;
    (void)writer_->Write(make_(std::move(heard)));
    is_writing_ = false;
  }
  std::unique_ptr<dds::Participant> participant_;
  std::unique_ptr<dds::Writer> writer_;
  const lockstep::SourceIndex source_;
  const MakeSample make_;
  bool is_writing_ = false;
  std::unique_ptr<dds::Reader> reader_;
};

class WrongSamples : public testing::TestWithParam<std::string> {
 protected:
  std::vector<std::string> Command(const std::string& name, const std::string& launch,
                                   const std::string& policy) const {
    return {Bin("rodeira"),
            "run",
            launch,
            "--run",
            name,
            "--for",
            "100",
            "--pace",
            "real",
            "--record",
            File(name),
            "--set",
            "recovery=" + policy};
  }
  std::string File(const std::string& name) const { return (folder_.path() / (name + ".mcap")).string(); }
  const cli::TemporaryFolder folder_;
};

TEST_P(WrongSamples, EndARunAsTheTableSays) {
  const std::vector<EndsRow> rows = ReadRows();
  ASSERT_EQ(rows.size(), kWrongSamples.size() + kWrongInput.size()) << "docs/reference/ends.md";
  const auto row = std::ranges::find(rows, GetParam(), &EndsRow::cause);
  ASSERT_NE(row, rows.end()) << GetParam();
  const std::string four =
      folder_
          .Write("four.yaml",
                 "rodeira: launch/1\nnodes: {a: {kind: empty}, b: {kind: empty}, c: {kind: empty}, "
                 "d: {kind: empty}, recorder: {kind: recorder}}\n")
          .string();
  constexpr lockstep::SourceIndex kB = 1;
  for (std::size_t p = 0; p < kPolicies.size(); ++p) {
    SCOPED_TRACE(kPolicies[p]);
    const std::string name = fmt::format("wrong-{}-{}", ::getpid(), kPolicies[p]);
    const auto input = kWrongInput.find(row->cause);
    const bool at_the_start = input != kWrongInput.end();
    auto command = Command(name, at_the_start ? LaunchFile("first_drive.yaml") : four, kPolicies[p]);
    if (at_the_start) command.insert(command.end(), input->second.begin(), input->second.end());
    Started run(command);
    std::unique_ptr<Intruder> intruder;
    if (!at_the_start) {
      ASSERT_TRUE(Runs(name));
      const auto clocks = ProcessesWith("--run " + name, "/rodeira-clock");
      ASSERT_EQ(clocks.size(), 1u);
      const auto domain = static_cast<std::uint32_t>(std::stoul(OptionOf(clocks.front(), "--domain")));
      intruder = std::make_unique<Intruder>(name, domain, kPolicies[p] != std::string("stop"), kB,
                                            kWrongSamples.at(row->cause));
    }
    const Ended ended = run.Wait(40s);
    EXPECT_EQ(ended.status, row->outcomes[p] == "refused" ? 2 : 1) << ended.out;
    EXPECT_NE(ended.out.find(row->message), std::string::npos) << ended.out;
    EXPECT_TRUE(ProcessesWith("--run " + name).empty());
    if (at_the_start) {
      EXPECT_FALSE(std::filesystem::exists(File(name)));
      continue;
    }
    EXPECT_EQ(RunCommand({Bin("rodeira"), "info", File(name)}).status, 0) << "the recording is not closed";
  }
}

INSTANTIATE_TEST_SUITE_P(Causes, WrongSamples,
                         testing::Values("fewer bytes than a header", "a source that the roster does not have",
                                         "a step far beyond the grant", "another value for the same step",
                                         "a value that is cut short", "a start outside of the world"),
                         [](const auto& cause) {
                           std::string name = cause.param;
                           std::erase_if(name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
                           return name;
                         });

}  // namespace
}  // namespace rodeira::system_test
