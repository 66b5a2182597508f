// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/network/track_plan.hpp"

#include <algorithm>
#include <cmath>

#include "common/traffic/network/kink_way.hpp"
#include "common/world/lanes/ring.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kGradeHalfStep_m = 1.0;
constexpr double kTurn = 0.45;        // rad by which a way must bend to be a turn …
constexpr double kLongTurn_m = 80.0;  // … no longer than this

bool HasOneLimit(const lanes::Graph& graph, std::uint32_t track) {
  const network::LaneKey& key = graph[track].lane;
  const network::Road& road = graph.network().roads()[key.road];
  const double from = road.spec().sections[key.section].s_m, to = road.spec().sections[key.section].end_s_m;
  const auto changes = [&](double s_m) { return s_m > from && s_m <= to; };
  const auto stays = [&](const auto& records) {
    return std::none_of(records.begin(), records.end(), [&](const auto& record) { return changes(record.s_m); });
  };
  const network::Lane& lane = *graph.network().Find(key);
  return stays(lane.speeds) && stays(lane.sign_speeds) && stays(road.spec().types);
}

// To which side a track turns that is one of several ways on.
int TurnDirection(const lanes::Graph& graph, std::uint32_t track) {
  const lanes::Track& at = graph[track];
  const auto on_ring = [&](std::uint32_t other) { return lanes::OnRing(graph, other); };
  if (on_ring(track)) return kRing;
  const auto branches = [&](std::uint32_t before) { return graph[before].next.size() > 1; };
  if (at.length_m() > kLongTurn_m || std::none_of(at.before.begin(), at.before.end(), branches)) return 0;
  if (std::any_of(at.before.begin(), at.before.end(), on_ring)) return at.left_hand ? 1 : -1;
  if (std::any_of(at.next.begin(), at.next.end(), [&](const lanes::Link& link) { return on_ring(link.to); })) return 0;
  const Eigen::Vector2d from = at.curve.At(0.0).ahead_W, to = at.curve.At(at.length_m()).ahead_W;
  const double angle = std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
  return std::fabs(angle) < kTurn ? 0 : angle > 0.0 ? 1 : -1;
}

// A track as vehicles drive it that come onto it round a kink: their path bends behind its beginning.
class BehindKink final : public driver::Way {
 public:
  BehindKink(const lanes::Graph& graph, std::uint32_t track) : track_(graph, track) {
    for (const std::uint32_t before : graph[track].before) {
      for (const lanes::Link& link : graph[before].next) {
        const auto way_m = link.to == track && !link.joins ? KinkWay_m(link.slope) : std::nullopt;
        const double bends_1pm = way_m ? -link.slope * kQuinticBend / *way_m : 0.0;
        if (std::fabs(bends_1pm) > std::fabs(bends_1pm_)) bends_1pm_ = bends_1pm, to_m_ = 0.5 * *way_m;
      }
    }
  }

  double length_m() const override { return track_.length_m(); }
  double SpeedLimit_mps(double d_m) const override { return track_.SpeedLimit_mps(d_m); }
  driver::LaneFrame At(double d_m) const override {
    driver::LaneFrame frame = track_.At(d_m);
    if (d_m < to_m_) frame.curvature_1pm += bends_1pm_;
    return frame;
  }
  double VerticalCurvature_1pm(double d_m) const override { return track_.VerticalCurvature_1pm(d_m); }
  Eigen::Vector3d Position(double d_m, double offset_m) const override { return track_.Position(d_m, offset_m); }
  std::optional<Place> Locate(double x_m, double y_m, std::optional<double> z_m) const override {
    return track_.Locate(x_m, y_m, z_m);
  }

 private:
  TrackWay track_;
  double bends_1pm_ = 0.0, to_m_ = 0.0;
};

}  // namespace

driver::LaneFrame TrackWay::At(double d_m) const {
  const lanes::CurvePoint at = curve().At(std::clamp(d_m, 0.0, length_m()));
  return {at.p_W, std::atan2(at.ahead_W.y(), at.ahead_W.x()), at.curvature_1pm, at.grade};
}

double TrackWay::VerticalCurvature_1pm(double d_m) const {
  const double low = std::max(0.0, d_m - kGradeHalfStep_m), high = std::min(length_m(), d_m + kGradeHalfStep_m);
  return high > low ? (curve().At(high).grade - curve().At(low).grade) / (high - low) : 0.0;
}

Eigen::Vector3d TrackWay::Position(double d_m, double offset_m) const {
  const lanes::CurvePoint at = curve().At(std::clamp(d_m, 0.0, length_m()));
  Eigen::Vector3d p = at.p_W;
  p.head<2>() += offset_m * at.left_W();
  p.z() += offset_m * at.bank;
  return p;
}

std::optional<driver::Way::Place> TrackWay::Locate(double x_m, double y_m, std::optional<double> z_m) const {
  const auto& nodes = curve().nodes();
  const Eigen::Vector2d p(x_m, y_m);
  std::optional<std::size_t> nearest;
  double least = 0.0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (z_m && std::fabs(nodes[i].p_W.z() - *z_m) > network::Network::kLevel_m) continue;
    const double squared = (nodes[i].p_W.head<2>() - p).squaredNorm();
    if (!nearest || squared < least) nearest = i, least = squared;
  }
  if (!nearest) return std::nullopt;
  const lanes::Curve::Foot foot = curve().FootNear(p, *nearest);
  const lanes::CurvePoint at = curve().At(foot.d_m);
  const double along = (p - at.p_W.head<2>()).dot(at.ahead_W);
  if (std::fabs(along) > 1e-6 && (foot.d_m <= 0.0 || foot.d_m >= length_m())) return std::nullopt;
  return Place{foot.d_m, foot.offset_m, std::atan2(at.ahead_W.y(), at.ahead_W.x())};
}

TrackPlan::TrackPlan(const lanes::Graph& graph, std::uint32_t track, const driver::SpeedPlanSettings& settings)
    : plan(BehindKink(graph, track), settings),
      limit_mps(graph.SpeedLimit_mps(track, 0.0)),
      one_limit(HasOneLimit(graph, track)),
      turn(TurnDirection(graph, track)) {
  for (const lanes::LightPlace& light : lanes::LightsOf(graph, track)) lines.push_back({light.d_m, light.controller});
  if (!lines.empty()) return;
  for (const lanes::SignPlace& sign : lanes::SignsOf(graph, track)) {
    if (sign.sign == lanes::Sign::kStop) lines.push_back({sign.d_m, -1});
  }
}

}  // namespace rodeira::traffic
