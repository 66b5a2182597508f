// SPDX-License-Identifier: Apache-2.0
#include "common/world/lanes/curve.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/assert.hpp"
#include "common/core/geometry/plane.hpp"

namespace rodeira::lanes {
namespace {

constexpr double kNode_m = 1.0;
constexpr double kShortest_m = 1e-6;  // between nodes
constexpr double kTold = 1e-6;        // m, and of directions, grades, banks; 1/m
constexpr double kStraight = 1e-9;    // m a m, and 1/m: less is straight
constexpr double kAside_m = 0.7;      // over twice this the bank is measured

struct Motion {
  Eigen::Vector3d p_W, v_W;  // v by s
  double bank = 0.0, width_m = 0.0;
  Eigen::Vector2d road_W;  // the way of the road's line, of unit length
};

constexpr double kWide_m = 3.0;     // from this width on traffic keeps to the middle
constexpr double kInside_m = 1.25;  // beside the edge of a lane without width
constexpr double kNarrow_m = 1.5;   // a lane that is somewhere narrower opens or ends
constexpr int kWidthSamples = 20;

// To which side traffic of a lane that opens or ends gives way: 1 to the inner edge, -1 to the outer one, 0 there is
// none.
int GivesWay(const network::Network& network, const network::LaneKey& key) {
  const network::LaneSection& section = network.Section(key);
  double narrowest = kWide_m;
  for (int i = 0; i <= kWidthSamples; ++i) {
    const auto span = network.Span(key, section.s_m + (section.end_s_m - section.s_m) * i / kWidthSamples);
    narrowest = std::min(narrowest, span->width_m());
  }
  if (narrowest > kNarrow_m) return 0;
  const int outward = key.lane > 0 ? 1 : -1, direction = section.Find(key.lane)->direction;
  const auto beside = [&](int id) {
    const network::Lane* lane = id == 0 ? nullptr : section.Find(id);
    return lane != nullptr && network::IsDrivable(lane->type) && lane->direction == direction;
  };
  return beside(key.lane - outward) ? 1 : beside(key.lane + outward) ? -1 : 0;
}

Motion MotionAt(const network::Network& network, const network::LaneKey& lane, int gives_way, double s_m) {
  const network::Road& road = network.roads()[lane.road];
  const double s = road.Held(lane.section, s_m);
  const auto span = network.Span(lane, s);
  double t = span->centre_t_m(), slope = 0.5 * (span->inner_slope + span->outer_slope);
  const double width = span->width_m();
  if (gives_way != 0 && width < kWide_m) {
    const double outward = lane.lane > 0 ? 1.0 : -1.0, lack = 1.0 - width / kWide_m;
    t -= gives_way * outward * kInside_m * lack * lack;
    slope += gives_way * 2.0 * kInside_m * lack / kWide_m * (span->outer_slope - span->inner_slope);
  }
  const network::SurfaceSample at = road.Surface(s, t);
  double bank = at.dt_W.z() / std::max(1e-9, at.dt_W.head<2>().norm());
  const double aside = std::min(kAside_m, 0.4 * width);
  if (aside > 0.1) {
    const Eigen::Vector3d across = road.Surface(s, t + aside).p_W - road.Surface(s, t - aside).p_W;
    bank = across.z() / std::max(1e-9, across.head<2>().norm());
  }
  const Eigen::Vector2d across_W = at.dt_W.head<2>().normalized();
  return {at.p_W, at.ds_W + slope * at.dt_W, bank, width, {across_W.y(), -across_W.x()}};
}

// The cubic with both nodes' tangents; curvature and bank go over evenly.
CurvePoint Between(const Curve::Node& a, const Curve::Node& b, double d_m) {
  const double h = b.d_m - a.d_m, x = (d_m - a.d_m) / h, y = 1.0 - x;
  CurvePoint point;
  point.p_W =
      y * y * (1.0 + 2.0 * x) * a.p_W + x * x * (3.0 - 2.0 * x) * b.p_W + h * x * y * (y * a.along_W - x * b.along_W);
  const Eigen::Vector3d v =
      6.0 * x * y / h * (b.p_W - a.p_W) + y * (y - 2.0 * x) * a.along_W + x * (x - 2.0 * y) * b.along_W;
  const double speed = std::max(1e-9, v.head<2>().norm());
  point.ahead_W = v.head<2>() / speed;
  point.rate = speed;
  point.grade = v.z() / speed;
  point.curvature_1pm = y * a.curvature_1pm + x * b.curvature_1pm;
  point.bank = y * a.bank + x * b.bank;
  return point;
}

constexpr double kFolds = 0.1;      // m a metre of the road's line: a middle that advances less folds
constexpr double kAdvances = 0.25;  // m a metre of the road's line, from one node to the next of a lane that folds
constexpr double kFoldedNode_m = 0.5;

bool Advances(const Curve::Node& a, const Curve::Node& b) {
  const Eigen::Vector2d chord_W = (b.p_W - a.p_W).head<2>();
  const double least = kAdvances * std::fabs(b.s_m - a.s_m);
  return chord_W.dot(a.along_W.head<2>()) > least && chord_W.dot(b.along_W.head<2>()) > least;
}

// The length of the arc with these nodes' tangents, about.
double ArcLength_m(const Curve::Node& a, const Curve::Node& b) {
  const Eigen::Vector2d from = a.along_W.head<2>(), to = b.along_W.head<2>();
  const double half = 0.5 * std::fabs(std::atan2(geometry::Cross(from, to), from.dot(to)));
  const double stretch = half < 1e-6 ? 1.0 : half / std::sin(half);
  return std::max(kShortest_m, stretch * (b.p_W - a.p_W).head<2>().norm());
}

// A lane's middle on the inner side of a bend that is tighter than the lane is far from the road's line goes back, or
// stands. Without the nodes there it advances everywhere; new ones lie on the cubics between the others.
std::vector<Curve::Node> Unfolded(const std::vector<Curve::Node>& nodes, const std::vector<bool>& folds) {
  std::vector<Curve::Node> kept{nodes.front()};
  for (std::size_t i = 1; i + 1 < nodes.size(); ++i) {
    if (!folds[i] && Advances(kept.back(), nodes[i])) kept.push_back(nodes[i]);
  }
  while (kept.size() > 1 && !Advances(kept.back(), nodes.back())) kept.pop_back();
  kept.push_back(nodes.back());
  std::vector<Curve::Node> all{kept.front()};
  for (std::size_t i = 1; i < kept.size(); ++i) {
    Curve::Node from = kept[i - 1], to = kept[i];
    from.d_m = 0.0, to.d_m = ArcLength_m(from, to);
    const int parts = std::max(1, static_cast<int>(std::ceil(to.d_m / kFoldedNode_m)));
    for (int part = 1; part < parts; ++part) {
      const double x = static_cast<double>(part) / parts;
      const CurvePoint at = Between(from, to, x * to.d_m);
      Curve::Node node = to;
      node.s_m = from.s_m + x * (to.s_m - from.s_m);
      node.p_W = at.p_W;
      node.along_W << at.ahead_W, at.grade;
      node.bank = at.bank;
      node.width_m = from.width_m + x * (to.width_m - from.width_m);
      all.push_back(node);
    }
    all.push_back(to);
  }
  all.front().d_m = 0.0;
  for (std::size_t i = 1; i < all.size(); ++i) all[i].d_m = all[i - 1].d_m + ArcLength_m(all[i - 1], all[i]);
  return all;
}

}  // namespace

Curve::Curve(const network::Network& network, const network::LaneKey& lane, bool along) {
  const network::LaneSection& section = network.Section(lane);
  const double length = section.end_s_m - section.s_m;
  const int count = std::max(1, static_cast<int>(std::ceil(length / kNode_m)));
  const auto station = [&](double i) {
    return along ? section.s_m + length * i / count : section.end_s_m - length * i / count;
  };
  const int gives_way = GivesWay(network, lane);
  double d = 0.0;
  std::vector<bool> folds;
  bool any_folds = false;
  for (int i = 0; i <= count; ++i) {
    if (i > 0) {  // Gauss's rule of two points
      const double off = 0.5 / std::sqrt(3.0);
      const double speed = MotionAt(network, lane, gives_way, station(i - 0.5 - off)).v_W.head<2>().norm() +
                           MotionAt(network, lane, gives_way, station(i - 0.5 + off)).v_W.head<2>().norm();
      d += std::max(kShortest_m, 0.5 * length / count * speed);
    }
    const Motion at = MotionAt(network, lane, gives_way, station(i));
    const double speed = std::max(1e-9, at.v_W.head<2>().norm());
    nodes_.push_back({d, station(i), at.p_W, (along ? at.v_W : Eigen::Vector3d(-at.v_W)) / speed, 0.0,
                      along ? at.bank : -at.bank, at.width_m});
    folds.push_back(at.v_W.head<2>().dot(at.road_W) < kFolds);
    const double advance_m = i == 0 ? length
                                    : (nodes_.back().p_W - nodes_[nodes_.size() - 2].p_W)
                                          .head<2>()
                                          .dot(nodes_[nodes_.size() - 2].along_W.head<2>());
    any_folds = any_folds || folds.back() || advance_m < kFolds * length / count;
    if (folds.back()) nodes_.back().along_W << (along ? at.road_W : Eigen::Vector2d(-at.road_W)), 0.0;
  }
  if (any_folds) nodes_ = Unfolded(nodes_, folds);
  length_m_ = nodes_.back().d_m;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& low = nodes_[i == 0 ? 0 : i - 1];
    const Node& high = nodes_[std::min(i + 1, nodes_.size() - 1)];
    const Eigen::Vector2d a = low.along_W.head<2>(), b = high.along_W.head<2>();
    nodes_[i].curvature_1pm = std::atan2(geometry::Cross(a, b), a.dot(b)) / (high.d_m - low.d_m);
  }
  FindBends();
}

