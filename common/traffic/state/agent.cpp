// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/state/agent.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/traffic/lane_change/lane_change.hpp"
#include "common/traffic/network/kink_way.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kBlendAcceleration_mps2 = 1.2;  // lateral acceleration of the move to the next lane's middle
constexpr double kBlendSpeed_mps = 0.8;          // its lateral speed
constexpr double kShortestBlend_m = 3.0;
constexpr double kLongestBlend_m = 90.0;
constexpr std::size_t kPieceNumbers = 7;

// What Save lines up for the writer; used again, so that a digest of the state allocates nothing.
struct SaveLists {
  std::vector<double> grants_to, grants_light, pieces;
  std::vector<std::uint64_t> grants_told;
  std::vector<std::uint32_t> tracks;

  void Clear() {
    for (auto* list : {&grants_to, &grants_light, &pieces}) list->clear();
    grants_told.clear();
    tracks.clear();
  }
};

}  // namespace

void Agent::Save(base::StateWriter& writer) const {
  writer.Put("on_road", on_road);
  writer.Put("is_struck", is_crashed);
  writer.Put("struck", crashed);
  writer.Put("struck_z_m", crashed_z_m);
  writer.Put("entry", entry);
  writer.Put("trip", trip);
  writer.Put("flow", flow);
  writer.Put("arrival", arrival);
  writer.Put("links", links);
  writer.Put("leg", leg);
  writer.Put("o_m", o_m);
  writer.Put("speed_mps", speed_mps);
  writer.Put("acceleration_mps2", acceleration_mps2);
  writer.Put("wish_mps2", desired_mps2);
  writer.Put("driven_m", driven_m);
  writer.Put("fuel_mg", fuel_mg);
  writer.Put("fuel_mgps", fuel_mgps);
  writer.Put("throttle", driving.throttle);
  writer.Put("brake", driving.brake);
  writer.Put("clutch", driving.clutch);
  writer.Put("engine_radps", driving.engine_radps);
  writer.Put("gear", driving.gear);
  writer.Put("gear_s", driving.gear_s);
  writer.Put("brake_mps2", brake_mps2);
  writer.Put("cap_mps", cap_mps);
  writer.Put("told_side", told_side);
  writer.Put("told_past", told_past);
  writer.Put("granted_m", granted_m);
  thread_local SaveLists lists;
  lists.Clear();
  auto& [grants_to, grants_light, pieces, grants_told, tracks] = lists;
  for (const ZoneGrant& grant : grants) {
    grants_to.push_back(grant.to_m);
    grants_told.insert(grants_told.end(),
                       {grant.number, 2 * static_cast<std::uint64_t>(grant.light + 1) + (grant.sure ? 1u : 0u)});
    grants_light.push_back(grant.light_m);
  }
  for (const ZoneGrant& grant : grants) {
    if (grant.light >= 0) grants_to.push_back(grant.clear_m);
  }
  writer.Put("grants_to", grants_to);  // after them the ends of those that wait
  writer.Put("grants_told", grants_told);
  writer.Put("grants_light", grants_light);
  writer.Put("stopped_m", stopped_m);
  writer.Put("waited_s", waited_s);
  writer.Put("change_side", change.side);
  writer.Put("change_from_m", change.from_m);
  writer.Put("change_to_m", change.to_m);
  writer.Put("settled_ns", settled_ns);
  writer.Put("eased_for", eased_for);
  writer.Put("seeks", seeks);
  writer.Put("overtaking", overtaking);
  for (const Piece& piece : path) {
    tracks.push_back(piece.track);
    pieces.insert(pieces.end(), {piece.zero_m, piece.begin_m, piece.offset_m, piece.slope, piece.blend_m,
                                 piece.blend_from_m, piece.aside_m});
  }
  writer.Put("tracks", tracks);
  writer.Put("pieces", pieces);
}

void Agent::Restore(base::StateReader& reader) {
  reader.Get("on_road", on_road);
  reader.Get("is_struck", is_crashed);
  reader.Get("struck", crashed);
  reader.Get("struck_z_m", crashed_z_m);
  reader.Get("entry", entry);
  reader.Get("trip", trip);
  reader.Get("flow", flow);
  reader.Get("arrival", arrival);
  reader.Get("links", links);
  reader.Get("leg", leg);
  reader.Get("o_m", o_m);
  reader.Get("speed_mps", speed_mps);
  reader.Get("acceleration_mps2", acceleration_mps2);
  reader.Get("wish_mps2", desired_mps2);
  reader.Get("driven_m", driven_m);
  reader.Get("fuel_mg", fuel_mg);
  reader.Get("fuel_mgps", fuel_mgps);
  reader.Get("throttle", driving.throttle);
  reader.Get("brake", driving.brake);
  reader.Get("clutch", driving.clutch);
  reader.Get("engine_radps", driving.engine_radps);
  reader.Get("gear", driving.gear);
  reader.Get("gear_s", driving.gear_s);
  reader.Get("brake_mps2", brake_mps2);
  reader.Get("cap_mps", cap_mps);
  reader.Get("told_side", told_side);
  told_side = std::clamp(told_side, -1, 1);
  reader.Get("told_past", told_past);
  reader.Get("granted_m", granted_m);
  std::vector<double> grants_to, grants_light;
  std::vector<std::uint64_t> grants_told;
  reader.Get("grants_to", grants_to);
  reader.Get("grants_told", grants_told);
  reader.Get("grants_light", grants_light);
  grants.clear();
  const std::size_t count = std::min({grants_to.size(), grants_told.size() / 2, grants_light.size()});
  std::size_t clear = count;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t told = grants_told[2 * i + 1];
    ZoneGrant grant{grants_to[i], grants_told[2 * i], told % 2 != 0, grants_light[i], grants_to[i]};
    grant.light = static_cast<std::int64_t>(told / 2) - 1;
    if (grant.light >= 0 && clear < grants_to.size()) grant.clear_m = grants_to[clear++];
    grants.push_back(grant);
  }
  reader.Get("stopped_m", stopped_m);
  reader.Get("waited_s", waited_s);
  reader.Get("change_side", change.side);
  reader.Get("change_from_m", change.from_m);
  reader.Get("change_to_m", change.to_m);
  reader.Get("settled_ns", settled_ns);
  reader.Get("eased_for", eased_for);
  reader.Get("seeks", seeks);
  reader.Get("overtaking", overtaking);
  std::vector<std::uint32_t> tracks;
  std::vector<double> numbers;
  reader.Get("tracks", tracks);
  reader.Get("pieces", numbers);
  path.clear();
  for (std::size_t i = 0; i < tracks.size() && kPieceNumbers * (i + 1) <= numbers.size(); ++i) {
    const double* at = &numbers[kPieceNumbers * i];
    path.push_back({tracks[i], at[0], at[1], at[2], at[3], at[4], at[5], at[6]});
  }
  on_road = on_road && !is_crashed && !path.empty();
}

