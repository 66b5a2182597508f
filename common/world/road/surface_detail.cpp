// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/surface_detail.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <tuple>

#include "common/core/base/bytes.hpp"
#include "common/world/surface/crg_file.hpp"
#include "common/world/surface/crg_smooth.hpp"

namespace rodeira::road {
namespace {

constexpr double kMaxFriction = 2.0;
constexpr double kSeenReach_m = 1.0;  // over so much to either side measured heights are smoothed, twice

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
    for (const double number : *numbers)
      put(std::isnan(number) ? 1e300 : number);  // a missing height, whichever NaN it is
  }
  put(shape.line.begin_u_m());
  put(shape.line.step_m());
  for (const Eigen::Vector2d& p : shape.line.points_W()) put(p.x()), put(p.y());
  const surface::CrgOptions& options = shape.options;
  out.Put(static_cast<std::uint32_t>(options.border_u));
  out.Put(static_cast<std::uint32_t>(options.border_v));
  for (const double number : {options.offset_u_m, options.offset_v_m, options.smooth_begin_m, options.smooth_end_m})
    put(number);
  out.Put(static_cast<std::uint32_t>(options.close_track));
}

// What is laid on a road, as numbers.
void PutLaid(const network::Laid& laid, base::ByteWriter& out) {
  const auto put = [&out](double value) { out.Put(value + 0.0); };  // -0 is 0
  const auto put_piece = [&put](const network::LaidPiece& piece) {
    put(piece.from_s_m), put(piece.to_s_m), put(piece.right_t_m), put(piece.left_t_m);
  };
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
    for (const geometry::Cubic& cubic : bump.height.records())
      put(cubic.from), put(cubic.a), put(cubic.b), put(cubic.c), put(cubic.d);
  }
}

std::optional<ground::Surface> SurfaceByName(std::string_view name) {
  for (const ground::Surface surface : {ground::Surface::kAsphalt, ground::Surface::kConcrete, ground::Surface::kGravel,
                                        ground::Surface::kGrass, ground::Surface::kSoil}) {
    if (name == ground::SurfaceName(surface)) return surface;
  }
  return std::nullopt;
}

}  // namespace

namespace {

// What counts at t beside the end of a road that goes on in a junction: there its way's, which has no shoulders.
Share TowardsWay(const Share& share, const RoadEdges& way, double t_m, double to_end_m, double sign) {
  const auto [weight, slope] = FadeAt(to_end_m, kFadesAlong_m);
  return share.Mixed(way.FromLeft(t_m) * way.FromRight(t_m), weight, sign * slope);
}

}  // namespace

// What a measured surface says at a place, over z = 0.
struct SurfaceDetail::Measured {
  Raised height;
  bool inside = false;
};

SurfaceDetail::Stretch SurfaceDetail::Place(const network::Road& road, const network::CrgSurface& crg,
                                            std::shared_ptr<const surface::CrgSurface> file) {
  Stretch stretch{crg.s_start_m,   crg.s_end_m,
                  crg.s_offset_m,  nullptr,
                  std::move(file), 0,
                  crg.t_offset_m,  crg.z_offset_m,
                  crg.z_scale,     crg.orientation == "opposite"};
  stretch.friction = crg.purpose == "friction";
  if (crg.mode == "attached") return stretch;
  stretch.lay = crg.mode == "attached0" ? Lay::kInstead : Lay::kByItself;
  if (crg.mode != "genuine") return stretch;
  // The line's beginning comes to lie on the road at sStart + sOffset and tOffset, in the road's direction there,
  // turned by hOffset; of one that runs against the road its end, looking back.
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

base::Result<SurfaceDetail> SurfaceDetail::Load(const network::Network& network, const std::filesystem::path& folder,
                                                std::span<const network::Laid> laid, const FileOf& file_of) {
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
        auto loaded = file_of ? file_of(crg.file) : surface::LoadCrg(path);
        if (!loaded) return loaded.error().In(fmt::format("road {}, s {:g}", network.roads()[i].id(), crg.s_start_m));
        file = loaded.value().surface;
        const std::vector<std::string>& said = loaded.value().warnings;
        if (!said.empty())
          detail.warnings_.push_back(fmt::format("{}: {}{}", path, said.front(),
                                                 said.size() > 1 ? fmt::format(" ({} warnings)", said.size()) : ""));
      }
      Stretch stretch = Place(network.roads()[i], crg, file);
      const std::size_t before = numbers.bytes().size();
      PutAll(*file, numbers);
      stretch.source = base::Hash(std::span(numbers.bytes()).subspan(before));
      stretches.push_back(std::move(stretch));
    }
    for (const network::Unevenness& uneven : spec.unevenness) {
      stretches.push_back(
          {uneven.s_start_m, uneven.s_end_m, uneven.s_offset_m,
           std::make_shared<const surface::Roughness>(surface::RoughnessSpec{uneven.density_m3, uneven.seed}), nullptr,
           base::Hash(fmt::format("{} {}", uneven.density_m3, uneven.seed))});
    }
    if (stretches.empty()) continue;
    detail.roads_.resize(network.roads().size());
    detail.roads_[i] = std::move(stretches);
  }
  detail.FindWays(network);
  detail.laid_.assign(laid.begin(), laid.end());
  for (const network::Laid& on_road : laid) PutLaid(on_road, numbers);
  if (!numbers.bytes().empty()) detail.digest_ = base::Hash(numbers.bytes());
  return detail;
}