std::size_t Curve::Before(double d_m) const {
  const std::size_t last = nodes_.size() - 2;
  if (!(d_m > 0.0)) return 0;
  std::size_t i = std::min(last, static_cast<std::size_t>(d_m / length_m() * static_cast<double>(nodes_.size() - 1)));
  while (i > 0 && nodes_[i].d_m > d_m) --i;
  while (i < last && nodes_[i + 1].d_m <= d_m) ++i;
  return i;
}

bool Curve::Tells(std::size_t from, std::size_t to) const {
  for (std::size_t i = from + 1; i < to; ++i) {
    const CurvePoint at = Between(nodes_[from], nodes_[to], nodes_[i].d_m);
    const Node& node = nodes_[i];
    if ((at.p_W - node.p_W).cwiseAbs().maxCoeff() > kTold ||
        (at.ahead_W - node.along_W.head<2>()).cwiseAbs().maxCoeff() > kTold)
      return false;
    if (std::fabs(at.grade - node.along_W.z()) > kTold || std::fabs(at.rate - 1.0) > kTold) return false;
    if (std::fabs(at.curvature_1pm - node.curvature_1pm) > kTold || std::fabs(at.bank - node.bank) > kTold)
      return false;
  }
  return true;
}

// From each the farthest that is found by doubling, then halving.
void Curve::FindBends() {
  const std::size_t last = nodes_.size() - 1;
  std::size_t from = 0;
  bends_.push_back(nodes_[0]);
  while (from < last) {
    std::size_t step = 1;
    while (from + 2 * step <= last && Tells(from, from + 2 * step)) step *= 2;
    std::size_t to = from + step;
    for (; step > 0; step /= 2) {
      if (to + step <= last && Tells(from, to + step)) to += step;
    }
    bends_.push_back(nodes_[to]);
    from = to;
  }
  for (const Node& bend : bends_) bends_d_m_.push_back(bend.d_m);
  const Node &a = bends_.front(), &b = bends_.back();
  const double h = b.d_m - a.d_m;
  const auto is_along = [&](const Eigen::Vector3d& along_W) {
    return ((b.p_W - a.p_W) / h - along_W).cwiseAbs().maxCoeff() < kStraight;
  };
  if (bends_.size() > 2 || !is_along(a.along_W) || !is_along(b.along_W)) return;
  if (std::fabs(a.curvature_1pm) > kStraight || std::fabs(b.curvature_1pm) > kStraight) return;
  straight_ = {a.p_W, a.along_W, a.bank, (b.bank - a.bank) / h, length_m_};
}

