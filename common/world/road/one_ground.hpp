// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "common/world/network/network.hpp"

namespace rodeira::road {

// A height over the plane and how it changes in it.
struct PlaneHeight {
  double z_m = 0.0;
  Eigen::Vector2d slope_W = Eigen::Vector2d::Zero();
};

// Of a surface by its derivatives.
PlaneHeight HeightOf(const network::SurfaceSample& sample);

// How much a road's surface counts where another one lies on the same level, and how that changes in the plane.
struct Weight {
  double value = 0.0;
  Eigen::Vector2d slope_W = Eigen::Vector2d::Zero();
};

// Roads' surfaces over a point that are one ground: what any question of this level is answered from. Where drivable
// lanes lie there, what is not drivable does not count. Each road counts by (a b / (a + b))², a and b its distances to
// the edges of its drivable lanes, so that it begins and ends without a step. Beside drivable lanes of its own a road
// counts ever more towards them, down to nothing at its outer edge. Towards an end where it goes on in another road it
// counts ever more, as that road does from there on, so that both meet; at an end where nothing goes on it does not
// count.
struct Layer {
  std::vector<const network::Surfacing*> roads;  // what counts; one alone is the ground as it is
  const network::Surfacing* named =
      nullptr;  // with this lane: of those that count the one that Network::Locate would name
  double z_m = 0.0;

  // Of these heights of each of the roads.
  PlaneHeight Mean(std::span<const PlaneHeight> heights) const;
  std::vector<Weight> weights;  // by road; empty where one alone counts
};

// From the highest to the lowest layer, of what Network::Surfaces found. Of one layer are roads of one junction, those
// that lead into it too, within Network::kLevel_m of the highest; others within ground::kMaxAboveHint_m, where no hint
// can tell them apart. past_ends: whether the ground behind an end that is closed counts.
void FindLayers(const network::Network& network, std::span<const network::Surfacing> surfaces, bool past_ends,
                std::vector<Layer>& layers, std::size_t& count);

}  // namespace rodeira::road
