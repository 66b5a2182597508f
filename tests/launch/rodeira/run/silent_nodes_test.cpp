// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/silent_nodes.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <optional>
#include <string>

#include "launch/rodeira/run/processes.hpp"

namespace rodeira::cli {
namespace {

using namespace std::chrono_literals;

constexpr const char* kSaid = "silent view node 'view' is silent at step 860";

TEST(SilentNodes, TheFateOfAProcessThatTakesItsTimeToEndIsSaidInstead) {
  auto child = Child::Start("view", {"/bin/sh", "-c", "sleep 0.3; kill -9 $$"}, false);
  ASSERT_TRUE(child.ok()) << child.error().Text();
  SilentNodes silent(
      [&](const std::string& node) -> std::optional<std::string> {
        EXPECT_EQ(node, "view");
        child.value().Poll();
        if (!child.value().ended()) return std::nullopt;
        return "node 'view' is dead";
      },
      30s);
  EXPECT_TRUE(silent.Take(kSaid));
  EXPECT_EQ(silent.Reworded("fault node 'view' is silent at step 860"), "fault node 'view' is dead");
  EXPECT_EQ(silent.Reworded("restart view 1 node 'view' is silent at step 860"), "restart view 1 node 'view' is dead");
  EXPECT_EQ(silent.Reworded("fault node 'road' has failed"), "fault node 'road' has failed");
}

TEST(SilentNodes, OfAProcessThatGoesOnTheClocksSentenceStays) {
  SilentNodes silent([](const std::string&) { return std::nullopt; }, 20ms);
  EXPECT_TRUE(silent.Take(kSaid));
  EXPECT_EQ(silent.Reworded("fault node 'view' is silent at step 860"), "fault node 'view' is silent at step 860");
}

TEST(SilentNodes, OtherLinesAreNotTheirs) {
  SilentNodes silent([](const std::string&) { return std::nullopt; }, 20ms);
  EXPECT_FALSE(silent.Take("fault node 'view' is silent"));
  EXPECT_FALSE(silent.Take("silent"));
  EXPECT_FALSE(silent.Take("silent view"));
}

// A process of this test that has not been waited for is a zombie, like one that waits for its last thread's end.
class Zombie {
 public:
  explicit Zombie(int signal) : pid_(::fork()) {
    if (pid_ == 0) {
      if (signal == 0) ::_exit(3);
      ::signal(signal, SIG_DFL);
      for (;;) ::raise(signal);
    }
    siginfo_t ended{};
    EXPECT_EQ(::waitid(P_PID, static_cast<id_t>(pid_), &ended, WEXITED | WNOWAIT), 0);
  }
  Zombie(const Zombie&) = delete;
  Zombie& operator=(const Zombie&) = delete;
  ~Zombie() { ::waitpid(pid_, nullptr, 0); }
  pid_t pid() const { return pid_; }

 private:
  pid_t pid_;
};

TEST(KilledBy, IsTheSignalOfAZombie) {
  EXPECT_EQ(KilledBy(Zombie(SIGKILL).pid()), SIGKILL);
  EXPECT_EQ(KilledBy(Zombie(SIGTERM).pid()), SIGTERM);
}

TEST(KilledBy, IsNoSignalOfOneThatLivesOrHasLeft) {
  EXPECT_EQ(KilledBy(Zombie(0).pid()), 0);
  EXPECT_EQ(KilledBy(::getpid()), 0);
  EXPECT_EQ(KilledBy(-1), 0);
}

}  // namespace
}  // namespace rodeira::cli