CurvePoint Curve::At(double d_m) const {
  if (straight_) return straight_->At(d_m);
  if (d_m < 0.0 || d_m > length_m()) {
    CurvePoint point;
    const Node& end = d_m < 0.0 ? bends_.front() : bends_.back();
    point.p_W = end.p_W + (d_m - end.d_m) * end.along_W;
    point.ahead_W = end.along_W.head<2>();
    point.grade = end.along_W.z();
    point.bank = end.bank;
    return point;
  }
  const auto after = std::upper_bound(bends_d_m_.begin() + 1, bends_d_m_.end() - 1, d_m);
  const Node* a = &bends_[static_cast<std::size_t>(after - bends_d_m_.begin()) - 1];
  return Between(a[0], a[1], d_m);
}

double Curve::WidthAt(double d_m) const {
  const std::size_t i = Before(d_m);
  const double x = std::clamp((d_m - nodes_[i].d_m) / (nodes_[i + 1].d_m - nodes_[i].d_m), 0.0, 1.0);
  return nodes_[i].width_m + x * (nodes_[i + 1].width_m - nodes_[i].width_m);
}

double Curve::StationAt(double d_m) const {
  const std::size_t i = Before(d_m);
  const double x = std::clamp((d_m - nodes_[i].d_m) / (nodes_[i + 1].d_m - nodes_[i].d_m), 0.0, 1.0);
  return nodes_[i].s_m + x * (nodes_[i + 1].s_m - nodes_[i].s_m);
}

