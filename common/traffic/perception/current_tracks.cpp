// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/perception/current_tracks.hpp"

namespace rodeira::traffic {

void CurrentTracks::LookBelow(std::uint32_t id) {
  CurrentTrackCache& below = out_.below[id];
  const Piece& piece = PieceAt(in_.agents[id].path, in_.agents[id].o_m);
  const std::uint32_t track = piece.track;
  const double d = in_.agents[id].o_m - piece.zero_m;
  if (below.track == track) {
    if (d < below.plan.from_m || d >= below.plan.to_m) below.plan = in_.map.plans[track].plan.Around(d);
    return;
  }
  const lanes::Track& on = in_.map.graph[track];
  below = {track,
           static_cast<std::int32_t>(on.lane.road),
           on.lane.lane,
           !on.next.empty(),
           on.left || on.right,
           on.length_m(),
           on.curve.straight(),
           std::nullopt,
           0.0,
           in_.map.plans[track].plan.Around(d)};
  if (!on.curve.straight() || on.curve.straight()->bank_1pm != 0.0) return;
  below.turned = AttitudeOn(*on.curve.straight());
  below.grade = GradeOf(*below.turned);
}

PathFrame CurrentTracks::FrameOf(std::uint32_t id, double odometer_m) const {
  const Piece& piece = PieceAt(in_.agents[id].path, odometer_m);
  const double d = odometer_m - piece.zero_m;
  const CurrentTrackCache& below = out_.below[id];
  return FrameOn(
      piece,
      below.track == piece.track && below.straight ? below.straight->At(d) : in_.map.graph[piece.track].curve.At(d),
      odometer_m);
}

bool CurrentTracks::HasBeside(std::uint32_t id, std::uint32_t track) const {
  if (out_.below[id].track == track) return out_.below[id].has_beside;
  return in_.map.graph[track].left || in_.map.graph[track].right;
}

const lanes::Curve::Straight* CurrentTracks::StraightBelow(std::uint32_t id) const {
  const Agent& agent = in_.agents[id];
  const Piece& piece = agent.path.front();
  if (agent.path.size() != 1 || piece.offset_m != 0.0 || piece.slope != 0.0 || piece.aside_m != 0.0) return nullptr;
  const auto& straight =
      out_.below[id].track == piece.track ? out_.below[id].straight : in_.map.graph[piece.track].curve.straight();
  return straight ? &*straight : nullptr;
}

}  // namespace rodeira::traffic
