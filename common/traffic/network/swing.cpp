// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/network/swing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "common/traffic/motion/car_of.hpp"
#include "common/traffic/motion/hands.hpp"
#include "common/traffic/network/track_plan.hpp"
#include "common/traffic/state/agent.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kTight = 0.16;     // wheelbase over radius of bends that are looked at; wider ones put a car's corner
                                    // less than 0.2 m farther out than lines do
constexpr double kAround_m = 16.0;  // of way before and behind such a track …
constexpr double kSettles_m = 8.0;  // … of which so much settles how the car lies there
constexpr double kStep_s = 0.02, kOutlineStep_m = 0.5, kOutline_m = 0.9;
constexpr double kPlan_m = 0.5;
constexpr double kPlannedBraking_mps2 = 1.5;
constexpr double kMinSwingSpeed_mps = 0.5;
constexpr std::array kShares{
    1.0, 0.6,
    0.3};  // of the planned speed: hands are late at the first, at the last a car that comes from rest cuts the bend
constexpr std::size_t kMaxPaths = 64;  // through one track

class Swinger {
 public:
  Swinger(const lanes::Graph& graph, const TrafficSettings& settings)
      : graph_(graph), settings_(settings), largest_(LargestOf(settings)), swings_(graph.tracks().size()) {
    const auto bodies = BodiesOf(settings);
    const auto base = [](std::uint32_t body) { return CarOfBody(body).body.wheelbase_m; };
    car_ = &CarOfBody(*std::max_element(bodies.begin(), bodies.end(),
                                        [&](std::uint32_t a, std::uint32_t b) { return base(a) < base(b); }));
    speed_ = settings.speed;
    speed_.tips_mps2 = TipsAt_mps2(settings);
  }

  lanes::Swings Take() { return std::move(swings_); }

  bool IsTight(std::uint32_t track) const {
    const auto& nodes = graph_[track].curve.nodes();
    return std::any_of(nodes.begin(), nodes.end(), [&](const lanes::Curve::Node& node) {
      return std::fabs(node.curvature_1pm) * car_->body.wheelbase_m > kTight;
    });
  }

  // Over every way through a track.
  void Through(std::uint32_t track) {
    std::vector<std::vector<std::uint32_t>> begins;
    Back({track}, 0.0, begins);
    std::size_t ways = 0;
    for (auto& begin : begins) {
      std::reverse(begin.begin(), begin.end());
      Path path{Piece{}};
      path.back().track = begin.front();
      bool whole = true;
      for (std::size_t i = 1; i < begin.size() && whole; ++i) whole = Append(path, begin[i]);
      if (whole) On(path, path.back().zero_m + graph_[track].length_m() + kAround_m, ways);
    }
  }

 private:
  // All tracks that lead to the last one of `way`, the nearest first, over kAround_m.
  void Back(std::vector<std::uint32_t> way, double gone_m, std::vector<std::vector<std::uint32_t>>& ways) const {
    const auto& before = graph_[way.back()].before;
    if (gone_m >= kAround_m || before.empty()) {
      if (ways.size() < kMaxPaths) ways.push_back(std::move(way));
      return;
    }
    for (const std::uint32_t from : before) {
      way.push_back(from);
      Back(way, gone_m + graph_[from].length_m(), ways);
      way.pop_back();
    }
  }

  bool Append(Path& path, std::uint32_t track) const {
    for (const lanes::Link& link : graph_[path.back().track].next) {
      if (link.to != track) continue;
      path.push_back(Onward(graph_, path, link, kMinSwingSpeed_mps));
      return true;
    }
    return false;
  }

  void On(const Path& path, double to_m, std::size_t& ways) {
    const auto& next = graph_[path.back().track].next;
    if (path.back().zero_m + graph_[path.back().track].length_m() >= to_m || next.empty()) {
      if (ways++ >= kMaxPaths) return;
      for (const double share : kShares) Drive(path, to_m, share);
      return;
    }
    for (const lanes::Link& link : next) {
      Path on = path;
      on.push_back(Onward(graph_, path, link, kMinSwingSpeed_mps));
      On(on, to_m, ways);
    }
  }

