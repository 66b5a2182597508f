// SPDX-License-Identifier: Apache-2.0
// Where the surface of a road that leans stands over many points that lie close together: the steps of Road::FootOnLean
// and of Road::Surface, each made for all points. What is the same for all of them (a steady bank, a steady grade) is
// found once.
#include "common/world/network/cluster_lean.hpp"

#include <algorithm>
#include <cmath>

#include "common/world/network/in_force.hpp"
#include "common/world/network/lean_foot.hpp"

namespace rodeira::network {
namespace {

using geometry::Cubic;

constexpr double kReach_m = 1.0;  // farther from their feet points are left to themselves

bool IsPlainZero(double value) { return value == 0.0 && !std::signbit(value); }
bool IsSteadyAngle(const Cubic& record) {
  return IsPlainZero(record.b) && IsPlainZero(record.c) && IsPlainZero(record.d);
}
bool IsSteadyGrade(const Cubic& record) {
  return !(record.b == 0.0 && std::signbit(record.b)) && IsPlainZero(record.c) && IsPlainZero(record.d);
}

// Whether the series for small angles hold from one station to another.
bool IsSmall(const geometry::CubicTable& angle, double low_s_m, double high_s_m) {
  double smallest, largest;
  angle.Bounds(low_s_m, high_s_m, smallest, largest);
  constexpr double kSurely = 0.999 * geometry::kSmallAngle;
  return smallest >= -kSurely && largest <= kSurely;
}

// The largest of finite numbers, without their sign.
double Largest(const Cluster::Numbers& numbers, std::size_t count) {
  double low, high;
  Range(numbers, count, low, high);
  return std::max(std::fabs(low), std::fabs(high));
}

// What is asked along the line: its roll, its climb and the way from the feet onward. Loops have copies of their own,
// which no store can reach.
template <class RollOf, class ClimbOf, class WayOf>
struct Along {
  RollOf roll;
  ClimbOf climb;
  WayOf way;

