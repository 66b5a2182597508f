// A scenario between processes: its events are recorded at their steps, and the run is the same however it is run.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <map>

#include "common/base/files.hpp"
#include "common/record/mcap_reader.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "tests/system/command.hpp"

namespace rodeira::system_test {
namespace {

class ScenarioRun : public ::testing::Test {
 protected:
  ScenarioRun() { std::filesystem::create_directories(folder_); }
  ~ScenarioRun() override { std::filesystem::remove_all(folder_); }
  std::string Path(const std::string& name) const { return (folder_ / name).string(); }
  static Ended Run(std::vector<std::string> more) {
    more.insert(more.begin(), {Bin("rodeira"), "run", LaunchFile("car_ahead.yaml")});
    return RunCommand(more);
  }
  const std::filesystem::path folder_ = std::filesystem::temp_directory_path() / ("rodeira-story-" + std::to_string(::getpid()));
};

TEST_F(ScenarioRun, IsRecordedAtItsStepsAndTheSameHoweverItRuns) {
  const Ended first = Run({"--for", "8", "--record", Path("a.mcap")});
  ASSERT_EQ(first.status, 0) << first.out;
  const Ended second = Run({"--for", "8", "--record", Path("b.mcap"), "--in-process"});
  ASSERT_EQ(second.status, 0) << second.out;
  EXPECT_EQ(DigestIn(first.out), DigestIn(second.out));
  const auto reader = record::McapReader::Open(Path("a.mcap"));
  ASSERT_TRUE(reader.ok()) << reader.error().Text();
  record::Query query;
  query.channels = std::set<record::ChannelId>{reader.value().ChannelsOf(idl::topics::kScenarioEvents).at(0)};
  auto cursor = reader.value().Messages(query);
  std::map<std::int64_t, std::string> events;
  std::size_t samples = 0;
  for (;;) {
    const auto message = cursor.Next();
    ASSERT_TRUE(message.ok());
    if (!message.value()) break;
    ++samples;
    const auto sample = idl::Decode<msg::ScenarioEvents>(message.value()->data).value();
    for (const auto& event : sample.events()) events[sample.header().step()] += event.name() + " " + event.argument() + ";";
  }
  EXPECT_EQ(samples, 801u) << "one a period, empty ones too";
  EXPECT_EQ(events, (std::map<std::int64_t, std::string>{{1000, "mark instruction: follow the car in front;"},
                                                         {6000, "traffic.speed ahead;"}}));
}

TEST_F(ScenarioRun, AWrongFileIsOneSentenceAndStatusTwo) {
  const std::string text = "rodeira: scenario/1\nevents:\n  - {at_s: 2.0005, name: mark, text: x}\n";
  ASSERT_TRUE(base::WriteWhole(Path("story.yaml"), std::string_view(text)).ok());
  const Ended ended = Run({"--set", "nodes.story.config.scenario=" + Path("story.yaml"), "--record", Path("never.mcap")});
  EXPECT_EQ(ended.status, 2) << ended.out;
  EXPECT_NE(
      ended.out.find("story.yaml:3: 'at_s' is 2.0005; a multiple of the scenario's period of 0.01 s was expected, 2 or 2.01"),
      std::string::npos)
      << ended.out;
}

}  // namespace
}  // namespace rodeira::system_test