  double PlannedSquared(const Path& path, double odometer_m) {
    const Piece& piece = PieceAt(path, odometer_m);
    auto found = plans_.find(piece.track);
    if (found == plans_.end())
      found = plans_.emplace(piece.track, driver::SpeedPlan(TrackWay(graph_, piece.track), speed_)).first;
    const double speed = found->second.At(odometer_m - piece.zero_m).speed_mps * settings_.speed_factor_high;
    return speed * speed;
  }

  void Drive(const Path& path, double to_m, double share) {
    const double wheelbase = car_->body.wheelbase_m, half_base = 0.5 * wheelbase;
    const double end_m = std::min(to_m, path.back().zero_m + graph_[path.back().track].length_m()) - half_base;
    double o = half_base;  // of the middle
    std::vector<double> squared;
    for (double at = 0.0; at <= end_m + half_base; at += kPlan_m) squared.push_back(PlannedSquared(path, at));
    for (std::size_t i = squared.size(); i-- > 1;)
      squared[i - 1] = std::min(squared[i - 1], squared[i] + 2.0 * kPlannedBraking_mps2 * kPlan_m);
    const double liveliest =
        settings_.idm.acceleration_mps2 * (1.0 + settings_.variety);  // no car leaves a bend faster than so
    for (std::size_t i = 1; i < squared.size(); ++i)
      squared[i] = std::min(squared[i], squared[i - 1] + 2.0 * liveliest * kPlan_m);
    Eigen::Vector2d rear = FrameAt(graph_, path, 0.0).p_W.head<2>();
    const Eigen::Vector2d along = FrameAt(graph_, path, 2.0 * half_base).p_W.head<2>() - rear;
    double heading = std::atan2(along.y(), along.x()), wheel = 0.0,
           next_look_m = graph_[path.front().track].before.empty() ? o : o + kSettles_m;
    while (o < end_m) {
      const Eigen::Vector2d ahead(std::cos(heading), std::sin(heading));
      if (o >= next_look_m) RecordOutline(path, rear + half_base * ahead, ahead, o), next_look_m += kOutlineStep_m;
      const double speed =
          std::max(kMinSwingSpeed_mps,
                   share * std::sqrt(squared[std::min(squared.size() - 1, static_cast<std::size_t>(o / kPlan_m))]));
      double rear_m = o - half_base;
      PathFrame beside = FrameAt(graph_, path, rear_m);
      rear_m += beside.ahead_W.dot(rear - beside.p_W.head<2>()) / beside.stretch;
      beside = FrameAt(graph_, path, rear_m);
      const double soon_m = std::min(AnsweredWay_m(speed), o + 0.5 * largest_.length_m - rear_m);
      const PathFrame soon = FrameAt(graph_, path, rear_m + soon_m);
      const Eigen::Vector2d left(-beside.ahead_W.y(), beside.ahead_W.x());
      const double turns = std::atan2(soon.ahead_W.dot(left), soon.ahead_W.dot(beside.ahead_W));
      const double half = 0.5 * (car_->dimensions.front_m + car_->dimensions.rear_m);
      const Eigen::Vector2d last = FrameAt(graph_, path, o - half).ahead_W,
                            first = FrameAt(graph_, path, o + half).ahead_W;
      const double aside =
          RearLine_m(wheelbase, 2.0 * half, std::atan2(last.x() * first.y() - last.y() * first.x(), last.dot(first)));
      const RearBeside place{std::atan2(ahead.dot(left), ahead.dot(beside.ahead_W)),
                             (rear - beside.p_W.head<2>()).dot(left) - aside, turns / soon_m, speed};
      wheel = MovedWheel_rad(*car_, place, wheel, kStep_s);
      const double tangent = std::tan(wheel / car_->steering.ratio),
                   rolls_m = speed * kStep_s / std::hypot(1.0, 0.5 * tangent);
      const double turned = rolls_m * tangent / wheelbase;
      rear += rolls_m * Eigen::Vector2d(std::cos(heading + 0.5 * turned), std::sin(heading + 0.5 * turned));
      heading += turned;
      const Eigen::Vector2d middle = rear + half_base * Eigen::Vector2d(std::cos(heading), std::sin(heading));
      const double before = o;
      o += speed * kStep_s;
      for (int turn = 0; turn < 2; ++turn) o = FootOf(path, middle, o);
      o = std::max(o, before + 0.1 * speed * kStep_s);
    }
  }

