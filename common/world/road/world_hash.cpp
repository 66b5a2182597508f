// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/world_hash.hpp"

#include "common/core/base/bytes.hpp"
#include "common/world/road/network_hash.hpp"
#include "common/world/road/surface_detail.hpp"

namespace rodeira::road {
namespace {

class CanonicalWorldWriter {
 public:
  void Put(double value) { out_.Put(value + 0.0); }  // -0 is 0
  void Put(int value) { out_.Put(static_cast<std::int64_t>(value)); }
  void Put(std::size_t value) { out_.Put(static_cast<std::uint64_t>(value)); }
  void Put(ground::Surface value) { out_.Put(static_cast<std::uint64_t>(value)); }
  template <class... Values>
  void PutAll(Values... values) {
    (Put(values), ...);
  }
  base::ByteWriter& out() { return out_; }

 private:
  base::ByteWriter out_;
};

// What is run into is part of a world.
void PutProps(CanonicalWorldWriter& canonical, const network::Props& props) {
  canonical.PutAll(7, props.objects.size(), props.placements.size(), props.runs.size());
  for (const network::Object& object : props.objects) {
    canonical.out().PutString(object.subtype);
    canonical.PutAll(object.length_m, object.width_m, object.height_m, object.radius_m, object.z_offset_m);
  }
  for (const auto& thing : props.placements)
    canonical.PutAll(thing.object, thing.at_W.x(), thing.at_W.y(), thing.heading_rad);
  for (const auto& run : props.runs) {
    canonical.PutAll(run.object, run.points_W.size());
    for (const Eigen::Vector2d& p : run.points_W) canonical.PutAll(p.x(), p.y());
  }
}

}  // namespace

base::Digest ContentHash(const WorldSpec& spec) {
  CanonicalWorldWriter canonical;
  canonical.out().PutString("rodeira world/1");
  canonical.Put(std::size_t{0});  // the number of roads that were not in the network
  if (spec.grid != nullptr) {
    const terrain::ElevationGrid::Frame& frame = spec.grid->frame();
    canonical.PutAll(1, frame.columns, frame.rows, frame.west_m, frame.south_m, frame.east_m, frame.north_m);
    canonical.out().PutRaw(std::as_bytes(spec.grid->heights_m()));
  } else if (spec.plane) {
    canonical.PutAll(2, spec.plane->z_m, spec.plane->slope_x, spec.plane->slope_y);
  } else if (spec.network != nullptr) {
    canonical.PutAll(6, static_cast<std::size_t>(spec.network_hash));  // 3 was without paint
  }
  if (spec.network != nullptr && (spec.grid != nullptr || spec.plane)) {
    canonical.PutAll(4, static_cast<std::size_t>(HashOf(*spec.network)), spec.junctions.size());
  }
  if (spec.detail != nullptr && spec.detail->digest() != 0)
    canonical.PutAll(5, static_cast<std::size_t>(spec.detail->digest()));
  if (spec.props != nullptr) PutProps(canonical, *spec.props);
  canonical.Put(spec.terrain_surface);
  canonical.Put(spec.terrain_friction.value_or(spec.friction[static_cast<std::size_t>(spec.terrain_surface)]));
  for (const double friction : spec.friction) canonical.Put(friction);
  const StartPose& start = spec.start;
  canonical.PutAll(start.x_m, start.y_m, start.heading_rad, start.road, start.lane, start.s_m);
  return base::Hash(canonical.out().bytes());
}

}  // namespace rodeira::road
