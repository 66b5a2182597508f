// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/drive.hpp"

#include <array>

namespace rodeira::measures {
namespace {

template <std::vector<double> Drive::*Member>
const std::vector<double>& Own(const Drive& drive) {
  return drive.*Member;
}
template <Neighbour Drive::*Member, std::vector<double> Neighbour::*Value>
const std::vector<double>& Of(const Drive& drive) {
  return drive.*Member.*Value;
}

constexpr std::array kDriveColumns{
    DriveColumn{"x_m", Own<&Drive::x_m>},
    DriveColumn{"y_m", Own<&Drive::y_m>},
    DriveColumn{"z_m", Own<&Drive::z_m>},
    DriveColumn{"heading_rad", Own<&Drive::heading_rad>},
    DriveColumn{"speed_mps", Own<&Drive::speed_mps>},
    DriveColumn{"yaw_radps", Own<&Drive::yaw_radps>},
    DriveColumn{"throttle", Own<&Drive::throttle>},
    DriveColumn{"brake", Own<&Drive::brake>},
    DriveColumn{"steering_wheel_deg", Own<&Drive::steering_wheel_deg>},
    DriveColumn{"indicator", Own<&Drive::indicator>},
    DriveColumn{"fuel_used_kg", Own<&Drive::fuel_used_kg>},
    DriveColumn{"road", Own<&Drive::road>},
    DriveColumn{"lane", Own<&Drive::lane>},
    DriveColumn{"s_m", Own<&Drive::s_m>},
    DriveColumn{"t_m", Own<&Drive::t_m>},
    DriveColumn{"lane_width_m", Own<&Drive::lane_width_m>},
    DriveColumn{"lane_position_m", Own<&Drive::lane_position_m>},
    DriveColumn{"heading_error_rad", Own<&Drive::heading_error_rad>},
    DriveColumn{"lane_curvature_1pm", Own<&Drive::lane_curvature_1pm>},
    DriveColumn{"left_line_m", Own<&Drive::left_line_m>},
    DriveColumn{"right_line_m", Own<&Drive::right_line_m>},
    DriveColumn{"speed_limit_mps", Own<&Drive::speed_limit_mps>},
    DriveColumn{"junction", Own<&Drive::junction>},
    DriveColumn{"junction_ahead_m", Own<&Drive::junction_ahead_m>},
    DriveColumn{"light_ahead_m", Own<&Drive::light_ahead_m>},
    DriveColumn{"light_ahead", Own<&Drive::light_ahead>},
    DriveColumn{"leader_id", Of<&Drive::leader, &Neighbour::id>},
    DriveColumn{"leader_gap_m", Of<&Drive::leader, &Neighbour::gap_m>},
    DriveColumn{"leader_speed_mps", Of<&Drive::leader, &Neighbour::speed_mps>},
    DriveColumn{"leader_length_m", Of<&Drive::leader, &Neighbour::length_m>},
    DriveColumn{"follower_id", Of<&Drive::follower, &Neighbour::id>},
    DriveColumn{"follower_gap_m", Of<&Drive::follower, &Neighbour::gap_m>},
    DriveColumn{"follower_speed_mps", Of<&Drive::follower, &Neighbour::speed_mps>},
    DriveColumn{"left_leader_gap_m", Of<&Drive::left_leader, &Neighbour::gap_m>},
    DriveColumn{"left_follower_gap_m", Of<&Drive::left_follower, &Neighbour::gap_m>},
    DriveColumn{"left_follower_speed_mps", Of<&Drive::left_follower, &Neighbour::speed_mps>},
    DriveColumn{"right_leader_gap_m", Of<&Drive::right_leader, &Neighbour::gap_m>},
    DriveColumn{"right_follower_gap_m", Of<&Drive::right_follower, &Neighbour::gap_m>},
    DriveColumn{"right_follower_speed_mps", Of<&Drive::right_follower, &Neighbour::speed_mps>},
};

template <class Visit>
void EachColumn(Drive& d, const Visit& visit) {
  for (std::vector<double>* column : {&d.x_m,
                                      &d.y_m,
                                      &d.z_m,
                                      &d.heading_rad,
                                      &d.speed_mps,
                                      &d.yaw_radps,
                                      &d.throttle,
                                      &d.brake,
                                      &d.steering_wheel_deg,
                                      &d.indicator,
                                      &d.fuel_used_kg,
                                      &d.road,
                                      &d.lane,
                                      &d.s_m,
                                      &d.t_m,
                                      &d.lane_width_m,
                                      &d.lane_position_m,
                                      &d.heading_error_rad,
                                      &d.lane_curvature_1pm,
                                      &d.left_line_m,
                                      &d.right_line_m,
                                      &d.speed_limit_mps,
                                      &d.junction,
                                      &d.junction_ahead_m,
                                      &d.light_ahead_m,
                                      &d.light_ahead})
    visit(*column);
  for (Neighbour* n : {&d.leader, &d.follower, &d.left_leader, &d.left_follower, &d.right_leader, &d.right_follower}) {
    for (std::vector<double>* column : {&n->id, &n->gap_m, &n->speed_mps, &n->length_m}) visit(*column);
  }
}

}  // namespace

std::span<const DriveColumn> DriveColumns() { return kDriveColumns; }

std::vector<double>* FindColumn(Drive& drive, std::string_view name) {
  for (const DriveColumn& column : kDriveColumns) {
    if (name == column.name) return const_cast<std::vector<double>*>(&column.of(drive));  // of a drive that may change
  }
  return nullptr;
}

void GrowColumns(Drive& drive, std::size_t size) {
  EachColumn(drive, [size](std::vector<double>& column) { column.resize(size, kMissing); });
  drive.episode.resize(size, 0);
  drive.crossing.resize(size, 0);
}

}  // namespace rodeira::measures
