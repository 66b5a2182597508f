#include "common/vehicle/car_array.hpp"

#include <algorithm>
#include <thread>

#include "common/base/assert.hpp"
#include "common/vehicle/bicycle_model.hpp"

namespace rodeira::vehicle {
namespace {

constexpr double kMostStep_s = 0.1;

}  // namespace

base::Result<std::uint32_t> CarArray::AddKind(const BicycleSettings& settings) {
  if (settings.wheel.enveloping != Enveloping::kNone) return base::WrongInput("'wheel.enveloping' is 'ring'; 'none' was expected of a car among many");
  chassis_.push_back(std::make_unique<const BicycleChassis>(settings));
  return static_cast<std::uint32_t>(chassis_.size() - 1);
}

base::Result<std::size_t> CarArray::Add(std::uint32_t kind, const InitialCondition& initial, terrain::Ground& ground) {
  RODEIRA_ASSERT(kind < chassis_.size());
  BicycleModel alone(chassis_[kind]->settings);
  if (const base::Status status = alone.Initialise(initial, ground); !status) return status.error();
  kinds_.push_back(kind);
  cars_.push_back(alone.car());
  findings_.emplace_back();
  return cars_.size() - 1;
}

void CarArray::AskGround(terrain::Ground& ground) {
  queries_.resize(kWheels * cars_.size());
  points_.resize(queries_.size());
  for (std::size_t i = 0; i < cars_.size(); ++i) {
    for (std::size_t k = 0; k < kWheels; ++k) {
      const Eigen::Vector3d hub_W = cars_[i].HubAtRest_W(chassis(i), k);
      queries_[kWheels * i + k] = {hub_W.x(), hub_W.y(), hub_W.z()};
    }
  }
  ground.Query(queries_, points_);
  for (std::size_t i = 0; i < cars_.size(); ++i) {
    for (std::size_t k = 0; k < kWheels; ++k) cars_[i].wheels[k].Take(queries_[kWheels * i + k], points_[kWheels * i + k]);
  }
}

void CarArray::StepRange(std::span<const Controls> controls, double dt_s, std::size_t from, std::size_t to) {
  for (std::size_t i = from; i < to; ++i) cars_[i].Step(chassis(i), Cut(controls[i]), Wrench(), dt_s, findings_[i]);
}

void CarArray::Step(std::span<const Controls> controls, terrain::Ground& ground, double dt_s, unsigned threads) {
  RODEIRA_ASSERT(dt_s > 0.0 && dt_s <= kMostStep_s);
  RODEIRA_ASSERT(controls.size() == cars_.size() && threads >= 1);
  AskGround(ground);
  const std::size_t each = (cars_.size() + threads - 1) / threads;
  std::vector<std::jthread> others;
  for (std::size_t from = each; from < cars_.size(); from += each) {
    others.emplace_back([this, controls, dt_s, from, to = std::min(from + each, cars_.size())] { StepRange(controls, dt_s, from, to); });
  }
  StepRange(controls, dt_s, 0, std::min(each, cars_.size()));
}

void CarArray::Save(base::StateWriter& writer) const {
  for (const BicycleCar& car : cars_) writer.Put("car", car);
}

void CarArray::Restore(base::StateReader& reader) {
  for (BicycleCar& car : cars_) reader.Get("car", car);
}

}  // namespace rodeira::vehicle
