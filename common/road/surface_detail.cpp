#include "common/road/surface_detail.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "common/base/bytes.hpp"
#include "common/base/suggest.hpp"
#include "common/surface/crg_file.hpp"

namespace rodeira::road {
namespace {

constexpr double kAlong_m = 1.0, kAcross_m = 0.5;  // over which a stretch passes into nothing
constexpr double kMostFriction = 2.0;

// A height that is faded, with its derivatives.
struct Raise {
  double z = 0.0, by_s = 0.0, by_t = 0.0;

  // Times a factor that changes by the slopes given.
  void Fade(double factor, double slope_s, double slope_t) {
    by_s = by_s * factor + z * slope_s;
    by_t = by_t * factor + z * slope_t;
    z *= factor;
  }
  // Of what is laid instead of the road: over its surface.
  void Replace(const network::SurfaceSample& sample) {
    z -= sample.p_W.z();
    by_s -= sample.ds_W.z();
    by_t -= sample.dt_W.z();
  }
};

// v, turned by the angle of `turn`, which has unit length.
Eigen::Vector2d Turned(const Eigen::Vector2d& v, const Eigen::Vector2d& turn) {
  return {v.x() * turn.x() - v.y() * turn.y(), v.x() * turn.y() + v.y() * turn.x()};
}

// Every number that can change an answer.
void PutAll(const surface::CrgSurface& surface, base::ByteWriter& out) {
  const auto put = [&out](double value) { out.Put(value + 0.0); };  // -0 is 0
  const surface::CrgShape& shape = surface.shape();
  for (const auto* numbers : {&shape.v_m, &shape.heights, &shape.line_z_m, &shape.banking}) {
    out.Put(static_cast<std::uint64_t>(numbers->size()));
    for (const double number : *numbers) put(std::isnan(number) ? 1e300 : number);  // a missing height, whichever NaN it is
  }
  put(shape.line.begin_u_m());
  put(shape.line.step_m());
  for (const Eigen::Vector2d& p : shape.line.points_W()) put(p.x()), put(p.y());
  const surface::CrgOptions& options = shape.options;
  out.Put(static_cast<std::uint32_t>(options.border_u));
  out.Put(static_cast<std::uint32_t>(options.border_v));
  for (const double number : {options.offset_u_m, options.offset_v_m, options.smooth_begin_m, options.smooth_end_m}) put(number);
  out.Put(static_cast<std::uint32_t>(options.close_track));
}

// The fade at a distance from where there is nothing: its value and its slope by that distance.
std::pair<double, double> FadeAt(double distance_m, double over_m) {
  if (distance_m <= 0.0) return {0.0, 0.0};
  if (distance_m >= over_m) return {1.0, 0.0};
  const double u = distance_m / over_m;
  return {u * u * (3.0 - 2.0 * u), 6.0 * u * (1.0 - u) / over_m};
}

// The road's outermost edges at s, and how they move with it.
struct Edges {
  double right_m, right_slope, left_m, left_slope;

