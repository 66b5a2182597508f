// SPDX-License-Identifier: Apache-2.0
// Speed limits of signs that contradict those of lanes and road types.
#include <fmt/format.h>

#include <cmath>

#include "common/world/network/placing.hpp"
#include "common/world/network/sign_limits.hpp"
#include "common/world/opendrive/checks.hpp"

namespace rodeira::opendrive {
namespace {

constexpr double kSame_mps = 0.5 / 3.6;  // files round
constexpr double kBeside_m = 10.0;       // a sign stands so far from where the limit of a lane begins

std::string Words(double speed_mps) {
  return std::isinf(speed_mps) ? std::string("no limit") : fmt::format("{:.1f} km/h", speed_mps * 3.6);
}

// The lane nearest to the centre that a sign is for and that says another limit; nothing where a lane agrees, or says
// none.
std::optional<Finding> Contradiction(const network::Road& road, const network::Signal& signal, double sign_mps) {
  std::optional<Finding> found;
  const std::size_t index = road.SectionIndex(signal.s_m);
  const network::LaneSection& section = road.spec().sections[index];
  for (const auto* side : {&section.right, &section.left}) {
    for (const network::Lane& lane : *side) {
      const bool along = lane.direction >= 0;
      if (!network::IsDrivable(lane.type) || !network::HoldsFor(lane.id, along, signal.orientation, signal.validity))
        continue;
      const auto said = road.SaidSpeedLimitAt(lane, signal.s_m);
      if (!said) return std::nullopt;
      for (const double beside_m : {0.0, -kBeside_m, kBeside_m}) {
        const auto near = road.SaidSpeedLimitAt(lane, road.Held(index, signal.s_m + beside_m));
        if (near && std::fabs(*near - sign_mps) <= kSame_mps) return std::nullopt;
      }
      if (found) continue;
      const bool by_lane = !lane.speeds.empty() && lane.speeds.front().s_m <= signal.s_m;
      found = Finding{by_lane ? "rodeira.signal.limit_of_lane" : "rodeira.signal.limit_of_type",
                      fmt::format("sign {} says {}, and the {} {}, which holds", signal.id, Words(sign_mps),
                                  by_lane ? "lane" : "road's type", Words(*said)),
                      0,
                      road.id(),
                      lane.id,
                      signal.s_m,
                      {}};
    }
  }
  return found;
}

}  // namespace

void TellSignLimits(const network::Network& network, std::span<const RoadLines> lines, Findings& findings) {
  for (std::size_t i = 0; i < network.roads().size(); ++i) {
    const network::Road& road = network.roads()[i];
    for (const network::Signal& signal : road.spec().signals) {
      const auto limit = network::SignLimitOf(signal);
      if (!limit || !limit->speed_mps) continue;
      auto finding = Contradiction(road, signal, *limit->speed_mps);
      if (!finding) continue;
      finding->line = lines[i].road;
      findings.warnings.push_back(std::move(*finding));
    }
  }
}

}  // namespace rodeira::opendrive
