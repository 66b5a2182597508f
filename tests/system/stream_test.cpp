// SPDX-License-Identifier: Apache-2.0
// One launch file, ten runs: in one process, message by message in a drawn order with losses, as processes beside
// programs that leave them no processor, and on two PCs with a network that delays and overtakes. One stream of
// digests.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <random>
#include <thread>
#include <tuple>

#include "common/runtime/launch/launch.hpp"
#include "common/runtime/lockstep/in_process.hpp"
#include "common/runtime/replay/recorded_node.hpp"
#include "launch/rodeira/run/local_nodes.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/setting.hpp"
#include "tests/system/command.hpp"
#include "tests/system/load.hpp"
#include "tests/system/recording.hpp"
#include "tests/system/rig.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;

// Four nodes, all to all, at three rates.
constexpr const char* kLaunch =
    "rodeira: launch/1\nnodes:\n  a: {kind: empty, host: left}\n  b: {kind: empty, host: right, period_s: 0.002}\n"
    "  c: {kind: empty, host: right, period_s: 0.003}\n  d: {kind: empty}\n  recorder: {kind: recorder}\n"
    "limits: {silence_s: 30, step_s: 30}\n";  // a machine under load, for a long time

bool Earlier(const Recorded& a, const Recorded& b) { return std::tie(a.step, a.source) < std::tie(b.step, b.source); }

// RODEIRA_STREAM_STEPS says how many steps; RODEIRA_STREAM_SEED repeats the drawn orders.
class Streams : public ::testing::Test {
 protected:
  Streams()
      : steps_(static_cast<lockstep::Step>(Setting("RODEIRA_STREAM_STEPS", 400))),
        seed_(Setting("RODEIRA_STREAM_SEED", std::random_device()())) {
    fmt::print("RODEIRA_STREAM_SEED={}\n", seed_);
  }
  std::string File(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string Seconds() const { return fmt::format("{:.3f}", static_cast<double>(steps_) * 1e-3); }
  std::chrono::milliseconds Patience() const { return 60s + 20ms * steps_; }

  static std::vector<Recorded> Ordered(std::vector<Recorded> samples) {
    std::erase_if(samples, [](const Recorded& sample) { return sample.topic == lockstep::kSnapshotTopic; });
    std::ranges::stable_sort(samples, Earlier);
    return samples;
  }
  void ExpectTheSame(const std::vector<Recorded>& samples, const std::string& which) {
    fmt::print("{}\n", which);
    if (stream_.empty()) stream_ = samples;
    EXPECT_GE(samples.size(), static_cast<std::size_t>(2 * steps_)) << which;
    EXPECT_EQ(FirstDifference(samples, stream_), "") << which;
  }
  // On this PC, as processes or in one.
  void RunHere(const std::string& which, const std::vector<std::string>& more) {
    const std::string recording = File("here.mcap");
    std::vector<std::string> command{Bin("rodeira"), "run", launch_, "--for", Seconds(), "--record", recording};
    command.insert(command.end(), more.begin(), more.end());
    const Ended ended = Started(command).Wait(Patience());
    ASSERT_EQ(ended.status, 0) << which << "\n" << ended.out;
    ExpectTheSame(Ordered(SamplesOf(recording)), which);
    std::filesystem::remove(recording);
  }
  // Every choice is drawn: which node runs next, which message arrives, twice, late or never.
  void RunDrawn(std::uint64_t seed) {
    const auto launch = launch::Launch::Load(launch_);
    ASSERT_TRUE(launch.ok()) << launch.error().Text();
    const auto& roster = launch.value().roster();
    auto nodes = cli::LocalNodes::Make(launch.value(), [&](lockstep::NodeIndex n) {
      return roster.node(n).is_sink() ? replay::MakeNullSink() : nullptr;
    });
    ASSERT_TRUE(nodes.ok()) << nodes.error().Text();
    std::vector<Recorded> samples;
    lockstep::InProcessSettings settings;
    settings.last_step = steps_;
    settings.loss = 0.05;
    settings.on_sample = [&](const lockstep::Sample& sample) {
      const auto& source = roster.source(sample.source());
      samples.push_back(
          {source.topic, sample.source(), sample.valid(), base::Hash(*sample.payload), sample.header.state_digest});
    };
    const auto outcome = lockstep::RunShuffled(roster, nodes.value().nodes(), settings, seed);
    ASSERT_TRUE(outcome.ok) << outcome.fault;
    samples = Ordered(std::move(samples));
    std::erase_if(samples, [&](const Recorded& sample) { return sample.step > steps_; });
    ExpectTheSame(samples, fmt::format("in one process, drawn from {}", seed));
  }
  void RunOnTwoPcs(const std::string& which, const Weather& weather) {
    const Rig rig(2, weather);
    if (!rig.problem().empty()) GTEST_SKIP() << rig.problem();
    const std::string lab = folder_.Write("lab.yaml", Rig::Laboratory(2, "{kind: peers}")).string();
    const std::string recording = File("two.mcap");
    const auto command = [&](int host) {
      return std::vector<std::string>{Bin("rodeira"), "run", launch_, "--lab", lab, "--host", Rig::Name(host)};
    };
    auto recorded = command(0);
    recorded.insert(recorded.end(), {"--record", recording, "--for", Seconds()});
    Started left(rig.On(0, recorded)), right(rig.On(1, command(1)));
    const Ended here = left.Wait(Patience()), there = right.Wait(10s);
    ASSERT_EQ(here.status, 0) << which << "\n" << here.out;
    EXPECT_EQ(there.status, 0) << which << "\n" << there.out;
    EXPECT_GT(rig.hub().passed(), static_cast<std::uint64_t>(steps_)) << "it went over the network";
    ExpectTheSame(Ordered(SamplesOf(recording)), which);
    std::filesystem::remove(recording);
  }

  const lockstep::Step steps_;
  const std::uint64_t seed_;
  const cli::TemporaryFolder folder_;
  const std::string launch_ = folder_.Write("launch.yaml", kLaunch).string();
  std::vector<Recorded> stream_;  // of the first run
};

TEST_F(Streams, TenRunsOnOneAndTwoPcsAreOneStreamOfDigests) {
  SCOPED_TRACE(fmt::format("RODEIRA_STREAM_SEED={}", seed_));
  const unsigned cores = std::thread::hardware_concurrency();
  RunHere("in one process", {"--in-process"});
  RunDrawn(seed_);
  RunDrawn(seed_ + 1);
  RunHere("processes", {});
  {
    const CpuLoad load(cores);
    RunHere("processes under load", {});
    RunHere("processes over UDP under load", {"--set", "transport=udp"});
    if (HasFailure()) return;
    RunOnTwoPcs("two PCs under load", {});
  }
  RunOnTwoPcs("two PCs, 0.3 ms of jitter", {0.0, 300us, true});
  RunOnTwoPcs("two PCs, 1 ms of jitter without multicast", {0.0, 1000us, false});
  RunOnTwoPcs("two PCs, 0.3 ms of jitter and 1 % loss", {0.01, 300us, false});
}

}  // namespace
}  // namespace rodeira::system_test
