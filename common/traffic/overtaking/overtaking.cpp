// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/overtaking/overtaking.hpp"

#include <algorithm>

#include "common/traffic/right_of_way/travel_time.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kMinOvertakingSpeed_mps = 1.0;
constexpr double kOnOwnSide = 0.8;  // of the path back: six in a hundred of its width are left
constexpr int kHalvings = 40;

}  // namespace

void Overtaking::Save(base::StateWriter& writer) const {
  writer.Put("side", side);
  writer.Put("back", back);
  writer.Put("gives_up", gives_up);
  writer.Put("passed", passed);
  writer.Put("passed_body", passed_body);
  writer.Put("clear_m", clear_m);
  writer.Put("legal_m", legal_m);
  writer.Put("to_m", to_m);
  writer.Put("back_s", back_s);
}

void Overtaking::Restore(base::StateReader& reader) {
  reader.Get("side", side);
  reader.Get("back", back);
  reader.Get("gives_up", gives_up);
  reader.Get("passed", passed);
  reader.Get("passed_body", passed_body);
  reader.Get("clear_m", clear_m);
  reader.Get("legal_m", legal_m);
  reader.Get("to_m", to_m);
  reader.Get("back_s", back_s);
}

PassPlan PlanPass(const PassCase& at) {
  PassPlan plan;
  const double out = at.to_clear_m / std::max(kMinOvertakingSpeed_mps, at.speed_mps);
  const double gained = std::max(0.0, at.relative_m - out * (at.speed_mps - at.passed_mps));
  const double gaining =
      TravelTime(gained, std::max(0.0, at.speed_mps - at.passed_mps), at.top_mps - at.passed_mps, at.gains_mps2);
  plan.gaining_s = out + gaining;
  plan.speed_mps =
      std::max({kMinOvertakingSpeed_mps, at.speed_mps, std::min(at.top_mps, at.speed_mps + at.gains_mps2 * gaining)});
  const double back = std::max(at.back_least_m, at.back_s * plan.speed_mps);
  plan.way_m = at.to_clear_m + gained + at.passed_mps * gaining + back;
  plan.time_s = plan.gaining_s + (kOnOwnSide * back + at.length_m) / plan.speed_mps;
  return plan;
}

double QuinticShareAt(double share) {
  double low = 0.0, high = 1.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double u = 0.5 * (low + high);
    (u * u * u * (10.0 - 15.0 * u + 6.0 * u * u) < share ? low : high) = u;
  }
  return high;
}

}  // namespace rodeira::traffic
