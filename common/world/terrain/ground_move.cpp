// SPDX-License-Identifier: Apache-2.0
#include "common/world/terrain/ground_move.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include "common/core/geometry/angle.hpp"
#include "common/world/terrain/geographic.hpp"

namespace rodeira::terrain {

GroundMove MoveWith(const MapOrigin& origin, const std::string& projection_wkt) {
  auto from = Geographic::Make(origin.wkt), to = Geographic::Make(projection_wkt);
  if (!from || !to) return {};
  return
      [from = std::move(from).value(), to = std::move(to).value(), origin](Eigen::Vector2d& p_W, double& heading_rad) {
        const auto moved = [&](const Eigen::Vector2d& p) -> std::optional<Eigen::Vector2d> {
          const auto place = from.ToEarth(p.x(), p.y());
          return place ? to.ToMap(*place) : std::nullopt;
        };
        if (p_W.x() < origin.west || p_W.x() > origin.east || p_W.y() < origin.south || p_W.y() > origin.north) return;
        constexpr double kStep = 10.0;
        const Eigen::Vector2d step = kStep * Eigen::Vector2d(std::cos(heading_rad), std::sin(heading_rad));
        const auto at = moved(p_W), ahead = moved(p_W + step), behind = moved(p_W - step);
        if (!at || !ahead || !behind) return;
        // The turn is added, so that a heading beyond half a turn stays beyond it.
        const double turned = std::atan2(ahead->y() - behind->y(), ahead->x() - behind->x());
        heading_rad += geometry::WrapAngle(turned - heading_rad);
        p_W = *at;
      };
}

}  // namespace rodeira::terrain
