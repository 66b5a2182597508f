#include "common/vehicle/vehicle_model.hpp"

namespace rodeira::vehicle {

InitialCondition FromState(const VehicleState& state) {
  const Eigen::Vector3d v_WB_B = state.v_WB_B();
  InitialCondition initial;
  initial.x_m = state.p_WB_W.x();
  initial.y_m = state.p_WB_W.y();
  initial.z_hint_m = state.p_WB_W.z();
  initial.heading_rad = state.heading_rad();
  initial.speed_mps = v_WB_B.x();
  initial.lateral_speed_mps = v_WB_B.y();
  initial.yaw_rate_radps = state.w_WB_B.z();
  return initial;
}

}  // namespace rodeira::vehicle