base::Digest SurfaceDetail::DigestOn(std::uint32_t road, double from_s_m, double to_s_m) const {
  base::ByteWriter out;
  const auto put = [&out](double value) { out.Put(value + 0.0); };  // -0 is 0
  for (const Stretch& stretch : roads_.empty() ? std::vector<Stretch>() : roads_[road]) {
    if (stretch.begin_m > to_s_m || stretch.end_m < from_s_m) continue;
    out.Put(stretch.source);
    for (const double number :
         {stretch.begin_m, stretch.end_m, stretch.s_offset_m, stretch.t_offset_m, stretch.z_offset_m, stretch.z_scale})
      put(number);
    out.Put(static_cast<std::uint8_t>(stretch.opposite)), out.Put(stretch.lay),
        out.Put(static_cast<std::uint8_t>(stretch.friction));
    for (const Eigen::Vector2d& p : {stretch.turn, stretch.from_W, stretch.to_W}) put(p.x()), put(p.y());
  }
  if (!laid_.empty()) {
    network::Laid laid;
    const auto reaches_in = [&](const auto& lies) {
      return lies.piece.from_s_m <= to_s_m && lies.piece.to_s_m >= from_s_m;
    };
    std::copy_if(laid_[road].patches.begin(), laid_[road].patches.end(), std::back_inserter(laid.patches), reaches_in);
    std::copy_if(laid_[road].bumps.begin(), laid_[road].bumps.end(), std::back_inserter(laid.bumps), reaches_in);
    if (!laid.empty()) PutLaid(laid, out);
  }
  return out.bytes().empty() ? 0 : base::Hash(out.bytes());
}

bool SurfaceDetail::IsFine() const {
  return std::any_of(roads_.begin(), roads_.end(), [](const auto& stretches) {
    return std::any_of(stretches.begin(), stretches.end(), [](const Stretch& stretch) { return !stretch.friction; });
  });
}

SurfaceDetail SurfaceDetail::AsSeen() const {
  SurfaceDetail seen = *this;
  std::map<const surface::CrgSurface*, std::shared_ptr<const surface::CrgSurface>> smooth;
  for (std::vector<Stretch>& stretches : seen.roads_) {
    std::erase_if(stretches, [](const Stretch& stretch) { return stretch.made != nullptr; });
    for (Stretch& stretch : stretches) {
      if (stretch.friction) continue;
      auto& file = smooth[stretch.measured.get()];
      if (file == nullptr)
        file = std::make_shared<const surface::CrgSurface>(surface::Smoothed(*stretch.measured, kSeenReach_m));
      stretch.measured = file;
    }
  }
  return seen;
}

// The ways through junctions that carry on what lies on a road, where it goes on.
void SurfaceDetail::FindWays(const network::Network& network) {
  ways_.resize(roads_.size());
  for (std::uint32_t i = 0; i < roads_.size(); ++i) {
    const network::Road& way = network.roads()[i];
    const network::RoadSpec& spec = way.spec();
    if (spec.junction.empty() || roads_[i].empty()) continue;
    const auto edges = [&way](double s_m) {
      RoadEdges at(way, way.SectionAt(s_m), s_m);
      at.left_slope = at.right_slope = 0.0;  // they stay as they are there
      return at;
    };
    const auto before =
        spec.predecessor && !spec.predecessor->s_m ? network.FindRoad(spec.predecessor->id) : std::nullopt;
    const auto behind = spec.successor && !spec.successor->s_m ? network.FindRoad(spec.successor->id) : std::nullopt;
    if (before && !roads_[*before].empty()) ways_[*before].out = edges(0.0);
    if (behind && !roads_[*behind].empty()) ways_[*behind].in = edges(way.length_m());
  }
}

