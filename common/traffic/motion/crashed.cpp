// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/motion/crashed.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "common/core/base/constants.hpp"
#include "common/core/geometry/angle.hpp"
#include "common/core/geometry/plane.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kSubstep_s = 1e-3;

double Inertia(const AgentTraits& traits) {
  return traits.mass_kg * (traits.length_m * traits.length_m + traits.width_m * traits.width_m) / 12.0;
}

Eigen::Vector2d RotationalVelocity(const Eigen::Vector2d& r, double rate) { return {-rate * r.y(), rate * r.x()}; }

}  // namespace

void Crashed::Push(const AgentTraits& traits, const Eigen::Vector2d& impulse_Ns, const Eigen::Vector2d& point_W) {
  v_W += impulse_Ns / traits.mass_kg;
  yaw_rate_radps += geometry::Cross(point_W - p_W, impulse_Ns) / Inertia(traits);
}

// By the middle of short steps. What friction would turn round within one of them comes to rest.
void Crashed::Slide(const AgentTraits& traits, double mu, double dt_s) {
  const int count = std::max(1, static_cast<int>(std::ceil(dt_s / kSubstep_s)));
  const double h = dt_s / count, weight = 0.25 * traits.mass_kg * mu * base::kGravity_mps2, inertia = Inertia(traits);
  const Eigen::Vector2d corner(0.5 * traits.wheelbase_m, 0.5 * traits.width_m);
  for (int i = 0; i < count && !at_rest(); ++i) {
    const Eigen::Vector2d ahead(std::cos(heading_rad), std::sin(heading_rad)), left(-ahead.y(), ahead.x());
    Eigen::Vector2d force = Eigen::Vector2d::Zero();
    double moment = 0.0;
    for (const auto& [along, across] :
         {std::array{1.0, 1.0}, std::array{1.0, -1.0}, std::array{-1.0, 1.0}, std::array{-1.0, -1.0}}) {
      const Eigen::Vector2d r = along * corner.x() * ahead + across * corner.y() * left;
      const Eigen::Vector2d v = v_W + RotationalVelocity(r, yaw_rate_radps);
      const double speed = v.norm();
      if (speed == 0.0) continue;
      const Eigen::Vector2d f = -weight / speed * v;
      force += f;
      moment += geometry::Cross(r, f);
    }
    const Eigen::Vector2d v = v_W + h / traits.mass_kg * force;
    const double rate = yaw_rate_radps + h / inertia * moment;
    const double energy = 0.5 * traits.mass_kg * v_W.squaredNorm() + 0.5 * inertia * yaw_rate_radps * yaw_rate_radps;
    const double then = 0.5 * traits.mass_kg * v.squaredNorm() + 0.5 * inertia * rate * rate;
    const bool stops = then >= energy || (v.dot(v_W) <= 0.0 && rate * yaw_rate_radps <= 0.0);
    const Eigen::Vector2d next = stops ? Eigen::Vector2d::Zero().eval() : v;
    const double turned = stops ? 0.0 : rate;
    p_W += 0.5 * h * (v_W + next);
    heading_rad = geometry::WrapAngle(heading_rad + 0.5 * h * (yaw_rate_radps + turned));
    v_W = next;
    yaw_rate_radps = turned;
  }
}

void Crashed::Save(base::StateWriter& writer) const {
  writer.Put("p_W", std::span<const double>(p_W.data(), 2));
  writer.Put("heading_rad", heading_rad);
  writer.Put("v_W", std::span<const double>(v_W.data(), 2));
  writer.Put("yaw_rate_radps", yaw_rate_radps);
}

void Crashed::Restore(base::StateReader& reader) {
  reader.Get("p_W", std::span<double>(p_W.data(), 2));
  reader.Get("heading_rad", heading_rad);
  reader.Get("v_W", std::span<double>(v_W.data(), 2));
  reader.Get("yaw_rate_radps", yaw_rate_radps);
}

}  // namespace rodeira::traffic