PathFrame FrameAt(const lanes::Graph& graph, const Path& path, double odometer_m) {
  const Piece& piece = PieceAt(path, odometer_m);
  return FrameOn(piece, graph[piece.track].curve.At(odometer_m - piece.zero_m), odometer_m);
}

// Quintic from (offset, slope) at u = 0 to rest beside the middle at u = 1.
PathFrame FrameOn(const Piece& piece, const lanes::CurvePoint& at, double odometer_m) {
  PathFrame frame;
  frame.p_W = at.p_W;
  frame.ahead_W = at.ahead_W;
  frame.curvature_1pm = at.curvature_1pm;
  frame.bank = at.bank;
  frame.stretch = at.rate;
  const double u = (odometer_m - piece.blend_from_m) / piece.blend_m;
  const bool blends = u < 1.0 && u >= 0.0 && (piece.offset_m != 0.0 || piece.slope != 0.0);
  if (!blends && piece.aside_m == 0.0) return frame;
  const double u1 = blends ? u : 1.0, u2 = u1 * u1, u3 = u2 * u1, L = piece.blend_m;
  const double e = piece.aside_m + piece.offset_m * (1.0 - u3 * (10.0 - 15.0 * u1 + 6.0 * u2)) +
                   piece.slope * L * (u1 - u3 * (6.0 - 8.0 * u1 + 3.0 * u2));
  const double e1 = -piece.offset_m / L * 30.0 * u2 * (1.0 - 2.0 * u1 + u2) +
                    piece.slope * (1.0 - u2 * (18.0 - 32.0 * u1 + 15.0 * u2));
  const double e2 = -piece.offset_m / (L * L) * u1 * (60.0 - 180.0 * u1 + 120.0 * u2) -
                    piece.slope / L * u1 * (36.0 - 96.0 * u1 + 60.0 * u2);
  const Eigen::Vector2d left = at.left_W();
  const double along = at.rate * (1.0 - at.curvature_1pm * e);
  frame.p_W.head<2>() += e * left;
  frame.p_W.z() += e * at.bank;
  frame.stretch = std::hypot(along, e1);
  frame.ahead_W = (along * at.ahead_W + e1 * left) / frame.stretch;
  frame.curvature_1pm += e2;
  frame.offset_m = e;
  frame.slope = e1 / std::max(0.2, along);
  return frame;
}

Piece Onward(const lanes::Graph& graph, const Path& path, const lanes::Link& link, double speed_mps) {
  const Piece& last = path.back();
  Piece piece;
  piece.track = link.to;
  piece.begin_m = last.zero_m + graph[last.track].length_m();
  piece.zero_m = piece.begin_m - link.from_d_m;
  piece.blend_from_m = piece.begin_m;
  if ((last.aside_m != 0.0 || piece.begin_m < last.blend_from_m + last.blend_m) &&
      std::fabs(link.offset_m) < kSameLaneOffset_m && std::fabs(link.slope) < kSameLaneSlope) {
    piece.offset_m = last.offset_m, piece.slope = last.slope, piece.blend_m = last.blend_m,
    piece.blend_from_m = last.blend_from_m, piece.aside_m = last.aside_m;
    return piece;  // the lane goes on, and so does the change to its middle
  }
  const PathFrame end = FrameAt(graph, path, piece.begin_m);
  piece.offset_m = link.offset_m + end.offset_m;
  piece.slope = link.slope + end.slope;
  // The quintic's largest acceleration is 5.77 offset/blend² v², its largest speed 1.875 offset/blend v.
  const double size = std::fabs(piece.offset_m);
  const double wanted =
      std::max({speed_mps * std::sqrt(5.77 * size / kBlendAcceleration_mps2),
                1.875 * speed_mps * size / kBlendSpeed_mps, 6.0 * size, 4.0 * speed_mps * std::fabs(piece.slope)});
  piece.blend_m = std::clamp(wanted, kShortestBlend_m, KinkWay_m(link.slope).value_or(kLongestBlend_m));
  return piece;
}

}  // namespace rodeira::traffic