  Edges(const network::Road& road, const network::LaneSection& section, double s_m) {
    const geometry::CubicPoint centre = road.CentreAt(s_m);
    const auto edge = [&](double far) {
      double outside;
      const network::LaneSpan span = section.At(far, centre, s_m, outside);
      return std::pair(far + (far > 0.0 ? -outside : outside), span.outer_slope);
    };
    std::tie(left_m, left_slope) = edge(1e4);
    std::tie(right_m, right_slope) = edge(-1e4);
  }
  // To nothing at both edges.
  void Fade(double t_m, Raise& raise) const {
    const auto [from_left, fade_left] = FadeAt(left_m - t_m, kAcross_m);
    raise.Fade(from_left, fade_left * left_slope, -fade_left);
    const auto [from_right, fade_right] = FadeAt(t_m - right_m, kAcross_m);
    raise.Fade(from_right, -fade_right * right_slope, fade_right);
  }
};

// What is laid on a road, as numbers.
void PutLaid(const network::Laid& laid, base::ByteWriter& out) {
  const auto put = [&out](double value) { out.Put(value + 0.0); };  // -0 is 0
  const auto put_piece = [&put](const network::LaidPiece& piece) { put(piece.from_s_m), put(piece.to_s_m), put(piece.right_t_m), put(piece.left_t_m); };
  out.Put(static_cast<std::uint64_t>(laid.patches.size()));
  for (const network::Patch& patch : laid.patches) {
    put_piece(patch.piece);
    out.PutString(patch.surface);
    put(patch.friction);
  }
  out.Put(static_cast<std::uint64_t>(laid.bumps.size()));
  for (const network::Bump& bump : laid.bumps) {
    put_piece(bump.piece);
    put(bump.side_m);
    for (const geometry::Cubic& cubic : bump.height.records()) put(cubic.from), put(cubic.a), put(cubic.b), put(cubic.c), put(cubic.d);
  }
}

std::optional<terrain::Surface> SurfaceByName(std::string_view name) {
  for (const terrain::Surface surface : {terrain::Surface::kAsphalt, terrain::Surface::kConcrete, terrain::Surface::kGravel, terrain::Surface::kGrass,
                                         terrain::Surface::kSoil}) {
    if (name == terrain::SurfaceName(surface)) return surface;
  }
  return std::nullopt;
}

}  // namespace

// What a measured surface says at a place, over z = 0.
struct SurfaceDetail::Measured {
  Raise height;
  bool inside = false;
};

base::Result<SurfaceDetail::Stretch> SurfaceDetail::Place(const network::Road& road, const network::CrgSurface& crg,
                                                          std::shared_ptr<const surface::CrgSurface> file) {
  const std::vector<std::string> modes = {"attached", "attached0", "genuine", "global"};
  const auto wrong = [&](std::string_view what, const std::string& found, const std::vector<std::string>& known) {
    return base::WrongInput(fmt::format("'{}' is no {} of a measured surface{}", found, what, base::DidYouMean(found, known)),
                            fmt::format("road {}, s {:g}, '{}'", road.id(), crg.s_start_m, crg.file));
  };
  if (std::find(modes.begin(), modes.end(), crg.mode) == modes.end()) return wrong("mode", crg.mode, modes);
  if (crg.orientation != "same" && crg.orientation != "opposite") return wrong("orientation", crg.orientation, {"same", "opposite"});
  if (crg.purpose != "elevation" && crg.purpose != "friction") return wrong("purpose", crg.purpose, {"elevation", "friction"});
  Stretch stretch{crg.s_start_m, crg.s_end_m, crg.s_offset_m, nullptr, std::move(file), crg.t_offset_m, crg.z_offset_m, crg.z_scale, crg.orientation == "opposite"};
  stretch.friction = crg.purpose == "friction";
  if (crg.mode == "attached") return stretch;
  stretch.lay = crg.mode == "attached0" ? Lay::kInstead : Lay::kByItself;
  if (crg.mode != "genuine") return stretch;
  // The line's beginning comes to lie on the road at sStart + sOffset and tOffset, in the road's direction there, turned by hOffset; of
  // one that runs against the road its end, looking back.
  const surface::CrgReferenceLine& line = stretch.measured->line();
  const geometry::PlanPoint at = road.axis().Evaluate(crg.s_start_m + crg.s_offset_m);
  const double u = stretch.opposite ? line.end_u_m() : line.begin_u_m();
  const Eigen::Vector2d ahead = (stretch.opposite ? -1.0 : 1.0) * line.DirectionAt(u).normalized();
  const Eigen::Vector2d wanted = Turned(at.tangent_W, {std::cos(crg.h_offset_rad), std::sin(crg.h_offset_rad)});
  stretch.turn = Turned(wanted, {ahead.x(), -ahead.y()});
  stretch.from_W = line.Position(u, 0.0);
  stretch.to_W = at.p_W + crg.t_offset_m * at.left_W();
  return stretch;
}

base::Result<SurfaceDetail> SurfaceDetail::Load(const network::Network& network, const std::filesystem::path& folder, std::span<const network::Laid> laid) {
  SurfaceDetail detail;
  std::map<std::string, std::shared_ptr<const surface::CrgSurface>> files;
  base::ByteWriter numbers;
  for (std::uint32_t i = 0; i < network.roads().size(); ++i) {
    const network::RoadSpec& spec = network.roads()[i].spec();
    std::vector<Stretch> stretches;
    for (const network::CrgSurface& crg : spec.crg) {
      const std::filesystem::path named = crg.file;
      const std::string path = (named.is_absolute() ? named : folder / named).string();
      auto& file = files[path];
      if (file == nullptr) {
        auto loaded = surface::LoadCrg(path);
        if (!loaded) return loaded.error();
        file = loaded.value().surface;
      }
      auto stretch = Place(network.roads()[i], crg, file);
      if (!stretch) return stretch.error();
      PutAll(*file, numbers);
      stretches.push_back(std::move(stretch).value());
    }
    for (const network::Unevenness& uneven : spec.unevenness) {
      stretches.push_back({uneven.s_start_m, uneven.s_end_m, uneven.s_offset_m,
                           std::make_shared<const surface::Roughness>(surface::RoughnessSpec{uneven.density_m3, uneven.seed}), nullptr});
    }
    if (stretches.empty()) continue;
    detail.roads_.resize(network.roads().size());
    detail.roads_[i] = std::move(stretches);
  }
  detail.laid_.assign(laid.begin(), laid.end());
  for (const network::Laid& on_road : laid) PutLaid(on_road, numbers);
  if (!numbers.bytes().empty()) detail.digest_ = base::Hash(numbers.bytes());
  return detail;
}

SurfaceDetail::Measured SurfaceDetail::Measure(const Stretch& stretch, double s_m, double t_m, const network::SurfaceSample& sample) {
  const double scale = stretch.z_scale, sign = stretch.opposite ? -1.0 : 1.0;
  if (stretch.lay == Lay::kByItself) {
    const Eigen::Vector2d back(stretch.turn.x(), -stretch.turn.y());
    const Eigen::Vector2d p = stretch.from_W + Turned(sample.p_W.head<2>() - stretch.to_W, back);
    const surface::CrgGround at = stretch.measured->Ground(p.x(), p.y());
    const Eigen::Vector2d slope = scale * Turned({at.slope_x, at.slope_y}, stretch.turn);
    return {{scale * at.z_m + stretch.z_offset_m, slope.dot(sample.ds_W.head<2>()), slope.dot(sample.dt_W.head<2>())}, at.inside};
  }
  // The grid's u and v go along the road's s and t from the stretch's beginning; against it from its end.
  const surface::CrgReferenceLine& line = stretch.measured->line();
  const double along = s_m - stretch.begin_m + stretch.s_offset_m;
  const double u = stretch.opposite ? line.end_u_m() - along : line.begin_u_m() + along;
  const surface::CrgPoint at = stretch.measured->At(u, sign * (t_m - stretch.t_offset_m));
  return {{scale * at.z_m + stretch.z_offset_m, sign * scale * at.dz_du, sign * scale * at.dz_dv}, at.inside};
}

std::optional<double> SurfaceDetail::FrictionAt(std::uint32_t road, double s_m, double t_m, const Eigen::Vector2d& p_W) const {
  std::optional<double> friction;
  if (roads_.empty()) return friction;
  network::SurfaceSample sample;
  sample.p_W.head<2>() = p_W;
  for (const Stretch& stretch : roads_[road]) {
    if (!stretch.friction || s_m < stretch.begin_m || s_m > stretch.end_m) continue;
    const Measured measured = Measure(stretch, s_m, t_m, sample);
    if (measured.inside) friction = std::clamp(measured.height.z, 0.0, kMostFriction);
  }
  return friction;
}

void SurfaceDetail::Add(const network::Road& road, std::uint32_t index, const network::LaneSection& section, double s_m, double t_m,
                        network::SurfaceSample& sample) const {
  const auto add = [&](Raise& raise) {
    Edges(road, section, s_m).Fade(t_m, raise);
    sample.p_W.z() += raise.z;
    sample.ds_W.z() += raise.by_s;
    sample.dt_W.z() += raise.by_t;
  };
  static const std::vector<Stretch> kNone;
  for (const Stretch& stretch : roads_.empty() ? kNone : roads_[index]) {
    if (stretch.friction || s_m <= stretch.begin_m || s_m >= stretch.end_m) continue;
    Raise raise;
    if (stretch.made != nullptr) {
      const surface::RoughnessPoint at = stretch.made->At(s_m + stretch.s_offset_m, t_m);
      raise = {at.z_m, at.dz_ds, at.dz_dt};
    } else {
      const Measured measured = Measure(stretch, s_m, t_m, sample);
      if (!measured.inside) continue;
      raise = measured.height;
      if (stretch.lay != Lay::kOnTop) raise.Replace(sample);
    }
    const auto [from_begin, begin_slope] = FadeAt(s_m - stretch.begin_m, kAlong_m);
    raise.Fade(from_begin, begin_slope, 0.0);
    const auto [to_end, end_slope] = FadeAt(stretch.end_m - s_m, kAlong_m);
    raise.Fade(to_end, -end_slope, 0.0);
    add(raise);
  }
  if (laid_.empty()) return;
  for (const network::Bump& bump : laid_[index].bumps) {
    const network::Bump::Height height = bump.At(s_m, t_m);
    Raise raise{height.z_m, height.by_s, height.by_t};
    if (bump.piece.Holds(s_m, t_m)) add(raise);
  }
}

network::Bump::Height SurfaceDetail::RaisedAt(std::uint32_t road, double s_m, double t_m) const {
  network::Bump::Height all;
  if (laid_.empty()) return all;
  for (const network::Bump& bump : laid_[road].bumps) {
    const network::Bump::Height height = bump.At(s_m, t_m);
    all.z_m += height.z_m, all.by_s += height.by_s, all.by_t += height.by_t;
  }
  return all;
}

bool SurfaceDetail::On(std::uint32_t road, double low_s_m, double high_s_m) const {
  if (!roads_.empty() && !roads_[road].empty()) return true;
  const auto near = [&](const auto& laid) { return high_s_m >= laid.piece.from_s_m && low_s_m <= laid.piece.to_s_m; };
  if (laid_.empty()) return false;
  return std::any_of(laid_[road].patches.begin(), laid_[road].patches.end(), near) || std::any_of(laid_[road].bumps.begin(), laid_[road].bumps.end(), near);
}

void SurfaceDetail::Cover(std::uint32_t road, double s_m, double t_m, LaneGround& ground) const {
  if (laid_.empty()) return;
  for (const network::Patch& patch : laid_[road].patches) {
    if (!patch.piece.Holds(s_m, t_m)) continue;
    ground.surface = SurfaceByName(patch.surface).value_or(ground.surface);
    ground.friction = patch.friction;
  }
}

}  // namespace rodeira::road