SurfaceDetail::Measured SurfaceDetail::Measure(const Stretch& stretch, double s_m, double t_m,
                                               const network::SurfaceSample& sample) {
  const double scale = stretch.z_scale, sign = stretch.opposite ? -1.0 : 1.0;
  if (stretch.lay == Lay::kByItself) {
    const Eigen::Vector2d back(stretch.turn.x(), -stretch.turn.y());
    const Eigen::Vector2d p = stretch.from_W + Turned(sample.p_W.head<2>() - stretch.to_W, back);
    const surface::CrgGround at = stretch.measured->Ground(p.x(), p.y());
    const Eigen::Vector2d slope = scale * Turned({at.slope_x, at.slope_y}, stretch.turn);
    return {{scale * at.z_m + stretch.z_offset_m, slope.dot(sample.ds_W.head<2>()), slope.dot(sample.dt_W.head<2>())},
            at.inside};
  }
  // The grid's u and v go along the road's s and t from the stretch's beginning; against it from its end.
  const surface::CrgReferenceLine& line = stretch.measured->line();
  const double along = s_m - stretch.begin_m + stretch.s_offset_m;
  const double u = stretch.opposite ? line.end_u_m() - along : line.begin_u_m() + along;
  const surface::CrgPoint at = stretch.measured->At(u, sign * (t_m - stretch.t_offset_m));
  return {{scale * at.z_m + stretch.z_offset_m, sign * scale * at.dz_du, sign * scale * at.dz_dv}, at.inside};
}

std::optional<double> SurfaceDetail::FrictionAt(std::uint32_t road, double s_m, double t_m,
                                                const Eigen::Vector2d& p_W) const {
  std::optional<double> friction;
  if (roads_.empty()) return friction;
  network::SurfaceSample sample;
  sample.p_W.head<2>() = p_W;
  for (const Stretch& stretch : roads_[road]) {
    if (!stretch.friction || s_m < stretch.begin_m || s_m > stretch.end_m) continue;
    const Measured measured = Measure(stretch, s_m, t_m, sample);
    if (measured.inside) friction = std::clamp(measured.height.z_m, 0.0, kMaxFriction);
  }
  return friction;
}

// What a stretch says over an even road at z = 0, with the fades of its own ends; nothing where it is not.
std::optional<Raised> SurfaceDetail::HeightOf(const Stretch& stretch, double s_m, double t_m,
                                              const network::SurfaceSample& sample, Share& ends) {
  if (stretch.friction || s_m <= stretch.begin_m || s_m >= stretch.end_m) return std::nullopt;
  Raised raised;
  if (stretch.made != nullptr) {
    const surface::RoughnessPoint at = stretch.made->At(s_m + stretch.s_offset_m, t_m);
    raised = {at.z_m, at.dz_ds, at.dz_dt};
  } else {
    const Measured measured = Measure(stretch, s_m, t_m, sample);
    if (!measured.inside) return std::nullopt;
    raised = measured.height;
    if (stretch.lay != Lay::kOnTop) raised.Replace(sample);
  }
  const auto [from_begin, begin_slope] = FadeAt(s_m - stretch.begin_m, kFadesAlong_m);
  const auto [to_end, end_slope] = FadeAt(stretch.end_m - s_m, kFadesAlong_m);
  const Share begins{from_begin, begin_slope, 0.0}, ending{to_end, -end_slope, 0.0};
  raised.Fade(begins);
  raised.Fade(ending);
  ends = begins * ending;
  return raised;
}

void SurfaceDetail::Add(const network::Road& road, std::uint32_t index, const network::LaneSection& section, double s_m,
                        double t_m, network::SurfaceSample& sample) const {
  const auto add = [&](const Raised& raised) {
    sample.p_W.z() += raised.z_m;
    sample.ds_W.z() += raised.by_s;
    sample.dt_W.z() += raised.by_t;
  };
  const auto add_between_edges = [&](Raised raised) {
    const RoadEdges edges(road, section, s_m);
    raised.Fade(edges.FromLeft(t_m));
    raised.Fade(edges.FromRight(t_m));
    add(raised);
  };
  static const std::vector<Stretch> kNone;
  for (const Stretch& stretch : roads_.empty() ? kNone : roads_[index]) {
    Share ends;
    auto raised = HeightOf(stretch, s_m, t_m, sample, ends);
    if (!raised) continue;
    const bool goes_out = stretch.end_m > road.length_m() && road.length_m() - s_m < kFadesAlong_m,
               comes_in = stretch.begin_m < 0.0 && s_m < kFadesAlong_m;
    if (goes_out || comes_in) {
      const RoadEdges edges(road, section, s_m);
      Share share = edges.FromLeft(t_m) * edges.FromRight(t_m);
      if (goes_out && ways_[index].out) share = TowardsWay(share, *ways_[index].out, t_m, road.length_m() - s_m, -1.0);
      if (comes_in && ways_[index].in) share = TowardsWay(share, *ways_[index].in, t_m, s_m, 1.0);
      raised->Fade(share);
      add(*raised);
    } else {
      add_between_edges(*raised);
    }
  }
  if (laid_.empty()) return;
  for (const network::Bump& bump : laid_[index].bumps) {
    const network::Bump::Height height = bump.At(s_m, t_m);
    if (bump.piece.Holds(s_m, t_m)) add_between_edges({height.z_m, height.by_s, height.by_t});
  }
}

