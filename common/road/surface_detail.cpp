#include "common/road/surface_detail.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "common/surface/crg_file.hpp"

namespace rodeira::road {
namespace {

constexpr double kAlong_m = 1.0, kAcross_m = 0.5;  // over which a stretch passes into nothing

// A height that is faded, with its derivatives.
struct Raise {
  double z = 0.0, by_s = 0.0, by_t = 0.0;

  // Times a factor that changes by the slopes given.
  void Fade(double factor, double slope_s, double slope_t) {
    by_s = by_s * factor + z * slope_s;
    by_t = by_t * factor + z * slope_t;
    z *= factor;
  }
};

// The fade at a distance from where there is nothing: its value and its slope by that distance.
std::pair<double, double> FadeAt(double distance_m, double over_m) {
  if (distance_m <= 0.0) return {0.0, 0.0};
  if (distance_m >= over_m) return {1.0, 0.0};
  const double u = distance_m / over_m;
  return {u * u * (3.0 - 2.0 * u), 6.0 * u * (1.0 - u) / over_m};
}

}  // namespace

base::Result<SurfaceDetail> SurfaceDetail::Load(const network::Network& network, const std::filesystem::path& folder) {
  SurfaceDetail detail;
  std::map<std::string, std::shared_ptr<const surface::CrgSurface>> files;
  for (std::uint32_t i = 0; i < network.roads().size(); ++i) {
    const network::RoadSpec& spec = network.roads()[i].spec();
    std::vector<Stretch> stretches;
    for (const network::CrgSurface& crg : spec.crg) {
      if (crg.purpose == "friction" || (crg.mode != "attached" && crg.mode != "attached0")) continue;
      const std::filesystem::path named = crg.file;
      const std::string path = (named.is_absolute() ? named : folder / named).string();
      auto& file = files[path];
      if (file == nullptr) {
        auto loaded = surface::LoadCrg(path);
        if (!loaded) return loaded.error();
        file = loaded.value().surface;
      }
      stretches.push_back({crg.s_start_m, crg.s_end_m, crg.s_offset_m, nullptr, file, crg.t_offset_m, crg.z_offset_m, crg.z_scale,
                           crg.orientation == "opposite"});
    }
    for (const network::Unevenness& uneven : spec.unevenness) {
      stretches.push_back({uneven.s_start_m, uneven.s_end_m, uneven.s_offset_m,
                           std::make_shared<const surface::Roughness>(surface::RoughnessSpec{uneven.density_m3, uneven.seed}), nullptr});
    }
    if (stretches.empty()) continue;
    detail.roads_.resize(network.roads().size());
    detail.roads_[i] = std::move(stretches);
  }
  return detail;
}

void SurfaceDetail::Add(const network::Road& road, std::uint32_t index, const network::LaneSection& section, double s_m, double t_m,
                        network::SurfaceSample& sample) const {
  if (roads_.empty() || roads_[index].empty()) return;
  const geometry::CubicPoint centre = road.CentreAt(s_m);
  const auto edge = [&](double far) {
    double outside;
    const network::LaneSpan span = section.At(far, centre, s_m, outside);
    return std::pair(far + (far > 0.0 ? -outside : outside), span.outer_slope);
  };
  for (const Stretch& stretch : roads_[index]) {
    if (s_m <= stretch.begin_m || s_m >= stretch.end_m) continue;
    Raise raise;
    if (stretch.made != nullptr) {
      const surface::RoughnessPoint at = stretch.made->At(s_m + stretch.s_offset_m, t_m);
      raise = {at.z_m, at.dz_ds, at.dz_dt};
    } else {
      // attached: the grid's u and v go along the road's s and t from the stretch's beginning; against it from its end.
      const surface::CrgReferenceLine& line = stretch.measured->line();
      const double sign = stretch.opposite ? -1.0 : 1.0;
      const double along = s_m - stretch.begin_m + stretch.s_offset_m;
      const double u = stretch.opposite ? line.end_u_m() - along : line.begin_u_m() + along;
      const surface::CrgPoint at = stretch.measured->At(u, sign * (t_m - stretch.t_offset_m));
      if (!at.inside) continue;
      raise = {stretch.z_scale * at.z_m + stretch.z_offset_m, sign * stretch.z_scale * at.dz_du, sign * stretch.z_scale * at.dz_dv};
    }
    const auto [left, left_slope] = edge(1e4);
    const auto [right, right_slope] = edge(-1e4);
    const auto [from_begin, begin_slope] = FadeAt(s_m - stretch.begin_m, kAlong_m);
    raise.Fade(from_begin, begin_slope, 0.0);
    const auto [to_end, end_slope] = FadeAt(stretch.end_m - s_m, kAlong_m);
    raise.Fade(to_end, -end_slope, 0.0);
    const auto [from_left, fade_left] = FadeAt(left - t_m, kAcross_m);
    raise.Fade(from_left, fade_left * left_slope, -fade_left);
    const auto [from_right, fade_right] = FadeAt(t_m - right, kAcross_m);
    raise.Fade(from_right, -fade_right * right_slope, fade_right);
    sample.p_W.z() += raise.z;
    sample.ds_W.z() += raise.by_s;
    sample.dt_W.z() += raise.by_t;
  }
}

}  // namespace rodeira::road
