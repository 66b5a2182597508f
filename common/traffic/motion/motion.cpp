// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/motion/motion.hpp"

#include <algorithm>

#include "common/traffic/perception/each_driving.hpp"

namespace rodeira::traffic {

void Motion::Move(double dt_s) {
  if (out_.full) out_.full->Step(dt_s, in_.pool);
  std::fill(out_.is_moved.begin(), out_.is_moved.end(), 0);
  std::fill(out_.ends.begin(), out_.ends.end(), 0);
  std::fill(out_.missed_now.begin(), out_.missed_now.end(), 0);
  EachDriving(in_.pool, out_.agents, [&](std::uint32_t id) { MoveOne(id, dt_s); });
}

void Motion::MoveOne(std::uint32_t id, double dt_s) {
  out_.planar.FetchBend(id);
  if (out_.full)
    out_.full_motion.FollowFull(id, dt_s);
  else
    out_.planar.MovePlanar(id, in_.wanted[id], dt_s);
  out_.missed_now[id] = out_.paths.Follow(id);
  out_.ends[id] = out_.paths.AtTheEnd(id);
  out_.is_moved[id] = !out_.ends[id];
  if (!out_.ends[id]) {
    AgentPose& pose = out_.moved[id];
    pose = in_.body_poses.PoseOf(id);
    const CurrentTrackCache& below = in_.below[id];
    const bool as_below = below.turned && pose.q_WB.coeffs() == below.turned->coeffs();
    out_.agents[id].grade = as_below ? below.grade : GradeOf(pose.q_WB);
  }
  const auto& path = out_.agents[id].path;
  out_.at_entry[id] =
      std::any_of(path.begin(), path.end(), [&](const Piece& piece) { return in_.map.watched[piece.track]; });
}

}  // namespace rodeira::traffic
