// SPDX-License-Identifier: Apache-2.0
#include "common/world/lanes/foot_crossings.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/world/lanes/lights.hpp"
#include "common/world/network/placing.hpp"

namespace rodeira::lanes {
namespace {

using Eigen::Vector2d;

constexpr const char* kCrossingSign = "293";
constexpr double kUsual_m = 4.0;  // along the road, where nothing is said
constexpr double kStep_m = 0.25;  // along tracks
constexpr double kBody_m = 0.3;   // half of a person, and what a car may be beside its path
constexpr double kSpare_m = 0.3;
constexpr double kKerb_m = 0.2;          // from cars to a waiting pedestrian
constexpr double kFarthestKerb_m = 6.0;  // from the crossing's paint
constexpr double kBeyond_m = 4.0;        // people are seen so far from the kerb, if no car comes there
constexpr double kEdge_m = 0.4;          // of the paint, where no person walks
constexpr double kLightBefore_m = 20.0, kLightNear_m = 6.0;
constexpr double kShortEdge_m = 0.5;

// A described crossing: its corners, in W.
struct Shape {
  std::vector<Vector2d> corners;
  Vector2d middle() const {
    Vector2d sum = Vector2d::Zero();
    for (const Vector2d& corner : corners) sum += corner;
    return sum / static_cast<double>(corners.size());
  }
};

void AddRectangle(const Vector2d& middle, double heading_rad, double length_m, double width_m, Shape& shape) {
  const Vector2d ahead(std::cos(heading_rad), std::sin(heading_rad)), left(-ahead.y(), ahead.x());
  for (const auto& [x, y] : {std::pair(-0.5, -0.5), std::pair(0.5, -0.5), std::pair(0.5, 0.5), std::pair(-0.5, 0.5)})
    shape.corners.push_back(middle + x * length_m * ahead + y * width_m * left);
}

Shape ShapeOf(const network::Road& road, const network::Placed& placed) {
  Shape shape;
  if (placed.object->outlines.empty()) {
    AddRectangle(placed.foot_W.head<2>(), placed.heading_rad, placed.length_m > 0.0 ? placed.length_m : kUsual_m,
                 placed.width_m, shape);
    return shape;
  }
  const Vector2d ahead(std::cos(placed.heading_rad), std::sin(placed.heading_rad)), left(-ahead.y(), ahead.x());
  for (const network::Corner& corner : placed.object->outlines.front().corners) {
    shape.corners.push_back(corner.local
                                ? (placed.foot_W.head<2>() + corner.first_m * ahead + corner.second_m * left).eval()
                                : road.Surface(corner.first_m, corner.second_m).p_W.head<2>().eval());
  }
  return shape;
}

// Across all lanes that are driven on.
Shape ShapeOfSign(const network::Road& road, const network::Signal& signal) {
  const double length = std::min(signal.value.value_or(0.0) > 0.0 ? *signal.value : kUsual_m, road.length_m());
  const double s = std::clamp(signal.s_m, 0.5 * length, road.length_m() - 0.5 * length);
  double right = 1e9, left = -1e9;
  const std::size_t section = road.SectionIndex(s);
  for (const auto* side : {&road.SectionAt(s).right, &road.SectionAt(s).left}) {
    for (const network::Lane& lane : *side) {
      const auto span = network::IsDrivable(lane.type) ? road.SpanAt(section, lane.id, s) : std::nullopt;
      if (span)
        right = std::min({right, span->inner_t_m, span->outer_t_m}),
        left = std::max({left, span->inner_t_m, span->outer_t_m});
    }
  }
  Shape shape;
  if (left > right)
    AddRectangle(road.Surface(s, 0.5 * (left + right)).p_W.head<2>(), road.axis().Evaluate(s).heading_rad, length,
                 left - right, shape);
  return shape;
}

class Finder {
 public:
  Finder(const Graph& graph, const LargestCar& car) : graph_(graph), car_(car) {}

