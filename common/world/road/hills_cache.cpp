// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/hills_cache.hpp"

#include <cstring>
#include <utility>
#include <vector>

#include "common/core/base/bytes.hpp"

namespace rodeira::road {
namespace {

constexpr const char* kHillsKind = "hills 1";

// Of all arguments of MakeHills that change a height.
base::Digest SourceOf(const HillsSpec& spec, std::span<const AxisPoint> axis) {
  base::ByteWriter out;
  out.Put(spec.seed);
  for (const int count : {spec.columns, spec.rows}) out.Put(count);
  for (const double value :
       {spec.west_m, spec.south_m, spec.spacing_m, spec.below_m, spec.flat_m, spec.full_m, spec.reach_m})
    out.Put(value);
  out.Put(spec.base_z_m.has_value());
  out.Put(spec.base_z_m.value_or(0.0));
  out.Put(static_cast<std::uint64_t>(spec.relief.size()));
  for (const Relief& relief : spec.relief) out.Put(relief.wavelength_m), out.Put(relief.amplitude_m);
  for (const AxisPoint& point : axis) {
    for (Eigen::Index i = 0; i < 3; ++i) out.Put(point.p_W[i]);
    out.Put(point.length_m);
  }
  return base::Hash(out.bytes());
}

}  // namespace

terrain::ElevationGrid MakeHillsOnce(const HillsSpec& spec, std::span<const AxisPoint> axis, base::FileCache* cache) {
  if (cache == nullptr || !cache->is_used()) return MakeHills(spec, axis);
  const base::Digest source = SourceOf(spec, axis);
  const auto posts = static_cast<std::size_t>(spec.columns) * static_cast<std::size_t>(spec.rows);
  if (const auto kept = cache->Find(kHillsKind, source); kept && kept->size() == posts * sizeof(float)) {
    std::vector<float> heights_m(posts);
    std::memcpy(heights_m.data(), kept->data(), kept->size());
    return terrain::ElevationGrid(FrameOf(spec), std::move(heights_m), spec.projection_wkt);
  }
  terrain::ElevationGrid made = MakeHills(spec, axis);
  cache->Keep(kHillsKind, source, std::as_bytes(made.heights_m()));
  return made;
}

}  // namespace rodeira::road