  Lean LeanAt(double s_m) const { return LeanOf(roll(s_m), climb(s_m)); }
};
template <class RollOf, class ClimbOf, class WayOf>
Along(RollOf, ClimbOf, WayOf)
    -> Along<RollOf, ClimbOf, WayOf>;  // clang, with which readers are fuzzed, finds it for aggregates from 17 on

// How far points have come from their feet, by the last step and in all, and -G' there.
struct Steps {
  Cluster::Numbers u_m, last_m, fall;
};

template <class Line>
void FirstSteps(const Line line, const Cluster& __restrict cluster, Steps& __restrict steps) {
  const std::size_t count = cluster.feet.count;
  for (std::size_t i = 0; i < count; ++i) {
    const LeanStep step = FirstLeanStep(cluster.feet.t_m[i], cluster.feet.curvature_1pm[i], line.way.rate_1pm2,
                                        line.LeanAt(cluster.s_m[i]));
    steps.u_m[i] = steps.last_m[i] = step.step_m;
    steps.fall[i] = step.fall;
  }
}

template <class Line>
void FindNextSteps(const Line line, const Cluster& __restrict cluster, const Steps& __restrict steps,
                   Steps& __restrict next) {
  const std::size_t count = cluster.feet.count;
  for (std::size_t i = 0; i < count; ++i) {
    const double k = cluster.feet.curvature_1pm[i], u = steps.u_m[i];
    const LeanStep step =
        NextLeanStep(line.way(u, k), cluster.feet.t_m[i], k + line.way.rate_1pm2 * u, line.LeanAt(cluster.s_m[i] + u));
    next.u_m[i] = u + step.step_m;
    next.last_m[i] = step.step_m;
    next.fall[i] = step.fall;
  }
}

// What has arrived stays.
void Take(const Steps& next, std::size_t count, Steps& steps) {
  for (std::size_t i = 0; i < count; ++i) {
    if (std::fabs(steps.last_m[i]) <= kLastLeanStep_m) continue;
    steps.u_m[i] = next.u_m[i];
    steps.last_m[i] = next.last_m[i];
    steps.fall[i] = next.fall[i];
  }
}

// False where a point does not arrive. reach_m: no step led farther from a foot.
template <class Line>
bool Arrive(const Line& line, const Cluster& cluster, Steps& steps, double& reach_m) {
  const std::size_t count = cluster.feet.count;
  const auto arrived = [&](std::size_t i) { return std::fabs(steps.last_m[i]) <= kLastLeanStep_m; };  // not NaN
  FirstSteps(line, cluster, steps);
  reach_m = Largest(steps.u_m, count);
  for (int i = 1; !All(count, arrived); ++i) {
    if (i == kMaxLeanSteps) return false;
    Steps next;
    FindNextSteps(line, cluster, steps, next);
    Take(next, count, steps);
    reach_m = std::max(reach_m, Largest(steps.u_m, count));
  }
  return All(count, [&](std::size_t i) { return steps.fall[i] > kMinLeanFall; }) &&
         All(count, [&](std::size_t i) { return line.way.Holds(steps.u_m[i], cluster.feet.curvature_1pm[i]); });
}

template <class Line>
void Put(const Line line, const Steps& __restrict steps, Cluster& __restrict cluster, ClusterLeans& __restrict leans) {
  geometry::AxisFeet& feet = cluster.feet;
  const std::size_t count = feet.count;
  for (std::size_t i = 0; i < count; ++i) {
    const double u = steps.u_m[i], k = feet.curvature_1pm[i], x = feet.tangent_x[i], y = feet.tangent_y[i],
                 s = cluster.s_m[i] + u;
    const Onward way = line.way(u, k);
    const Lean lean = line.LeanAt(s);
    cluster.s_m[i] = s;
    feet.t_m[i] = LeanT(way, feet.t_m[i], lean);
    feet.tangent_x[i] = way.cosine * x - way.sine * y;
    feet.tangent_y[i] = way.cosine * y + way.sine * x;
    feet.curvature_1pm[i] = k + line.way.rate_1pm2 * u;
    leans.left[i] = lean.left, leans.back[i] = lean.back, leans.up[i] = lean.up;
    leans.left_1pm[i] = lean.left_1pm, leans.back_1pm[i] = lean.back_1pm, leans.up_1pm[i] = lean.up_1pm;
  }
}

}  // namespace

bool SettleTogether(const Road& road, const geometry::AxisPanel& panel, const Cubic& superelevation, Cluster& cluster,
                    ClusterLeans& leans) {
  const std::optional<double> rate = road.axis().RateOf(panel);
  if (!rate) return false;
  const Cubic& elevation = InForce(road.spec().elevation, cluster).record();
  const double low = cluster.low_s_m, high = cluster.high_s_m;
  const auto in_force = [&](const geometry::CubicTable& table, const Cubic& record, double reach) {
    return table.empty() || (&table.At(low - reach) == &record && &table.At(high + reach) == &record);
  };
  const auto settle = [&](const auto& roll, const auto& climb, const auto& way) {
    const Along line{roll, climb, way};
    Steps steps;
    double reach;
    if (!Arrive(line, cluster, steps, reach) || !(reach <= kReach_m)) return false;
    if (!in_force(road.spec().superelevation, superelevation, reach) ||
        !in_force(road.spec().elevation, elevation, reach))
      return false;
    Put(line, steps, cluster, leans);
    return true;
  };
  const auto on_way = [&](const auto& roll, const auto& climb) {
    return panel.kind == geometry::AxisPanel::Kind::kLine ? settle(roll, climb, StraightOn())
                                                          : settle(roll, climb, BentOn{*rate});
  };
  const auto with_roll = [&](const auto& roll) {
    if (!IsSteadyGrade(elevation)) return on_way(roll, [record = elevation](double s) { return ClimbAt(record, s); });
    return on_way(roll, [steady = ClimbAt(elevation, low)](double) { return steady; });
  };
  if (IsSteadyAngle(superelevation))
    return with_roll([steady = RollAt(superelevation, low)](double) { return steady; });
  if (!IsSmall(road.spec().superelevation, low - kReach_m, high + kReach_m))
    return with_roll([record = superelevation](double s) { return RollAt(record, s); });
  return with_roll([record = superelevation](double s) { return SmallRollAt(record, s); });
}

void SetLeans(const ClusterLeans& leans, Cluster& cluster) {
  const geometry::AxisFeet& feet = cluster.feet;
  for (std::size_t i = 0; i < feet.count; ++i) {
    const Lean lean{leans.left[i], leans.back[i], leans.up[i], leans.left_1pm[i], leans.back_1pm[i], leans.up_1pm[i]};
    const double t = feet.t_m[i], T_x = feet.tangent_x[i], T_y = feet.tangent_y[i], N_x = -T_y, N_y = T_x;
    const LeanPace pace = PaceOf(lean, feet.curvature_1pm[i], t);
    cluster.z_m[i] += t * lean.up;
    cluster.z_by_s[i] += t * lean.up_1pm;
    cluster.z_by_t[i] = lean.up;
    cluster.ds_x[i] = pace.ds_T * T_x + pace.ds_N * N_x;
    cluster.ds_y[i] = pace.ds_T * T_y + pace.ds_N * N_y;
    cluster.dt_x[i] = pace.dt_T * T_x + pace.dt_N * N_x;
    cluster.dt_y[i] = pace.dt_T * T_y + pace.dt_N * N_y;
  }
}

}  // namespace rodeira::network
