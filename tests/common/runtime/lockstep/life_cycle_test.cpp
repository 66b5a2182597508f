// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/life.hpp"

#include <gtest/gtest.h>

#include <array>

namespace rodeira::lockstep {
namespace {

constexpr std::array kPhases = {Phase::kStarting, Phase::kReady,   Phase::kRunning, Phase::kFinished,
                                Phase::kFailed,   Phase::kRefused, Phase::kLost,    Phase::kAborted};
constexpr std::array kEvents = {
    LifeEvent::kInputsComplete, LifeEvent::kActivated, LifeEvent::kEndReached, LifeEvent::kRunAborted,
    LifeEvent::kFailed,         LifeEvent::kRefused,   LifeEvent::kLost};

// A row a phase that is no end, a column an event.
TEST(LifeCycle, EveryPhaseAndEvent) {
  using enum Phase;
  const std::array<std::array<Phase, kEvents.size()>, 3> expected = {{
      {kReady, kStarting, kStarting, kAborted, kFailed, kRefused, kLost},
      {kReady, kRunning, kFinished, kAborted, kFailed, kRefused, kLost},
      {kRunning, kRunning, kFinished, kAborted, kFailed, kRefused, kLost},
  }};
  for (std::size_t p = 0; p < expected.size(); ++p) {
    for (std::size_t e = 0; e < kEvents.size(); ++e)
      EXPECT_EQ(NextPhase(kPhases[p], kEvents[e]), expected[p][e]) << PhaseName(kPhases[p]) << ", event " << e;
  }
}

TEST(LifeCycle, AnEndIsForGood) {
  for (const Phase phase : kPhases) {
    if (!IsTerminal(phase)) continue;
    for (const LifeEvent event : kEvents) EXPECT_EQ(NextPhase(phase, event), phase) << PhaseName(phase);
    for (const Phase said : kPhases) EXPECT_EQ(MayFollow(phase, said), phase == said) << PhaseName(phase);
  }
}

// What a node reports in the order of its events is news; whatever overtakes it is not.
TEST(LifeCycle, ReportsOfOneLifeFollowOneAnother) {
  for (const Phase phase : kPhases) {
    for (const LifeEvent event : kEvents) {
      const Phase next = NextPhase(phase, event);
      EXPECT_TRUE(MayFollow(phase, next)) << PhaseName(phase) << " to " << PhaseName(next);
      if (next != phase) {
        EXPECT_FALSE(MayFollow(next, phase)) << PhaseName(next) << " to " << PhaseName(phase);
      }
    }
  }
}

TEST(LifeCycle, AnEndIsMeantOnlyWhenTheClockHasSaidSo) {
  for (const bool final : {false, true}) {
    for (const bool abort : {false, true}) {
      Grant grant;
      grant.final = final;
      grant.abort = abort;
      EXPECT_EQ(EndedEarly(Phase::kFinished, grant), !final);
      EXPECT_EQ(EndedEarly(Phase::kAborted, grant), !abort);
      EXPECT_FALSE(EndedEarly(Phase::kRunning, grant));
    }
  }
}

TEST(LifeCycle, OnlyANodeThatHasFinishedStaysForOthers) {
  for (const Phase phase : kPhases) {
    for (const bool over : {false, true}) {
      for (const bool abort : {false, true}) {
        Grant grant;
        grant.final = true;
        grant.over = over;
        grant.abort = abort;
        const bool stays = phase == Phase::kFinished && !over && !abort;
        EXPECT_EQ(MayLeave(phase, grant), IsTerminal(phase) && !stays) << PhaseName(phase);
      }
    }
  }
}

}  // namespace
}  // namespace rodeira::lockstep