  double FootOf(const Path& path, const Eigen::Vector2d& p_W, double near_m) const {
    const PathFrame frame = FrameAt(graph_, path, near_m);
    return near_m + frame.ahead_W.dot(p_W - frame.p_W.head<2>()) / frame.stretch;
  }

  // Notes the outline of the car here at the nodes beside it.
  void RecordOutline(const Path& path, const Eigen::Vector2d& middle, const Eigen::Vector2d& ahead, double o) {
    const Eigen::Vector2d left(-ahead.y(), ahead.x());
    const double half = 0.5 * largest_.length_m;
    const auto count = static_cast<int>(std::ceil(largest_.length_m / kOutline_m));
    for (int i = 0; i <= count; ++i) {
      const double x = -half + largest_.length_m * i / count;
      for (const double side : {-0.5, 0.5}) {
        const Eigen::Vector2d p = middle + x * ahead + side * largest_.width_m * left;
        double at = o + x;
        for (int turn = 0; turn < 3; ++turn) at = std::clamp(FootOf(path, p, at), o - half, o + half);
        const PathFrame frame = FrameAt(graph_, path, at);
        const double offset = (p - frame.p_W.head<2>()).dot(Eigen::Vector2d(-frame.ahead_W.y(), frame.ahead_W.x()));
        for (const Piece& piece : path) Note(piece.track, at - piece.zero_m, offset);
      }
    }
  }

  void Note(std::uint32_t track, double d_m, double offset_m) {
    const auto& nodes = graph_[track].curve.nodes();
    constexpr double kBeside_m = 0.75;
    if (d_m < -kBeside_m || d_m > graph_[track].length_m() + kBeside_m) return;
    std::vector<lanes::Swing>& swings = swings_[track];
    if (swings.empty()) swings.resize(nodes.size());
    auto node = std::lower_bound(nodes.begin(), nodes.end(), d_m - kBeside_m,
                                 [](const lanes::Curve::Node& at, double d) { return at.d_m < d; });
    for (; node != nodes.end() && node->d_m <= d_m + kBeside_m; ++node) {
      const auto i = static_cast<std::size_t>(node - nodes.begin());
      swings[i].left_m = std::max(swings[i].left_m, offset_m);
      swings[i].right_m = std::max(swings[i].right_m, -offset_m);
    }
  }

  const lanes::Graph& graph_;
  const TrafficSettings& settings_;
  lanes::LargestCar largest_;
  const dynamics::BicycleSettings* car_;
  driver::SpeedPlanSettings speed_;
  std::map<std::uint32_t, driver::SpeedPlan> plans_;  // by track
  lanes::Swings swings_;
};

}  // namespace

lanes::Swings SwingsOf(const lanes::Graph& graph, const TrafficSettings& settings) {
  if (settings.physics != Physics::kFull || settings.driver == DriverKind::kMotors || BodiesOf(settings).empty())
    return {};
  Swinger swinger(graph, settings);
  for (std::uint32_t track = 0; track < graph.tracks().size(); ++track) {
    if (swinger.IsTight(track)) swinger.Through(track);
  }
  return swinger.Take();
}

}  // namespace rodeira::traffic
