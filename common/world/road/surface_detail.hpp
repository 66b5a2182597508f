// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/core/base/hash.hpp"
#include "common/core/base/result.hpp"
#include "common/world/network/laid.hpp"
#include "common/world/network/network.hpp"
#include "common/world/road/lane_grounds.hpp"
#include "common/world/road/surface_fade.hpp"
#include "common/world/road/surface_point.hpp"
#include "common/world/surface/crg_file.hpp"
#include "common/world/surface/crg_surface.hpp"
#include "common/world/surface/roughness.hpp"

namespace rodeira::road {

// What stands on top of a network's roads, or takes the place of their heights: measured surfaces (OpenCRG), made
// roughness, and what an author lays on them: bumps, and patches of another ground.
class SurfaceDetail {
 public:
  SurfaceDetail() = default;
  // Wrong input where a measured surface cannot be read. Relative names are those of files beside `folder`. laid: by
  // road, or nothing. file_of: a surface by the name that the network says; nothing: it is loaded.
  using FileOf = std::function<base::Result<surface::CrgFile>(const std::string& name)>;
  static base::Result<SurfaceDetail> Load(const network::Network& network, const std::filesystem::path& folder,
                                          std::span<const network::Laid> laid = {}, const FileOf& file_of = {});

  bool empty() const { return roads_.empty() && laid_.empty(); }
  // Whether anything is there between two stations of a road.
  bool On(std::uint32_t road, double low_s_m, double high_s_m) const;
  // What is seen of it: no made roughness, of measured heights what is left when waves of up to some 2 m are taken out;
  // what an author lays, whole.
  SurfaceDetail AsSeen() const;
  // Whether that is something else.
  bool IsFine() const;
  // Of every number of the measured surfaces, with places in the network, and of what is laid. 0: there are none.
  base::Digest digest() const { return digest_; }
  // Of what lies on a road between two stations, whole where it reaches in: a measured surface's numbers and place,
  // made roughness, patches and bumps. 0: nothing.
  base::Digest DigestOn(std::uint32_t road, double from_s_m, double to_s_m) const;
  // What stands over the road at (s, t) between its outermost edges, added to the sample. Over the first and last metre
  // of a measured or made stretch, and of all the last half metre to the road's edges, it passes into nothing. A
  // stretch that goes on in a junction passes over the last metre before it into what lies on its way there.
  void Add(const network::Road& road, std::uint32_t index, const network::LaneSection& section, double s_m, double t_m,
           network::SurfaceSample& sample) const;
  // The measured coefficient of friction there; nothing where none is.
  std::optional<double> FrictionAt(std::uint32_t road, double s_m, double t_m, const Eigen::Vector2d& p_W) const;
  // What measured and made stretches raise a way through a junction by at (s, t), over the junction's own surface: to
  // nothing at the edges of its lanes. left: how much of the place they leave to ways that cross it.
  Raised AddOnWay(const network::Road& way, std::uint32_t index, const network::LaneSection& section, double s_m,
                  double t_m, Share& left) const;
  // The heights of all bumps at (s, t), as they are away from the road's edges.
  network::Bump::Height RaisedAt(std::uint32_t road, double s_m, double t_m) const;
  // A sentence for each measured surface with heights that are added to a road's, and which begins or ends 10 cm or
  // more above or below it in the mean of the lanes that are driven on: there is a wall, climbed within the metre over
  // which it passes into nothing. It names the offset that would lay it on the road.
  std::vector<std::string> Walls(const network::Network& network) const;
  // What was passed over in the measured surfaces' files: a sentence for each file, with the first place.
  std::span<const std::string> warnings() const { return warnings_; }
  // A patch at (s, t) takes the place of the ground.
  void Cover(std::uint32_t road, double s_m, double t_m, LaneGround& ground) const;

 private:
  // How a measured surface lies (OpenDRIVE's `mode`).
  enum class Lay : std::uint8_t {
    kOnTop,     // attached: u and v are the road's s and t, heights are added to the road's
    kInstead,   // attached0: so too, but these heights are the road's
    kByItself,  // genuine, global: its own reference line holds, and its heights are the road's
  };
  struct Stretch {
    double begin_m, end_m;  // beyond the road's ends where it goes on in a junction
    double s_offset_m;
    std::shared_ptr<const surface::Roughness> made;  // or
    std::shared_ptr<const surface::CrgSurface> measured;
    base::Digest source = 0;  // of the numbers of its file, or of what it is made from
    double t_offset_m = 0.0, z_offset_m = 0.0, z_scale = 1.0;
    bool opposite = false;
    Lay lay = Lay::kOnTop;
    bool friction = false;  // it says the coefficient of friction instead of a height
    // By itself: what turns by `turn` and lies at `from_W` in the file, lies at `to_W` here.
    Eigen::Vector2d turn = Eigen::Vector2d::UnitX(), from_W = Eigen::Vector2d::Zero(), to_W = Eigen::Vector2d::Zero();
  };
  struct Measured;
  static Stretch Place(const network::Road& road, const network::CrgSurface& crg,
                       std::shared_ptr<const surface::CrgSurface> file);
  static std::optional<Raised> HeightOf(const Stretch& stretch, double s_m, double t_m,
                                        const network::SurfaceSample& sample, Share& ends);
  void FindWays(const network::Network& network);
  static Measured Measure(const Stretch& stretch, double s_m, double t_m, const network::SurfaceSample& sample);

  std::vector<std::string> warnings_;
  std::vector<std::vector<Stretch>> roads_;  // by road; empty: there is none at all
  struct Ways {
    std::optional<RoadEdges> in, out;  // the edges of the way that comes to its beginning, and of the one from its end
  };
  std::vector<Ways> ways_;           // the same
  std::vector<network::Laid> laid_;  // the same
  base::Digest digest_ = 0;
};

}  // namespace rodeira::road
