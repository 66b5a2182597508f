// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/world.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "common/core/base/assert.hpp"
#include "common/world/network/cluster.hpp"
#include "common/world/road/built_ground.hpp"
#include "common/world/road/network_ground.hpp"
#include "common/world/road/surface_detail.hpp"
#include "common/world/road/world_hash.hpp"
#include "common/world/terrain/heights_ahead.hpp"

namespace rodeira::road {
namespace {

constexpr std::size_t kFew = 12;  // are asked sooner one by one

// Answers for points close to one another as World::At does for each; false, and writes nothing, where it cannot.
using QueryBatch = std::function<bool(std::span<const ground::GroundQuery>, std::span<ground::GroundPoint>)>;

// SUELO on a world: nothing but World::At, a point at a time, or the same faster where many lie together on a road.
class WorldGround final : public ground::Ground {
 public:
  WorldGround(std::shared_ptr<const World> world, QueryBatch together)
      : world_(std::move(world)), together_(std::move(together)), ahead_(world_->grid()) {}

  void Query(std::span<const ground::GroundQuery> queries, std::span<ground::GroundPoint> points) override {
    RODEIRA_ASSERT(queries.size() == points.size());
    for (std::size_t from = 0; from < queries.size(); from += network::Cluster::kMost) {
      const std::size_t count = std::min(network::Cluster::kMost, queries.size() - from);
      const auto some = queries.subspan(from, count);
      const auto answers = points.subspan(from, count);
      if (count <= kFew || !together_ || !together_(some, answers)) OneByOne(some, answers);
    }
  }

 private:
  void OneByOne(std::span<const ground::GroundQuery> queries, std::span<ground::GroundPoint> points) const {
    const auto fetch = [&](std::size_t i) {
      if (ahead_.any() && i < queries.size()) ahead_.Fetch(queries[i].x_m, queries[i].y_m);
    };
    for (std::size_t i = 0; i < terrain::HeightsAhead::kAhead; ++i) fetch(i);
    for (std::size_t i = 0; i < queries.size(); ++i) {
      fetch(i + terrain::HeightsAhead::kAhead);
      const SurfacePoint at = world_->At(queries[i].x_m, queries[i].y_m, queries[i].z_hint_m);
      if (!at.inside) {
        points[i] = {};
        continue;
      }
      const double up = 1.0 / std::sqrt(at.slope_x * at.slope_x + at.slope_y * at.slope_y + 1.0);
      points[i].z_m = at.z_m;
      points[i].normal_W = {-at.slope_x * up, -at.slope_y * up, up};
      points[i].friction = at.friction;
      points[i].surface = at.surface;
      points[i].inside = true;
    }
  }

  std::shared_ptr<const World> world_;
  QueryBatch together_;  // none: each point by itself
  terrain::HeightsAhead ahead_;
};

}  // namespace

World::World(WorldSpec spec)
    : name_(spec.name),
      terrain_{spec.grid, spec.plane, spec.terrain_surface,
               spec.terrain_friction.value_or(spec.friction[static_cast<std::size_t>(spec.terrain_surface)])},
      network_(spec.network),
      props_(spec.props),
      detail_(spec.detail),
      ground_picture_(spec.ground_picture),
      friction_(spec.friction),
      start_(spec.start),
      warnings_(std::move(spec.warnings)),
      content_hash_(ContentHash(spec)) {
  RODEIRA_ASSERT(grid() == nullptr || !plane());
  RODEIRA_ASSERT(grid() != nullptr || plane() || network_ != nullptr);
  if (open_drive()) {
    grounds_ = LaneGrounds(*network_, friction_);
    paint_ = std::make_shared<const MarkPaint>(network_);
    land_ = std::make_shared<const NetworkLand>(network_);
  } else if (network_ != nullptr) {
    built_ = std::make_shared<const BuiltGround>(network_, spec.junctions, friction_,
                                                 detail_ == nullptr ? SurfaceDetail() : *detail_, terrain_);
  }
}

std::shared_ptr<const World> World::Make(WorldSpec spec) {
  return std::shared_ptr<const World>(new World(std::move(spec)));
}

Extents World::extents() const {
  if (grid() != nullptr) {
    const terrain::ElevationGrid::Frame& frame = grid()->frame();
    return {frame.west_m, frame.south_m, frame.east_m, frame.north_m};
  }
  if (open_drive()) return NetworkExtents(*network_);
  const double infinity = std::numeric_limits<double>::infinity();
  return {-infinity, -infinity, infinity, infinity};
}

std::unique_ptr<ground::Ground> World::MakeGround() const {
  QueryBatch together;
  if (built_ != nullptr) {
    together = [this](auto queries, auto points) { return built_->QueryBatch(queries, points); };
  } else if (open_drive()) {
    together = [this](auto queries, auto points) {
      return NetworkGroundTogether(*network_, grounds_, friction_, paint_.get(), detail_.get(), queries, points);
    };
  }
  return std::make_unique<WorldGround>(shared_from_this(), std::move(together));
}

std::shared_ptr<const World> World::AsSeen() const {
  if (detail_ == nullptr || !detail_->IsFine()) return shared_from_this();
  const std::shared_ptr<World> seen(new World(*this));
  seen->detail_ = std::make_shared<const SurfaceDetail>(detail_->AsSeen());
  if (built_ != nullptr) seen->built_ = built_->With(*seen->detail_);
  return seen;
}

base::Digest World::DetailDigest(std::uint32_t road, double from_s_m, double to_s_m) const {
  return detail_ == nullptr ? 0 : detail_->DigestOn(road, from_s_m, to_s_m);
}

std::span<const std::shared_ptr<const design::JunctionSurface>> World::junctions() const {
  return built_ == nullptr ? std::span<const std::shared_ptr<const design::JunctionSurface>>()
                           : std::span(built_->junctions());
}

SurfacePoint World::At(double x_m, double y_m, double z_hint_m) const {
  if (open_drive())
    return NetworkGround(*network_, grounds_, *land_, friction_, x_m, y_m, z_hint_m, paint_.get(), detail_.get());
  if (built_ != nullptr) return built_->At(x_m, y_m, z_hint_m);
  return TerrainAt(x_m, y_m);
}

}  // namespace rodeira::road
