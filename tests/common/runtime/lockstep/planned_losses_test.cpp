// SPDX-License-Identifier: Apache-2.0
// One to three parts of a run, nodes or the clock, are lost, by any cause, at any instant, under any policy, all drawn
// from the run's number. RODEIRA_VIRTUAL_ENDS says how many runs (2 000), RODEIRA_VIRTUAL_ENDS_SEED the number of the
// first one. RODEIRA_VIRTUAL_ENDS_FILE names a file that keeps the number of the next run: a sequence goes on where it
// ended.
#include "common/runtime/lockstep/planned_losses.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <memory>
#include <random>

#include "tests/common/runtime/lockstep/recorded.hpp"
#include "tests/setting.hpp"

namespace rodeira::lockstep {
namespace {

// A run that is drawn from its number.
class DrawnRun {
 public:
  explicit DrawnRun(std::uint64_t number) : rng_(number), roster_(law::RecordedRoster(number)) {
    disk_.seed = number;
    last_ = 20 + static_cast<Step>(rng_() % 60);
    constexpr std::array kPolicies = {Policy::kStop, Policy::kPause, Policy::kRestart, Policy::kRestart};
    policy_ = kPolicies[rng_() % kPolicies.size()];
    losses_.resize(1 + rng_() % 3);
    std::uint64_t turn = rng_() % (150 * roster_.nodes().size());
    for (PlannedLoss& loss : losses_) {
      loss.turn = turn;
      const auto part = static_cast<NodeIndex>(rng_() % (roster_.nodes().size() + 1));
      loss.node = part < roster_.nodes().size() ? part : kClock;
      loss.cause = static_cast<LossCause>(rng_() % 3);
      loss.lasts_turns = rng_() % 600;
      loss.is_found = rng_() % 2 == 0;
      turn += rng_() % (rng_() % 2 == 0 ? 20 : 800);
    }
    settings_.last_step = last_;
    settings_.loss = rng_() % 2 == 0 ? 0.0 : 0.1;
    settings_.deaths.policies.assign(roster_.nodes().size(), policy_);
    settings_.deaths.safe = [this](NodeIndex) { return disk_.safe(); };
    settings_.deaths.remake = [this](NodeIndex n) {
      InProcessSettings::Deaths::Remade remade{Make(n), -1, {}};
      if (n + 1 < roster_.nodes().size()) return remade;
      remade.has_through = disk_.safe();
      remade.tail = disk_.file;
      return remade;
    };
  }

  // What is not as promised; empty: nothing.
  std::string Difference() {
    living_.resize(roster_.nodes().size());
    std::vector<Node*> nodes;
    for (NodeIndex n = 0; n < roster_.nodes().size(); ++n) nodes.push_back(Make(n));
    const RunOutcome outcome = RunWithLosses(roster_, nodes, settings_, rng_(), losses_);
    losses_that_came_ = outcome.deaths + outcome.clocks + (outcome.ok ? 0 : 1);
    clocks_ = outcome.clocks;
    if (outcome.ok) return NotAsTheLaw(outcome);
    // Which loss comes first is the run's: a signal's effect may come after the next one.
    for (const PlannedLoss& loss : losses_) {
      if (loss.node == kClock) {
        if (outcome.fault == "the clock was killed")
          return policy_ == Policy::kRestart ? "the clock is not started again" : "";
        continue;
      }
      for (const char* how : {"was killed", "was told to end", "was stopped"}) {
        if (outcome.fault == fmt::format("node '{}' {}", roster_.node(loss.node).name, how))
          return policy_ == Policy::kRestart ? "a node is not started again" : "";
      }
    }
    return "it ends with '" + outcome.fault + "'";
  }
  std::string Text() const { return TextOf(losses_); }
  int losses() const { return losses_that_came_; }
  int clocks() const { return clocks_; }

 private:
  Node* Make(NodeIndex n) {
    if (n + 1 == roster_.nodes().size())
      living_[n] = std::make_unique<law::RecorderDouble>(disk_);
    else
      living_[n] = std::make_unique<law::Rememberer>(roster_, n);
    return living_[n].get();
  }
  // A run that came to its end: every node finished, and each sample in the file is that of the plain loop over time.
  std::string NotAsTheLaw(const RunOutcome& outcome) const {
    for (const Report& report : outcome.reports) {
      if (report.phase != Phase::kFinished) return "a node has not finished";
    }
    if (policy_ != Policy::kRestart && outcome.deaths > 0) return "a node is started again";
    std::map<std::pair<SourceIndex, Step>, std::uint64_t> recorded;
    for (const Sample& sample : disk_.file) {
      if (roster_.source(sample.source()).topic != kSnapshotTopic)
        recorded[{sample.source(), sample.valid()}] = law::ContentOf(sample);
    }
    auto reference = law::Reference(roster_, last_);
    std::erase_if(reference, [this](const auto& entry) { return entry.first.second > last_; });
    return recorded == reference ? "" : "the recording differs";
  }

  std::mt19937_64 rng_;
  const Roster roster_;
  law::Disk disk_;
  Step last_ = 0;
  Policy policy_ = Policy::kStop;
  std::vector<PlannedLoss> losses_;
  InProcessSettings settings_;
  std::vector<std::unique_ptr<Node>> living_;
  int losses_that_came_ = 0;
  int clocks_ = 0;
};

std::uint64_t FirstNumber(const char* file) {
  std::uint64_t first = Setting("RODEIRA_VIRTUAL_ENDS_SEED", 1);
  if (file != nullptr) std::ifstream(file) >> first;
  return first;
}

TEST(PlannedLosses, EveryRunEndsAsItsPolicySays) {
  const char* file = std::getenv("RODEIRA_VIRTUAL_ENDS_FILE");
  const std::uint64_t first = FirstNumber(file), runs = Setting("RODEIRA_VIRTUAL_ENDS", 2000);
  std::uint64_t losses = 0, clocks = 0;
  for (std::uint64_t number = first; number < first + runs; ++number) {
    DrawnRun run(number);
    const std::string difference = run.Difference();
    EXPECT_EQ(difference, "") << "RODEIRA_VIRTUAL_ENDS_SEED=" << number << ": " << run.Text();
    losses += static_cast<std::uint64_t>(run.losses());
    clocks += static_cast<std::uint64_t>(run.clocks());
    if (file != nullptr && (number + 1) % 1000 == 0) std::ofstream(file) << number + 1 << "\n";
  }
  if (file != nullptr) std::ofstream(file) << first + runs << "\n";
  fmt::print("{} runs from {}, {} losses, {} clocks started again\n", runs, first, losses, clocks);
  EXPECT_GT(losses, runs / 2) << "losses come before the end of most runs";
  if (runs < 1000) return;  // too few to be sure of a clock among them
  EXPECT_GT(clocks, runs / 20) << "clocks are lost too";
}

}  // namespace
}  // namespace rodeira::lockstep
