// SPDX-License-Identifier: Apache-2.0
// A model that breaks its promises, as its file says: `fault: nan_after_step | nan_at_start | no_dimensions | none`.
#include <limits>

#include "common/vehicle/dynamics/vehicle_library.hpp"

namespace {

using namespace rodeira;

class OddVehicle final : public dynamics::VehicleModel {
 public:
  explicit OddVehicle(std::string fault) : fault_(std::move(fault)) {
    dimensions_ = {.wheelbase_m = 2.5,
                   .track_front_m = 1.5,
                   .track_rear_m = 1.5,
                   .wheel_radius_m = 0.3,
                   .wheel_width_m = 0.2,
                   .front_m = 2.0,
                   .rear_m = 2.0,
                   .width_m = 1.7,
                   .height_m = 1.4,
                   .mass_kg = 1000.0};
    if (fault_ == "no_dimensions") dimensions_.height_m = 0.0;
  }
  base::Status Initialise(const dynamics::InitialCondition&, ground::Ground&) override {
    if (fault_ == "nan_at_start") state_.q_WB.w() = std::numeric_limits<double>::quiet_NaN();
    return {};
  }
  void Step(const dynamics::Controls&, ground::Ground&, double dt_s) override {
    state_.p_WB_W.x() += dt_s;
    if (fault_ == "nan_after_step" && state_.p_WB_W.x() > 0.1)
      state_.v_WB_W.y() = std::numeric_limits<double>::quiet_NaN();
  }
  const dynamics::VehicleState& state() const override { return state_; }
  const dynamics::VehicleDimensions& dimensions() const override { return dimensions_; }
  void Save(base::StateWriter& out) const override { out.Put("state", state_); }
  void Restore(base::StateReader& in) override { in.Get("state", state_); }

 private:
  std::string fault_;
  dynamics::VehicleDimensions dimensions_;
  dynamics::VehicleState state_;
};

std::unique_ptr<dynamics::VehicleModel> MakeOddVehicle(const config::Map& root) {
  const std::string fault = root.Text("fault");
  if (fault == "none") return nullptr;
  return std::make_unique<OddVehicle>(fault);
}

}  // namespace

RODEIRA_VEHICLE(MakeOddVehicle);
