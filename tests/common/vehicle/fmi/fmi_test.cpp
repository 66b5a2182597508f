// SPDX-License-Identifier: Apache-2.0
// The importer of FMUs: what is sound runs, what is not is refused in a sentence.
#include "tests/common/vehicle/fmi/test_fmu.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "common/vehicle/fmi/archive.hpp"
#include "common/vehicle/fmi/unit.hpp"

namespace rodeira::fmi {
namespace {

using ::testing::HasSubstr;

class Fmi : public ::testing::Test {
 protected:
  std::string Refusal(const std::filesystem::path& file) {
    const auto unit = Unit::Load(file);
    EXPECT_FALSE(unit.ok());
    if (unit.ok()) return "";
    EXPECT_EQ(unit.error().exit_status(), 2);
    EXPECT_THAT(unit.error().Text(), HasSubstr(file.string()));
    return unit.error().message;
  }
  FmuFolder folder_;
};

TEST_F(Fmi, RunsAnFmuAndRestoresItsState) {
  auto unit = Unit::Load(folder_.Pack());
  ASSERT_TRUE(unit.ok()) << unit.error().Text();
  const Description& description = unit.value()->description();
  EXPECT_EQ(description.identifier, "car");
  EXPECT_TRUE(description.can_get_state && description.can_serialize_state);
  ASSERT_NE(description.Find("throttle"), nullptr);
  EXPECT_EQ(description.Find("throttle")->reference, 13u);
  EXPECT_EQ(description.Find("x_m")->unit, "m");
  EXPECT_EQ(description.Find("trottle"), nullptr);
  auto made = unit.value()->Instantiate("one");
  ASSERT_TRUE(made.ok()) << made.error().Text();
  Instance& car = *made.value();
  ASSERT_TRUE(car.EnterInitialisation(0.0).ok());
  ASSERT_TRUE(car.ExitInitialisation().ok());
  ASSERT_TRUE(car.Set(*description.Find("throttle"), 0.5).ok());
  const auto drive = [&](int from, int to) {
    for (int i = from; i < to; ++i) ASSERT_TRUE(car.DoStep(0.01 * i, 0.01).ok());
  };
  drive(0, 500);
  const auto state = car.State();
  ASSERT_TRUE(state.ok());
  drive(500, 1000);
  const double x = car.Get(*description.Find("x_m")).value();
  // v' = 1.5 - 0.05 v from rest: v = 30 (1 - e^(-t/20)), x its integral; Euler's steps of 10 ms are off by half a
  // step's acceleration.
  EXPECT_NEAR(x, 30.0 * (10.0 - 20.0 * (1.0 - std::exp(-0.5))), 0.1);
  EXPECT_EQ(car.Get(*description.Find("gear")).value(), 1.0);
  ASSERT_TRUE(car.SetState(state.value()).ok());
  drive(500, 1000);
  EXPECT_EQ(car.Get(*description.Find("x_m")).value(), x);
  const auto cut = car.SetState(std::span(state.value()).first(3));
  ASSERT_FALSE(cut.ok());
  EXPECT_THAT(cut.error().Text(), HasSubstr("fmi2DeSerializeFMUstate: error"));
}

TEST_F(Fmi, WhatTheFmuSaysIsToldWithItsFailure) {
  auto unit = Unit::Load(folder_.Pack());
  ASSERT_TRUE(unit.ok()) << unit.error().Text();
  auto made = unit.value()->Instantiate("one");
  Instance& car = *made.value();
  ASSERT_TRUE(car.EnterInitialisation(0.0).ok());
  ASSERT_TRUE(car.Set(*unit.value()->description().Find("fail_at_s"), 0.5).ok());
  ASSERT_TRUE(car.ExitInitialisation().ok());
  ASSERT_TRUE(car.DoStep(0.4, 0.1).ok());
  const auto failed = car.DoStep(0.5, 0.1);
  ASSERT_FALSE(failed.ok());
  EXPECT_THAT(failed.error().Text(), HasSubstr("car.fmu: fmi2DoStep: error: the tank is empty at 0.5 s"));
  EXPECT_EQ(failed.error().exit_status(), 1);
  // Of another description than the binary was made for: found in the trial.
  EXPECT_THAT(Refusal(folder_.Pack({{"{rodeira-test-car}", "{another}"}})),
              HasSubstr("the guid is {another}, which is another car's"));
}

TEST_F(Fmi, WhatIsNoFmuOfThisPlatformIsRefused) {
  EXPECT_THAT(Refusal(folder_.path() / "none.fmu"), HasSubstr("no such file"));
  const auto file = folder_.path() / "car.fmu";
  ASSERT_TRUE(base::WriteWhole(file, "rodeira: vehicle/1\n").ok());
  EXPECT_THAT(Refusal(file), HasSubstr("a ZIP archive was expected"));
  WriteZip(file, {{"readme.txt", "hello"}});
  EXPECT_THAT(Refusal(file), HasSubstr("holds no modelDescription.xml"));
  WriteZip(file, {{"modelDescription.xml", "<fmiModelDescription"}});
  EXPECT_THAT(Refusal(file), HasSubstr("is no XML"));
  WriteZip(file, {{"modelDescription.xml", "<html/>"}});
  EXPECT_THAT(Refusal(file), HasSubstr("no 'fmiModelDescription'"));
  EXPECT_THAT(Refusal(folder_.Pack({{"fmiVersion=\"2.0\"", "fmiVersion=\"3.0\""}})),
              HasSubstr("FMI version '3.0'; 2.0 was expected"));
  EXPECT_THAT(Refusal(folder_.Pack({{"<CoSimulation", "<ModelExchange"}})), HasSubstr("no co-simulation"));
  EXPECT_THAT(Refusal(folder_.Pack({{"canHandle", "needsExecutionTool=\"true\" canHandle"}})),
              HasSubstr("maker's program"));
  EXPECT_THAT(Refusal(folder_.Pack({}, "win64")),
              HasSubstr("no binaries/linux64/car.so; the platforms that it has binaries for: win64"));
  EXPECT_THAT(Refusal(folder_.Pack({{"modelIdentifier=\"car\"", "modelIdentifier=\"bus\""}})),
              HasSubstr("no binaries/linux64/bus.so; the platforms that it has binaries for: linux64 (car.so)"));
  EXPECT_THAT(Refusal(folder_.Pack({{"modelIdentifier=\"car\"", "modelIdentifier=\"../car\""}})),
              HasSubstr("'modelIdentifier' is '../car'"));
  WriteZip(file, {{"modelDescription.xml", FmuFolder::Description()},
                  {"binaries/linux64/car.so",
                   "\x7f"
                   "ELF of no kind"}});
  EXPECT_THAT(Refusal(file), HasSubstr("cannot be loaded"));
  WriteZip(file, {{"modelDescription.xml", FmuFolder::Description()}, {"../outside.txt", "x"}});
  EXPECT_THAT(Refusal(file), HasSubstr("'../outside.txt' leads out of its folder"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path().parent_path() / "outside.txt"));
}

// Cut short or with bytes changed: a sentence or an FMU, never a crash. The binary is left out: foreign code cannot be
// tried code.
TEST_F(Fmi, DamagedArchivesAreRefused) {
  const auto file = folder_.path() / "car.fmu";
  WriteZip(file, {{"modelDescription.xml", FmuFolder::Description()}, {"resources/note.txt", "of no use"}});
  const std::string good = base::ReadText(file).value();
  constexpr std::size_t kEndRecord =
      22;  // a ZIP archive ends with its table and this; of the record itself the last bytes say nothing
  for (std::size_t cut = 0; cut < good.size(); cut += 7) {
    ASSERT_TRUE(base::WriteWhole(file, good.substr(0, cut)).ok());
    const bool is_read = Unpack(file).ok();
    EXPECT_FALSE(is_read && cut + kEndRecord <= good.size()) << cut;
  }
  for (std::size_t at = 0; at < good.size(); at += 3) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 0x55);
    ASSERT_TRUE(base::WriteWhole(file, bad).ok());
    (void)Unit::Load(file);
  }
}

}  // namespace
}  // namespace rodeira::fmi
