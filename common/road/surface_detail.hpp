#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "common/base/result.hpp"
#include "common/network/network.hpp"
#include "common/surface/crg_surface.hpp"
#include "common/surface/roughness.hpp"

namespace rodeira::road {

// What stands on top of a network's roads: measured surfaces (OpenCRG) and made roughness.
class SurfaceDetail {
 public:
  SurfaceDetail() = default;
  // Wrong input where a measured surface cannot be read. Relative names are those of files beside `folder`.
  static base::Result<SurfaceDetail> Load(const network::Network& network, const std::filesystem::path& folder);

  bool empty() const { return roads_.empty(); }
  // Height over the road at (s, t) between its outermost edges, added to the sample. Over the first and last metre of a
  // stretch, and the last half metre to the road's edges, it passes into nothing.
  void Add(const network::Road& road, std::uint32_t index, const network::LaneSection& section, double s_m, double t_m,
           network::SurfaceSample& sample) const;

 private:
  struct Stretch {
    double begin_m, end_m;
    double s_offset_m;
    std::shared_ptr<const surface::Roughness> made;  // or
    std::shared_ptr<const surface::CrgSurface> measured;
    double t_offset_m = 0.0, z_offset_m = 0.0, z_scale = 1.0;
    bool opposite = false;
  };
  std::vector<std::vector<Stretch>> roads_;  // by road; empty: there is none at all
};

}  // namespace rodeira::road
