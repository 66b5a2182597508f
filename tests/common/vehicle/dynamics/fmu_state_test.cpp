// SPDX-License-Identifier: Apache-2.0
// States of FMUs with addresses in their bytes, and FMUs of which a process may have one instance.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/core/base/carried_state.hpp"
#include "common/core/base/state_fields.hpp"
#include "common/vehicle/dynamics/fmu_model.hpp"
#include "common/vehicle/dynamics/vehicle_notes.hpp"
#include "tests/common/vehicle/dynamics/test_ground.hpp"
#include "tests/common/vehicle/fmi/test_fmu.hpp"

namespace rodeira::dynamics {
namespace {

using ground::PlaneGround;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double kPeriod_s = 0.001;

class FmuState : public ::testing::Test {
 protected:
  std::unique_ptr<VehicleModel> Car(const std::string& binary,
                                    const std::vector<std::pair<std::string, std::string>>& changes = {}) {
    folder_.Pack(changes, "linux64", binary);
    file_ = folder_.WriteCar();
    auto car = LoadVehicle(file_);
    EXPECT_TRUE(car.ok()) << (car.ok() ? "" : car.error().Text());
    return std::move(car).value();
  }
  static void Drive(VehicleModel& car, int steps, double throttle) {
    PlaneGround ground;
    Controls controls;
    controls.throttle = throttle;
    controls.steering_wheel_rad = 0.4;
    for (int i = 0; i < steps; ++i) car.Step(controls, ground, kPeriod_s);
  }
  static base::StateWriter Saved(const VehicleModel& car,
                                 base::StateWriter::Names names = base::StateWriter::Names::kWith) {
    base::StateWriter writer(names);
    car.Save(writer);
    return writer;
  }

  fmi::FmuFolder folder_;
  std::filesystem::path file_;
};

// Two instances at the same state: their bytes differ by an address, nothing else does. What is computed is compared.
TEST_F(FmuState, AddressesAreCarriedAndNeitherDigestedNorCompared) {
  PlaneGround ground;
  auto one = Car("addresses"), other = Car("addresses");
  ASSERT_TRUE(one->Initialise({}, ground).ok() && other->Initialise({}, ground).ok());
  Drive(*one, 300, 0.8);
  Drive(*other, 300, 0.8);
  ASSERT_TRUE(one->can_save());
  const base::StateWriter of_one = Saved(*one), of_other = Saved(*other);
  ASSERT_NE(of_one.bytes(), of_other.bytes()) << "the callbacks lie elsewhere";
  EXPECT_TRUE(base::SameButCarried(of_one.bytes(), of_other.bytes()));
  EXPECT_FALSE(base::FirstStateDifference(of_one.bytes(), of_other.bytes()).value().has_value());
  constexpr auto kDigest = base::StateWriter::Names::kWithout;
  EXPECT_EQ(Saved(*one, kDigest).digest(), Saved(*other, kDigest).digest());
  Drive(*other, 1, 0.7);
  EXPECT_FALSE(base::SameButCarried(of_one.bytes(), Saved(*other).bytes())) << "another place";
  EXPECT_NE(Saved(*one, kDigest).digest(), Saved(*other, kDigest).digest());
  // From the snapshot it goes on by the same bits.
  base::StateReader reader(of_one.bytes());
  other->Restore(reader);
  ASSERT_TRUE(reader.Finish().ok());
  EXPECT_EQ(Saved(*other).bytes(), of_one.bytes()) << "what was restored is saved again as it was";
  Drive(*one, 200, 0.3);
  Drive(*other, 200, 0.3);
  EXPECT_EQ(Saved(*one, kDigest).digest(), Saved(*other, kDigest).digest());
  EXPECT_EQ(one->state().p_WB_W, other->state().p_WB_W);
}

// An FMU that uses the address of the process that saved it: the trial finds out, so that runs begin at step 0.
TEST_F(FmuState, AStateThatDoesNotOutliveItsProcessIsNoState) {
  auto car = Car("pointers");
  EXPECT_FALSE(car->can_save());
  EXPECT_THAT(NotesOn(*car, file_), ElementsAre(HasSubstr("the state that it saves is of no use to another process")));
  PlaneGround ground;
  ASSERT_TRUE(car->Initialise({}, ground).ok());
  Drive(*car, 10, 1.0);
  EXPECT_TRUE(car->problem().ok()) << "it drives";
}

const std::vector<std::pair<std::string, std::string>> kOnce = {
    {"canHandleVariable", "canBeInstantiatedOnlyOncePerProcess=\"true\" canHandleVariable"}};

// The binary refuses a second fmi2Instantiate in its process, whatever became of the first.
TEST_F(FmuState, AnFmuOfOneInstanceIsResetAndNotMadeAgain) {
  auto car = Car("once", kOnce);
  PlaneGround ground;
  ASSERT_TRUE(car->Initialise({}, ground).ok());
  Drive(*car, 100, 1.0);
  const base::StateWriter saved = Saved(*car);
  const Eigen::Vector3d there = car->state().p_WB_W;
  ASSERT_TRUE(car->Initialise({.x_m = 7.0}, ground).ok()) << "placed anew";
  EXPECT_EQ(car->state().p_WB_W.x(), 7.0);
  base::StateReader reader(saved.bytes());
  car->Restore(reader);
  EXPECT_TRUE(reader.Finish().ok() && car->problem().ok());
  EXPECT_EQ(car->state().p_WB_W, there);
  auto second = LoadVehicle(file_);
  ASSERT_TRUE(second.ok());
  const base::Status status = second.value()->Initialise({}, ground);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().exit_status(), 2);
  EXPECT_THAT(status.error().Text(), HasSubstr("canBeInstantiatedOnlyOncePerProcess"));
}

// A guid of another binary: wrong input where the file is loaded, and not a failed run.
TEST_F(FmuState, AWrongGuidIsWrongInput) {
  folder_.Pack({{"{rodeira-test-car}", "{another-car}"}});
  const auto car = LoadVehicle(folder_.WriteCar());
  ASSERT_FALSE(car.ok());
  EXPECT_EQ(car.error().exit_status(), 2);
  EXPECT_THAT(car.error().Text(), HasSubstr("the guid is {another-car}, which is another car's"));
}

// A state that the FMU refuses is told with its function when the car goes on.
TEST_F(FmuState, AStateThatCannotBeTakenOverIsToldByItsFunction) {
  PlaneGround ground;
  auto car = Car("car");
  ASSERT_TRUE(car->Initialise({}, ground).ok());
  base::StateWriter spoilt;
  spoilt.Put("time_s", 0.1);
  const WheelGround plane;
  for (std::size_t i = 0; i < kWheels; ++i) spoilt.Put("wheel", plane);
  spoilt.Put("published", car->state());
  spoilt.Put("carried.fmu", std::vector<std::uint8_t>{1, 2, 3});
  base::StateReader reader(spoilt.bytes());
  car->Restore(reader);
  ASSERT_TRUE(reader.Finish().ok());
  ASSERT_FALSE(car->problem().ok());
  EXPECT_THAT(car->problem().error().Text(),
              HasSubstr("its state at 0.1 s cannot be taken over: fmi2DeSerializeFMUstate"));
}

}  // namespace
}  // namespace rodeira::dynamics