  std::optional<FootCrossing> Find(const Shape& shape, double z_m) const {
    FootCrossing crossing;
    const Vector2d middle = shape.middle();
    double reach = 0.0;
    for (const Vector2d& corner : shape.corners) reach = std::max(reach, (corner - middle).norm());
    const auto traffic = DirectionOfTraffic(middle, reach, z_m);
    if (!traffic) return std::nullopt;
    crossing.across_W = Across(shape, *traffic);
    const Vector2d along = crossing.left_W();
    double low = 0.0, high = 0.0, half = 0.0;
    for (const Vector2d& corner : shape.corners) {
      low = std::min(low, (corner - middle).dot(crossing.across_W)),
      high = std::max(high, (corner - middle).dot(crossing.across_W));
      half = std::max(half, std::fabs((corner - middle).dot(along)));
    }
    crossing.half_width_m = std::max(0.0, half - kEdge_m);
    crossing.begin_W = middle;
    auto passes = Passes(crossing, low - 2.0 * kFarthestKerb_m, high + 2.0 * kFarthestKerb_m, z_m);
    const double paint_low = low, paint_high = high;
    std::sort(passes.begin(), passes.end(), [](const FootPass& a, const FootPass& b) {
      return a.from_m != b.from_m ? a.from_m < b.from_m : a.track < b.track;
    });
    for (bool moved = true; moved;) {  // the kerbs lie where no car comes
      moved = false;
      for (const FootPass& pass : passes) {
        if (pass.to_m < low - kKerb_m + 1e-9 || pass.from_m > high + kKerb_m - 1e-9) continue;
        if (pass.from_m - kKerb_m < low) low = pass.from_m - kKerb_m, moved = true;
        if (pass.to_m + kKerb_m > high) high = pass.to_m + kKerb_m, moved = true;
      }
      if (paint_low - low > kFarthestKerb_m || high - paint_high > kFarthestKerb_m) return std::nullopt;
    }
    crossing.before_m = crossing.after_m = kBeyond_m;
    for (FootPass& pass : passes) {
      if (pass.to_m < low)
        crossing.before_m = std::clamp(low - kKerb_m - pass.to_m, 0.0, crossing.before_m);
      else if (pass.from_m > high)
        crossing.after_m = std::clamp(pass.from_m - kKerb_m - high, 0.0, crossing.after_m);
      else
        crossing.passes.push_back(
            {pass.track, pass.in_m, pass.out_m, pass.from_m - low, pass.to_m - low, LightBefore(pass)});
    }
    if (crossing.passes.empty()) return std::nullopt;
    std::sort(crossing.passes.begin(), crossing.passes.end(), [](const FootPass& a, const FootPass& b) {
      return a.track != b.track ? a.track < b.track : a.in_m < b.in_m;
    });
    crossing.begin_W = middle + low * crossing.across_W;
    crossing.length_m = high - low;
    FindHeights(z_m, crossing);
    return crossing;
  }

