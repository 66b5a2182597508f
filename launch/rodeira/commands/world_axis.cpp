// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/world_axis.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/core/base/suggest.hpp"
#include "common/world/road/network_world.hpp"
#include "common/world/road/road_chains.hpp"
#include "common/world/road/world.hpp"
#include "launch/rodeira/world_warnings.hpp"

namespace rodeira::cli {
namespace {

template <class PointAt>
geometry::Polyline Sampled(double length_m, double step_m, PointAt point_at) {
  geometry::Polyline line;
  const auto pieces = static_cast<int>(std::ceil(length_m / step_m - 1e-9));
  for (int i = 0; i < pieces; ++i) line.points_W.push_back(point_at(i * step_m));
  line.points_W.push_back(point_at(length_m));
  return line;
}

}  // namespace

std::optional<AxisName> AxisNameOf(std::string_view text) {
  const auto hash = text.rfind('#');
  if (hash == std::string_view::npos || hash == 0 || hash + 1 == text.size()) return std::nullopt;
  const std::string_view file = text.substr(0, hash);
  if (!file.ends_with(".yaml") && !road::IsOpenDrive(file)) return std::nullopt;
  return AxisName{std::string(file), std::string(text.substr(hash + 1))};
}

base::Result<geometry::Polyline> AxisOf(const AxisName& name, double step_m) {
  const auto world = LoadWorldAndWarn(name.file);
  if (!world) return world.error();
  std::vector<std::string> ids;
  if (const network::Network* network = world.value()->network()) {
    const auto on = [](const network::Road& road, double s) {
      const Eigen::Vector2d at = road.axis().Evaluate(s).p_W;
      return Eigen::Vector3d(at.x(), at.y(), road.spec().elevation.Evaluate(s).value);
    };
    for (const network::Road& road : network->roads()) {
      ids.push_back(road.id());
      if (road.id() == name.road) return Sampled(road.length_m(), step_m, [&](double s) { return on(road, s); });
    }
    // A road that junctions cut, by the name that its author gave it: its parts and the ways through these junctions.
    for (const road::RoadChain& chain : road::ChainsOf(*network)) {
      ids.push_back(chain.name);
      if (chain.name != name.road) continue;
      return Sampled(chain.length_m, step_m, [&](double s) {
        const auto [part, along_m] = chain.At(*network, s);
        return on(*part, along_m);
      });
    }
  }
  return base::WrongInput("world.unknown_road",
                          fmt::format("there is no road '{}'{}", name.road, base::DidYouMean(name.road, ids)),
                          name.file);
}

}  // namespace rodeira::cli