double Curve::AtStation(double s_m) const {
  const bool grows = nodes_.back().s_m > nodes_.front().s_m;
  const auto after = std::partition_point(nodes_.begin() + 1, nodes_.end() - 1,
                                          [&](const Node& node) { return grows ? node.s_m < s_m : node.s_m > s_m; });
  const Node &a = *(after - 1), &b = *after;
  return a.d_m + std::clamp((s_m - a.s_m) / (b.s_m - a.s_m), 0.0, 1.0) * (b.d_m - a.d_m);
}

Curve::Foot Curve::FootNear(const Eigen::Vector2d& p_W, std::size_t node) const {
  RODEIRA_ASSERT(node < nodes_.size());
  const double low = nodes_[node < 3 ? 0 : node - 3].d_m, high = nodes_[std::min(node + 3, nodes_.size() - 1)].d_m;
  double d = nodes_[node].d_m;
  for (int turn = 0; turn < 6; ++turn) {
    const CurvePoint at = At(d);
    const double along = (p_W - at.p_W.head<2>()).dot(at.ahead_W);
    const double offset = geometry::Cross(at.ahead_W, p_W - at.p_W.head<2>());
    d = std::clamp(d + along / std::max(0.2, 1.0 - at.curvature_1pm * offset), low, high);
    if (std::fabs(along) < 1e-9) break;
  }
  const CurvePoint at = At(d);
  return {d, geometry::Cross(at.ahead_W, p_W - at.p_W.head<2>())};
}

}  // namespace rodeira::lanes
