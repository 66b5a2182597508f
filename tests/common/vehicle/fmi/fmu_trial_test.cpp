// SPDX-License-Identifier: Apache-2.0
// An FMU with code that crashes, hangs or ends the process: in its trial it is refused by name, in a step the process
// ends by the signal and names the FMU.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <string>
#include <thread>

#include "common/core/base/crash_trace.hpp"
#include "common/vehicle/fmi/archive.hpp"
#include "common/vehicle/fmi/trial.hpp"
#include "common/vehicle/fmi/unit.hpp"
#include "tests/common/vehicle/fmi/test_fmu.hpp"

namespace rodeira::fmi {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class FmuTrial : public ::testing::Test {
 protected:
  static std::string Refusal(const std::filesystem::path& file, const TrialLimits& limits = {}) {
    const auto folder = Unpack(file);
    EXPECT_TRUE(folder.ok());
    const auto status = TryInProcessOfItsOwn(folder.value().path(), file.string(), limits);
    EXPECT_FALSE(status.ok());
    if (status.ok()) return "";
    EXPECT_EQ(status.error().exit_status(), 2);
    EXPECT_THAT(status.error().Text(), StartsWith(file.string()));
    return status.error().message;
  }
  // The FMU's code finds what it shall do in its guid.
  std::filesystem::path PackOneThat(const std::string& does) const {
    return folder_.Pack({{"{rodeira-test-car}", "{" + does + "}"}});
  }
  FmuFolder folder_;
};

TEST_F(FmuTrial, OneWithoutFaultPasses) {
  const auto file = folder_.Pack();
  const auto folder = Unpack(file);
  ASSERT_TRUE(folder.ok());
  const auto status = TryInProcessOfItsOwn(folder.value().path(), file.string());
  EXPECT_TRUE(status.ok()) << status.error().Text();
}

TEST_F(FmuTrial, OneThatCrashesIsRefusedWithSignalAndFunction) {
  EXPECT_THAT(Refusal(folder_.Pack({}, "linux64", "crashing")),
              HasSubstr("its binary crashes (signal 11, Segmentation fault) in loading"));
  EXPECT_THAT(Refusal(PackOneThat("crashes")),
              HasSubstr("its binary crashes (signal 11, Segmentation fault) in fmi2Instantiate"));
}

TEST_F(FmuTrial, OneThatEndsTheProcessIsRefused) {
  EXPECT_THAT(Refusal(PackOneThat("exits")), HasSubstr("its binary ends the process (status 0) in fmi2Instantiate"));
}

TEST_F(FmuTrial, OneThatDoesNotComeBackIsRefusedAtTheLimit) {
  using namespace std::chrono_literals;
  EXPECT_THAT(Refusal(PackOneThat("computes"), {.cpu = 1s, .wall = 600s}),
              HasSubstr("its binary computes for 1 s and does not come back in fmi2Instantiate"));
  EXPECT_THAT(Refusal(PackOneThat("sleeps"), {.cpu = 600s, .wall = 1s}),
              HasSubstr("its binary does not come back within 1 s in fmi2Instantiate"));
}

// Unit::Load tries it before this process loads it.
TEST_F(FmuTrial, IsPartOfLoading) {
  const auto refused = Unit::Load(PackOneThat("crashes"));
  ASSERT_FALSE(refused.ok());
  EXPECT_THAT(refused.error().message, HasSubstr("crashes (signal 11, Segmentation fault) in fmi2Instantiate"));
  const auto without_instance = Unit::Load(PackOneThat("another"));
  ASSERT_FALSE(without_instance.ok());
  EXPECT_EQ(without_instance.error().exit_status(), 2);
  EXPECT_THAT(without_instance.error().message, HasSubstr("fmi2Instantiate: the FMU makes no instance of itself"));
}

// A state is saved by one process and set by another: one that works by the saving process's addresses does not pass,
// nor one from which the FMU comes to other outputs, as solvers do that begin anew with it.
TEST_F(FmuTrial, AStateIsTriedInAnotherProcess) {
  for (const auto& [binary, saves] : {std::pair("car", true), std::pair("addresses", true),
                                      std::pair("pointers", false), std::pair("forgetful", false)}) {
    const auto unit = Unit::Load(folder_.Pack({}, "linux64", binary));
    ASSERT_TRUE(unit.ok()) << binary;
    EXPECT_EQ(unit.value()->can_save_state(), saves) << binary << ": " << unit.value()->note();
    EXPECT_EQ(unit.value()->note().empty(), saves);
  }
  EXPECT_THAT(Unit::Load(folder_.Pack({}, "linux64", "forgetful")).value()->note(),
              AllOf(HasSubstr("otherwise: roll_rad = "), HasSubstr("; roll_rad = 0 without it")));
  const auto none = Unit::Load(folder_.Pack({{"canSerializeFMUstate=\"true\"", "canSerializeFMUstate=\"false\""}}));
  ASSERT_TRUE(none.ok());
  EXPECT_FALSE(none.value()->can_save_state());
  EXPECT_EQ(none.value()->note(), "") << "it promised nothing";
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

class FmuStepDeathTest : public FmuTrial {
 protected:
  void SetUp() override { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
  // Steps of 0.1 s up to 1 s; the parameter makes one of them crash or exit.
  void Drive(const char* parameter) {
    base::TraceCrashes("the advice\n");
    auto unit = Unit::Load(folder_.Pack());
    auto made = unit.value()->Instantiate("ego");
    Instance& car = *made.value();
    (void)car.EnterInitialisation(0.0);
    (void)car.Set(*unit.value()->description().Find(parameter), 0.5);
    (void)car.ExitInitialisation();
    for (int i = 0; i < 10; ++i) (void)car.DoStep(0.1 * i, 0.1);
  }
};

TEST_F(FmuStepDeathTest, ACrashEndsTheProcessByItsSignalAndNamesTheFmu) {
  EXPECT_EXIT(Drive("crash_at_s"), ::testing::KilledBySignal(SIGSEGV),
              "rodeira: crash: SIGSEGV in fmi2DoStep of FMU '.*car.fmu' .instance 'ego'.; backtrace:.*the advice");
}

TEST_F(FmuStepDeathTest, AnExitIsSaidToo) {
  EXPECT_EXIT(Drive("exit_at_s"), ::testing::ExitedWithCode(1),
              "rodeira: crash: exit in fmi2DoStep of FMU '.*car.fmu' .instance 'ego'.\nthe advice");
}

int Deeper(volatile int* depth) {
  volatile char wide[4096] = {};
  *depth = *depth + 1;
  wide[*depth % 4096] = 1;
  return *depth < (1 << 30) ? Deeper(depth) + wide[7] : 0;
}

// In every thread, also where the thread's stack is what has ended.
TEST_F(FmuStepDeathTest, AnOverflownStackIsNamedToo) {
  EXPECT_EXIT(
      {
        base::TraceCrashes();
        std::thread([] {
          const base::ForeignCall call("fmi2DoStep", "FMU 'deep.fmu'");
          volatile int depth = 0;
          (void)Deeper(&depth);
        }).join();
      },
      ::testing::KilledBySignal(SIGSEGV), "SIGSEGV in fmi2DoStep of FMU 'deep.fmu'; backtrace:");
}

// After the call a crash is Rodeira's own again.
TEST_F(FmuStepDeathTest, ACrashOutsideOfForeignCodeNamesNone) {
  EXPECT_EXIT(
      {
        base::TraceCrashes();
        { const base::ForeignCall call("fmi2DoStep", "FMU 'a.fmu'"); }
        (void)::raise(SIGSEGV);
      },
      ::testing::KilledBySignal(SIGSEGV), "rodeira: crash: SIGSEGV; backtrace:");
}

#endif

}  // namespace
}  // namespace rodeira::fmi