 private:
  // Of the tracks near its middle, whichever way they are driven.
  std::optional<Vector2d> DirectionOfTraffic(const Vector2d& middle_W, double reach_m, double z_m) const {
    Vector2d doubled = Vector2d::Zero();
    for (const Graph::Beside& beside : graph_.TracksAt(middle_W, reach_m + kFarthestKerb_m)) {
      const CurvePoint at = graph_[beside.track].curve.At(beside.foot.d_m);
      if (std::fabs(at.p_W.z() - z_m) > network::Network::kLevel_m || (at.p_W.head<2>() - middle_W).norm() > reach_m)
        continue;
      doubled += Vector2d(at.ahead_W.x() * at.ahead_W.x() - at.ahead_W.y() * at.ahead_W.y(),
                          2.0 * at.ahead_W.x() * at.ahead_W.y());
    }
    if (doubled.norm() < 1e-6) return std::nullopt;
    const double angle = 0.5 * std::atan2(doubled.y(), doubled.x());
    return Vector2d(std::cos(angle), std::sin(angle));
  }
  // That of its edges which is most across the traffic, pointing to the traffic's left; square across where none is.
  static Vector2d Across(const Shape& shape, const Vector2d& traffic_W) {
    const Vector2d square(-traffic_W.y(), traffic_W.x());
    Vector2d best = square;
    double most = 0.8;
    for (std::size_t i = 0; i < shape.corners.size(); ++i) {
      const Vector2d edge = shape.corners[(i + 1) % shape.corners.size()] - shape.corners[i];
      if (edge.norm() < kShortEdge_m) continue;
      const double across = edge.normalized().dot(square);
      if (std::fabs(across) > most + 1e-9)
        most = std::fabs(across), best = across < 0.0 ? (-edge.normalized()).eval() : edge.normalized().eval();
    }
    return best;
  }
  // Where cars on tracks come to the walkway, u from begin_W on.
  std::vector<FootPass> Passes(const FootCrossing& crossing, double low_m, double high_m, double z_m) const {
    std::vector<FootPass> passes;
    const Vector2d middle = crossing.begin_W + 0.5 * (low_m + high_m) * crossing.across_W;
    const double reach = 0.5 * (high_m - low_m) + crossing.half_width_m + 3.0;
    for (std::uint32_t track = 0; track < graph_.tracks().size(); ++track) {
      const Curve& curve = graph_[track].curve;
      const auto near = [&](const Curve::Node& node) { return (node.p_W.head<2>() - middle).norm() < reach + 1.0; };
      auto node = std::find_if(curve.nodes().begin(), curve.nodes().end(), near);
      std::optional<FootPass> pass;
      for (; node != curve.nodes().end(); ++node) {  // nodes are at most a metre apart
        if (!near(*node) || std::fabs(node->p_W.z() - z_m) > network::Network::kLevel_m) continue;
        for (double d = std::max(0.0, node->d_m - 0.5); d <= std::min(curve.length_m(), node->d_m + 0.5) + 1e-9;
             d += kStep_m) {
          const auto touched = Touched(crossing, curve.At(std::min(d, curve.length_m())), low_m, high_m);
          if (!touched) continue;
          if (pass && d > pass->out_m + 3.0) passes.push_back(*pass), pass.reset();
          if (!pass) pass = FootPass{track, d - kStep_m, d + kStep_m, touched->first, touched->second};
          pass->out_m = std::max(pass->out_m, d + kStep_m);
          pass->from_m = std::min(pass->from_m, touched->first), pass->to_m = std::max(pass->to_m, touched->second);
        }
      }
      if (pass) passes.push_back(*pass);
    }
    return passes;
  }
  // The part of the walk that is touched by the widest car's cross-section at a point of its path.
  std::optional<std::pair<double, double>> Touched(const FootCrossing& crossing, const CurvePoint& at, double low_m,
                                                   double high_m) const {
    const double half = HalfSwath_m(at.curvature_1pm, car_) + kBody_m + kSpare_m,
                 walk = crossing.half_width_m + kBody_m;
    const Vector2d away = at.p_W.head<2>() - crossing.begin_W, left = at.left_W();
    const double u = away.dot(crossing.across_W), v = away.dot(crossing.left_W()), du = left.dot(crossing.across_W),
                 dv = left.dot(crossing.left_W());
    double from = -half, to = half;  // along the cross-section
    if (std::fabs(dv) < 1e-9) {
      if (std::fabs(v) > walk) return std::nullopt;
    } else {
      const double a = (-walk - v) / dv, b = (walk - v) / dv;
      from = std::max(from, std::min(a, b)), to = std::min(to, std::max(a, b));
    }
    if (from > to) return std::nullopt;
    const double first = std::min(u + from * du, u + to * du), last = std::max(u + from * du, u + to * du);
    if (last < low_m || first > high_m) return std::nullopt;
    return std::pair(first, last);
  }
  // On its track, or on those that alone lead to it.
  std::int64_t LightBefore(const FootPass& pass) const {
    std::uint32_t track = pass.track;
    double d = pass.in_m, back = 0.0;
    while (true) {
      const auto lights = LightsOf(graph_, track);
      for (auto light = lights.rbegin(); light != lights.rend(); ++light) {
        if (light->d_m <= d + 1.0)
          return back + d - light->d_m <= kLightBefore_m ? static_cast<std::int64_t>(light->controller) : -1;
      }
      back += d;
      if (back > kLightBefore_m || graph_[track].before.size() != 1 || graph_[track].junction >= 0) return -1;
      track = graph_[track].before.front();
      d = graph_[track].length_m();
    }
  }
  // Of the roads; beside them as at their edge.
  void FindHeights(double z_m, FootCrossing& crossing) const {
    const auto count = static_cast<std::size_t>((crossing.before_m + crossing.length_m + crossing.after_m) /
                                                FootCrossing::kHeightStep_m) +
                       2;
    crossing.heights_m.assign(count, z_m);
    const auto middle =
        static_cast<std::size_t>((crossing.before_m + 0.5 * crossing.length_m) / FootCrossing::kHeightStep_m);
    const auto height = [&](std::size_t i, double near_m) {
      const Vector2d p = crossing.begin_W +
                         (static_cast<double>(i) * FootCrossing::kHeightStep_m - crossing.before_m) * crossing.across_W;
      const auto place = graph_.network().Locate(p.x(), p.y(), near_m);
      return place && place->distance_m <= 0.0 && std::fabs(place->z_m - near_m) < network::Network::kLevel_m
                 ? place->z_m
                 : near_m;
    };
    for (std::size_t i = middle; i < count; ++i)
      crossing.heights_m[i] = height(i, i == middle ? z_m : crossing.heights_m[i - 1]);
    for (std::size_t i = middle; i-- > 0;) crossing.heights_m[i] = height(i, crossing.heights_m[i + 1]);
  }

