// SPDX-License-Identifier: Apache-2.0
// Programs of another DDS, with `transport: {observers: udp}`: one that uses CycloneDDS reads every topic of a run and
// asks the ground server (tests/system/cyclone/cyclone_observer.c).
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <filesystem>
#include <sstream>

#include "common/runtime/dds/participant.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/system/command.hpp"
#include "tests/tree.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;
using ::testing::Not;

struct Meeting {
  std::uint32_t domain;
  std::string run;
};
// On N222.
constexpr double kX_m = 120.5, kY_m = -3.25;

class Cyclone : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(Bin("rodeira-test-cyclone-observer")))
      GTEST_SKIP() << "built without CycloneDDS (packages cyclonedds-dev and cyclonedds-tools)";
  }
  // Every process of the run, and the observer, on the loop-back interface.
  std::vector<std::string> Run(const Meeting& meeting, const std::string& transport) const {
    return {
        Bin("rodeira"),
        "run",
        LaunchFile("demo.yaml"),
        "--run",
        meeting.run,
        "--domain",
        std::to_string(meeting.domain),
        "--for",
        "1000",
        "--pace",
        "real",
        "--record",
        (folder_.path() / "a.mcap").string(),
        "--set",
        "transport=" + transport,
        "--set",
        "discovery={interface: 127.0.0.1}",
        "--set",
        "nodes.view.kind=none",
        "--set",
        "nodes.ego.config.ground=remote",
        "--set",
        "vehicle.model=multibody",
        "--set",
        "nodes.ego.outputs=[joint_forces]",
        "--set",
        "nodes.traffic.outputs=[traffic_answers]",
        "--set",
        "nodes.control={kind: external, program: \"" + Bin("rodeira-test-traffic-control") + "\", manifest: \"" +
            SourceDir() + "/examples/own_traffic_control/control.yaml\", config: {light: none}}",
        "--set",
        "nodes.pulse={kind: empty}",
        "--set",
        "nodes.gauge={kind: measures}",
        "--set",
        "nodes.story={kind: scenario, config: {scenario: " + SourceDir() + "/configs/scenarios/rain_at_dusk.yaml}}"};
  }
  static std::vector<std::string> Observer(const Meeting& meeting) {
    return {
        "CYCLONEDDS_URI=<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"lo\" multicast=\"true\"/>"
        "</Interfaces></General></Domain></CycloneDDS>",
        Bin("rodeira-test-cyclone-observer"),
        std::to_string(meeting.domain),
        meeting.run,
        fmt::format("{}", kX_m),
        fmt::format("{}", kY_m)};
  }
  const cli::TemporaryFolder folder_;
};

// Topics on which a run without windows and losses publishes nothing: a participant as any node's does.
class OtherTopics {
 public:
  explicit OtherTopics(const Meeting& meeting) {
    dds::DomainSettings settings;
    settings.domain = meeting.domain;
    settings.run = meeting.run;
    settings.name = "a window";
    settings.discovery.interface = "127.0.0.1";
    settings.has_observers = true;
    participant_ = dds::Participant::Open(settings).value();
    for (const std::string_view topic :
         {idl::topics::kNack, idl::topics::kRetransmissions, idl::topics::kWindowKeys, idl::topics::kOperatorRequests})
      writers_.push_back(participant_->MakeWriter(topic, dds::Delivery::kBestEffortRepeated).value());
  }
  // Of no roster and for no consumer: the run passes them over.
  void Write() {
    msg::SampleBatch batch;
    batch.consumer(1'000'000);
    EXPECT_TRUE(writers_[0]->Write(idl::Encode(msg::Nack())).ok());
    EXPECT_TRUE(writers_[1]->Write(idl::Encode(batch)).ok());
    EXPECT_TRUE(writers_[2]->Write(idl::Encode(msg::WindowKeys())).ok());
    EXPECT_TRUE(writers_[3]->Write(idl::Encode(msg::OperatorRequests())).ok());
  }

 private:
  std::unique_ptr<dds::Participant> participant_;
  std::vector<std::unique_ptr<dds::Writer>> writers_;
};

// The number behind "KEY: " in `rodeira world query`.
double QueriedHeight() {
  const Ended ended = RunCommand({Bin("rodeira"), "world", "query", SourceDir() + "/configs/worlds/n222.yaml",
                                  fmt::format("{}", kX_m), fmt::format("{}", kY_m)});
  const auto at = ended.out.find("z_m: ");
  EXPECT_NE(at, std::string::npos) << ended.out;
  return at == std::string::npos ? 0.0 : std::stod(ended.out.substr(at + 5));
}

TEST_F(Cyclone, AProgramOfAnotherDdsReadsEveryTopicAndAsksForAHeight) {
  const Meeting meeting{216, "cyclone"};
  Started run(Run(meeting, "{observers: udp}"));
  ASSERT_TRUE(Runs(meeting.run));
  Started observer(Observer(meeting));
  OtherTopics others(meeting);
  std::chrono::milliseconds told{-1};
  for (int i = 0; i < 300 && told.count() < 0; ++i) {
    others.Write();
    told = observer.WaitFor("all\n", 100ms);
  }
  EXPECT_GE(told.count(), 0) << "not within 30 s";
  ASSERT_EQ(RunCommand({Bin("rodeira"), "ctl", "stop", "--run", meeting.run}).status, 0);
  const Ended ended = run.Wait();
  EXPECT_EQ(ended.status, 0) << ended.out;
  ::kill(observer.pid(), SIGTERM);
  const std::string said = observer.Wait().out;
  for (const idl::TopicInfo& topic : idl::Topics()) {
    if (topic.topic == idl::topics::kWallTime || topic.topic == idl::topics::kRemarks) continue;  // in recordings only
    EXPECT_THAT(said, HasSubstr(fmt::format("read {}", topic.topic)));
  }
  const auto at = said.find("height ");
  ASSERT_NE(at, std::string::npos) << said;
  EXPECT_NEAR(std::stod(said.substr(at + 7)), QueriedHeight(), 5e-7) << "SUELO is one function of the world";
}

TEST_F(Cyclone, WithoutObserversNothingLeavesSharedMemory) {
  const Meeting meeting{215, "cyclone-unseen"};
  Started run(Run(meeting, "shared_memory"));
  ASSERT_TRUE(Runs(meeting.run));
  Started observer(Observer(meeting));
  EXPECT_LT(observer.WaitFor("read ", 3s).count(), 0);
}

}  // namespace
}  // namespace rodeira::system_test
