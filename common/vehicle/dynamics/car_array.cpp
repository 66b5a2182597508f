// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/car_array.hpp"

#include <algorithm>

#include "common/core/base/assert.hpp"
#include "common/vehicle/dynamics/bicycle_model.hpp"

namespace rodeira::dynamics {

base::Result<std::uint32_t> CarArray::AddKind(const BicycleSettings& settings) {
  if (settings.wheel.enveloping != Enveloping::kNone)
    return base::WrongInput("vehicle.wrong_model",
                            "'wheel.enveloping' is 'ring'; 'none' was expected of a car among many");
  chassis_.push_back(std::make_shared<const BicycleChassis>(settings));
  return static_cast<std::uint32_t>(chassis_.size() - 1);
}

base::Result<std::size_t> CarArray::Add(std::uint32_t kind, const InitialCondition& initial, ground::Ground& ground) {
  Resize(size() + 1);
  if (const base::Status status = Place(size() - 1, kind, initial, ground); !status) {
    Resize(size() - 1);
    return status.error();
  }
  return size() - 1;
}

void CarArray::Resize(std::size_t places) {
  kinds_.resize(places);
  present_.resize(places);
  cars_.resize(places);
  findings_.resize(places);
}

base::Status CarArray::Place(std::size_t i, std::uint32_t kind, const InitialCondition& initial,
                             ground::Ground& ground) {
  RODEIRA_ASSERT(kind < chassis_.size() && i < size());
  BicycleModel alone(chassis_[kind]->settings);
  if (const base::Status status = alone.Initialise(initial, ground); !status) return status;
  kinds_[i] = kind;
  present_[i] = 1;
  cars_[i] = alone.car();
  findings_[i] = {};
  return {};
}

void CarArray::QueryGround(ground::Ground& ground) {
  queries_.clear();
  for (std::size_t i = 0; i < cars_.size(); ++i) {
    if (!present(i)) continue;
    for (std::size_t k = 0; k < kWheels; ++k) {
      const Eigen::Vector3d hub_W = cars_[i].HubAtRest_W(chassis(i), k);
      queries_.push_back({hub_W.x(), hub_W.y(), hub_W.z()});
    }
  }
  points_.resize(queries_.size());
  ground.Query(queries_, points_);
  std::size_t answer = 0;
  for (std::size_t i = 0; i < cars_.size(); ++i) {
    if (!present(i)) continue;
    std::array<WheelGround, kWheels> before;
    for (std::size_t k = 0; k < kWheels; ++k, ++answer) {
      before[k] = cars_[i].wheels[k];
      cars_[i].wheels[k].Update(queries_[answer], points_[answer]);
    }
    cars_[i].RollOn(chassis(i), before);
  }
}

void CarArray::StepRange(std::span<const Controls> controls, double dt_s, std::size_t from, std::size_t to) {
  for (std::size_t i = from; i < to; ++i) {
    if (present(i)) cars_[i].Step(chassis(i), Clamp(controls[i]), Wrench(), dt_s, findings_[i]);
  }
}

void CarArray::Step(std::span<const Controls> controls, ground::Ground& ground, double dt_s, base::ThreadPool* pool) {
  RODEIRA_ASSERT(dt_s > 0.0 && dt_s <= kMaxStep_s);
  RODEIRA_ASSERT(controls.size() == cars_.size());
  QueryGround(ground);
  base::ParallelFor(pool, cars_.size(), [&](std::size_t from, std::size_t to) { StepRange(controls, dt_s, from, to); });
}

void CarArray::Save(base::StateWriter& writer) const {
  writer.Put("present", present_);
  for (std::size_t i = 0; i < cars_.size(); ++i) {
    if (!present(i)) continue;
    writer.Put("kind", kinds_[i]);
    writer.Put("car", cars_[i]);
  }
}

// A snapshot comes from outside: whatever it says, nothing is read beside the arrays.
void CarArray::Restore(base::StateReader& reader) {
  reader.Get("present", present_);
  present_.resize(cars_.size());
  for (std::size_t i = 0; i < cars_.size(); ++i) {
    if (!present(i)) continue;
    reader.Get("kind", kinds_[i]);
    reader.Get("car", cars_[i]);
    findings_[i] = {};
    if (kinds_[i] >= chassis_.size()) kinds_[i] = 0, present_[i] = 0;
  }
}

}  // namespace rodeira::dynamics