Raised SurfaceDetail::AddOnWay(const network::Road& way, std::uint32_t index, const network::LaneSection& section,
                               double s_m, double t_m, Share& left) const {
  Raised all;
  if (roads_.empty() || roads_[index].empty()) return all;
  Share none{1.0, 0.0, 0.0};  // how much of the place is left by all of its stretches
  for (const Stretch& stretch : roads_[index]) {
    Share ends;
    const auto raised = HeightOf(stretch, s_m, t_m, {}, ends);
    if (!raised) continue;
    all += *raised;
    none = none * Share{1.0 - ends.value, -ends.by_s, -ends.by_t};
  }
  const RoadEdges edges(way, section, s_m);
  const Share between = edges.FromLeft(t_m) * edges.FromRight(t_m);
  all.Fade(between);
  const Share taken = between * Share{1.0 - none.value, -none.by_s, -none.by_t};
  left = {1.0 - taken.value, -taken.by_s, -taken.by_t};
  return all;
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

std::vector<std::string> SurfaceDetail::Walls(const network::Network& network) const {
  constexpr double kWall_m = 0.1, kAcross_m = 0.25;
  std::vector<std::string> walls;
  for (std::uint32_t index = 0; index < roads_.size(); ++index) {
    const network::Road& road = network.roads()[index];
    std::size_t number = 0;
    for (const Stretch& stretch : roads_[index]) {
      if (stretch.measured == nullptr) continue;
      const network::CrgSurface& crg = road.spec().crg[number++];
      if (stretch.friction || stretch.lay != Lay::kOnTop || stretch.end_m - stretch.begin_m < 2.0 * kFadesAlong_m)
        continue;
      for (const bool begins : {true, false}) {
        const double s = begins ? stretch.begin_m + kFadesAlong_m : stretch.end_m - kFadesAlong_m;
        if (s < 0.0 || s > road.length_m() || (begins ? stretch.begin_m < 0.0 : stretch.end_m > road.length_m()))
          continue;  // it goes on
        double sum = 0.0;
        int count = 0;
        const auto section = static_cast<std::uint32_t>(road.SectionIndex(s));
        for (const auto* side : {&road.spec().sections[section].left, &road.spec().sections[section].right}) {
          for (const network::Lane& lane : *side) {
            if (!network::IsDrivable(lane.type)) continue;
            const network::LaneSpan span = *road.SpanAt(section, lane.id, s);
            for (double share = 0.5 * kAcross_m; share < 1.0; share += kAcross_m) {
              const Measured at = Measure(stretch, s, span.inner_t_m + share * (span.outer_t_m - span.inner_t_m), {});
              if (at.inside) sum += at.height.z_m, ++count;
            }
          }
        }
        if (count == 0 || std::fabs(sum / count) < kWall_m) continue;
        walls.push_back(
            fmt::format("the measured surface '{}' {} at s = {:.1f} m of road '{}' {:.2f} m {} the road, a wall within "
                        "{:g} m; a z offset of {:.3f} m lays it on the road there",
                        std::filesystem::path(crg.file).filename().string(), begins ? "begins" : "ends",
                        begins ? stretch.begin_m : stretch.end_m, road.id(), std::fabs(sum / count),
                        sum > 0.0 ? "above" : "below", kFadesAlong_m, stretch.z_offset_m - sum / count));
      }
    }
  }
  return walls;
}

bool SurfaceDetail::On(std::uint32_t road, double low_s_m, double high_s_m) const {
  if (!roads_.empty() && !roads_[road].empty()) return true;
  const auto near = [&](const auto& laid) { return high_s_m >= laid.piece.from_s_m && low_s_m <= laid.piece.to_s_m; };
  if (laid_.empty()) return false;
  return std::any_of(laid_[road].patches.begin(), laid_[road].patches.end(), near) ||
         std::any_of(laid_[road].bumps.begin(), laid_[road].bumps.end(), near);
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
