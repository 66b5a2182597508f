// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "common/analysis/measures/drive.hpp"
#include "common/analysis/measures/leader_finder.hpp"

// What one sample of a drive is made of: the same for a recording and for a run.
namespace rodeira::measures {

// What is known of the subject at one sample.
struct SubjectSample {
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;
  double heading_rad = 0.0;
  double speed_mps = 0.0;
  double yaw_radps = kMissing;
  double throttle = kMissing, brake = kMissing, steering_wheel_deg = kMissing;
  double indicator = 0.0;
  double fuel_used_kg = kMissing;
};

// The motion along a body's x axis: its heading in the plane, and the speed along it. q_WB and the velocity in W.
struct AlongBody {
  double heading_rad = 0.0;
  double speed_mps = 0.0;
};
// q need not have unit length; the speed is positive forward.
AlongBody AlongBodyOf(double qw, double qx, double qy, double qz, double vx_mps, double vy_mps, double vz_mps);

// Sets the columns of sample k, which exists.
void PutSubject(const SubjectSample& sample, std::size_t k, Drive& drive);
void PutPlace(const LanePlace& place, std::size_t k, Drive& drive);
// The vehicles ahead and behind in the own lane and in the next ones. `track` and `along_m`: where the subject is;
// `later` and `earlier`: as in LeaderFinder::Find.
void PutNeighbours(const lanes::Graph& graph, LeaderFinder& finder, std::uint32_t track, double along_m,
                   std::span<const OtherVehicle> others, std::span<const std::uint32_t> later,
                   std::span<const std::uint32_t> earlier, std::size_t k, Drive& drive);

}  // namespace rodeira::measures