  const Graph& graph_;
  LargestCar car_;
};

// A controller with times and a light for pedestrians that stands beside the crossing.
std::int64_t LightOnFoot(const network::Network& network, std::uint32_t road, double s_m) {
  for (const network::Signal& signal : network.roads()[road].spec().signals) {
    if (signal.type != network::kPedestrianSignal || std::fabs(signal.s_m - s_m) > kLightNear_m) continue;
    for (std::size_t i = 0; i < network.controllers().size(); ++i) {
      const network::Controller& controller = network.controllers()[i];
      const auto controls = [&](const network::ControllerEntry& entry) { return entry.signal_id == signal.id; };
      if (controller.times && std::any_of(controller.controls.begin(), controller.controls.end(), controls))
        return static_cast<std::int64_t>(i);
    }
  }
  return -1;
}

}  // namespace

double FootCrossing::HeightAt(double u_m) const {
  if (heights_m.empty()) return 0.0;
  const double at = std::clamp((u_m + before_m) / kHeightStep_m, 0.0, static_cast<double>(heights_m.size() - 1));
  const auto i = std::min(static_cast<std::size_t>(at), heights_m.size() - 1),
             next = std::min(i + 1, heights_m.size() - 1);
  const double part = at - static_cast<double>(i);
  return (1.0 - part) * heights_m[i] + part * heights_m[next];
}

std::vector<FootCrossing> FindFootCrossings(const Graph& graph, const LargestCar& car) {
  std::vector<FootCrossing> crossings;
  const Finder finder(graph, car);
  const network::Furniture furniture = network::PlaceFurniture(graph.network());
  for (const network::Placed& placed : furniture.things) {
    const network::Road& road = graph.network().roads()[placed.road];
    const bool sign = placed.signal != nullptr && placed.signal->type == kCrossingSign && !placed.signal->dynamic;
    const bool object = placed.object != nullptr && placed.object->type == "crosswalk";
    if ((!sign && !object) || placed.s_m < 0.0 || placed.s_m > road.length_m()) continue;
    const Shape shape = sign ? ShapeOfSign(road, *placed.signal) : ShapeOf(road, placed);
    if (shape.corners.size() < 3) continue;
    auto crossing = finder.Find(shape, placed.foot_W.z());
    if (!crossing) continue;
    crossing->road = placed.road;
    crossing->s_m = placed.s_m;
    crossing->id = sign ? placed.signal->id : placed.object->id;
    crossing->light = LightOnFoot(graph.network(), placed.road, placed.s_m);
    crossings.push_back(std::move(*crossing));
  }
  return crossings;
}

}  // namespace rodeira::lanes
