// SPDX-License-Identifier: Apache-2.0
// Where a point lies in the network.
#include <algorithm>
#include <cmath>

#include "common/world/network/network.hpp"
#include "common/world/network/settle.hpp"

namespace rodeira::network {
namespace {

bool OnEarth(double coordinate_m) { return std::fabs(coordinate_m) < Network::kFarthest_m; }  // false for NaN

}  // namespace

bool Claim::Before(const Claim& other) const {
  if (past_end != other.past_end) return other.past_end;
  if (drivable != other.drivable) return drivable;
  if (from_centre_m != other.from_centre_m) return from_centre_m < other.from_centre_m;
  return band < other.band;
}

// A point seen from one band.
struct Network::Hit {
  Place place;  // without a height until SetHeight
  Claim claim;
  double outside_m = 0.0;   // across, without the height
  bool has_height = false;  // place.z_m is known already
  LaneSpan span;            // without its lane where the road is flat
  geometry::PlanPoint at;   // the reference line at place.s_m; its heading is not used
};

Network::Hit Network::Try(const Eigen::Vector2d& p_W, std::uint32_t band_index) const {
  const BandRecord& record = records_.Of(band_index);
  if (!(record.piece.from_s_m < record.piece.to_s_m)) return TryRoad(p_W, band_index);
  const Road& road = spec_.roads[record.road];
  const geometry::AxisPanel panel = record.Panel();
  const geometry::AxisFoot foot = road.axis().Foot(panel, p_W);
  const double low = record.low_s_m(), found = panel.middle_s_m + foot.u_m, s = std::clamp(found, low, record.high_s_m),
               t = foot.t_m;
  const BandPiece* piece = records_.PieceAt(record, s);
  if (piece == nullptr) return TryRoad(p_W, band_index);
  const double beyond = std::fabs(foot.beyond_m) + std::fabs(found - s);
  const BandRecords::LaneAt lane = records_.At(*piece, s, t);
  Hit hit;
  hit.span = lane.span;
  hit.outside_m = lane.outside_m;
  const bool closed = s <= low ? record.closed_before : record.closed_behind;
  if (beyond > (closed ? kClosed_m : BandIndex::kSlack_m))
    hit.outside_m = std::sqrt(hit.outside_m * hit.outside_m + beyond * beyond);
  hit.at = s == found ? foot.at : road.axis().At(panel, s - panel.middle_s_m);
  hit.claim = {beyond > 0.0, lane.drivable, lane.id == 0 ? 0.0 : std::fabs(t - lane.span.centre_t_m()), band_index};
  hit.place = {{record.road, piece->section, lane.id}, s, t, 0.0, hit.outside_m};
  if (piece->flat)
    hit.place.z_m = records_.Height(*piece, s), hit.has_height = true;
  else if (lane.id != 0)
    hit.span.lane = road.spec().sections[piece->section].Find(lane.id);
  return hit;
}

Network::Hit Network::TryRoad(const Eigen::Vector2d& p_W, std::uint32_t band_index) const {
  const Band& band = index_.bands()[band_index];
  const Road& road = spec_.roads[band.road];
  const geometry::AxisPanel& panel = road.axis().panels()[band.panel];
  const geometry::AxisFoot foot = road.axis().Foot(panel, p_W);
  Hit hit;
  hit.claim.band = band_index;
  const double low = std::max(panel.begin_s_m(), 0.0), high = std::min(panel.end_s_m(), road.length_m());
  const double found = panel.middle_s_m + foot.u_m;
  double s = std::clamp(found, low, high), t = foot.t_m;
  double beyond = std::fabs(foot.beyond_m) + std::fabs(found - s);
  std::size_t section_index;
  geometry::CubicPoint centre;
  const auto find_lane = [&] {
    section_index = road.SectionIndex(s), centre = road.CentreAt(s);
    hit.span = road.spec().sections[section_index].At(t, centre, s, hit.outside_m);
  };
  const bool leans = road.Leans(s);
  std::optional<Road::LeanFoot> on_lean = leans ? road.FootOnLean(panel, foot, low, high) : std::nullopt;
  if (on_lean) {
    s = on_lean->s_m, t = on_lean->t_m;
    find_lane();
    if (hit.span.lane != nullptr && hit.span.lane->level)
      on_lean.reset(), s = found, t = foot.t_m;  // its surface lies elsewhere
  }
  if (!on_lean) {
    if (leans) beyond = SettleOn(road, &panel, p_W, low, high, s, t);
    find_lane();
  }
  hit.claim.past_end = beyond > 0.0;
  if (leans && hit.outside_m > 0.0) {  // t runs along a slope there: what counts is seen from above
    const double edge = t + (t > centre.value ? -hit.outside_m : hit.outside_m);
    hit.outside_m = DistanceToEdgeOn(road, &panel, p_W, low, high, edge, s);
  } else if (beyond > (s <= low ? band.closed_before_m : band.closed_behind_m)) {
    hit.outside_m = std::sqrt(hit.outside_m * hit.outside_m + beyond * beyond);
  }
  hit.at = on_lean && s == on_lean->s_m ? on_lean->at
           : s == found                 ? foot.at
                                        : road.axis().At(panel, s - panel.middle_s_m);
  hit.place.lane = {band.road, static_cast<std::uint32_t>(section_index),
                    hit.span.lane == nullptr ? 0 : hit.span.lane->id};
  hit.place.s_m = s;
  hit.place.t_m = t;
  hit.claim.drivable = hit.span.lane != nullptr && IsDrivable(hit.span.lane->type);
  hit.claim.from_centre_m = hit.span.lane == nullptr ? 0.0 : std::fabs(t - hit.span.centre_t_m());
  hit.place.distance_m = hit.outside_m;
  return hit;
}

SurfaceSample Network::SurfaceAt(const Hit& hit) const {
  const Road& road = spec_.roads[hit.place.lane.road];
  return road.Surface(hit.at, hit.place.s_m, hit.place.t_m, Section(hit.place.lane), hit.span);
}

void Network::SetHeight(std::optional<double> z_m, Hit& hit) const {
  const Road& road = spec_.roads[hit.place.lane.road];
  if (!hit.has_height)
    hit.place.z_m = road.flat() ? road.spec().elevation.Value(hit.place.s_m) : SurfaceAt(hit).p_W.z();
  if (!z_m) return;
  const double above = std::max(0.0, std::fabs(*z_m - hit.place.z_m) - kLevel_m);
  if (above > 0.0) hit.place.distance_m = std::sqrt(hit.outside_m * hit.outside_m + above * above);
}

// Of the places on a road at all, the best on the level that is meant.
std::optional<Place> Network::Choose(std::vector<Hit>& hits, bool known_height) const {
  if (hits.empty()) return std::nullopt;
  double top = hits[0].place.z_m;
  for (const Hit& hit : hits) top = std::max(top, hit.place.z_m);
  const Hit* best = nullptr;
  for (const Hit& hit : hits) {
    if (!known_height && hit.place.z_m < top - kLevel_m) continue;
    if (best == nullptr || hit.claim.Before(best->claim)) best = &hit;
  }
  return best->place;
}

std::optional<Place> Network::Locate(double x_m, double y_m, std::optional<double> z_m, Hint* hint) const {
  if (!OnEarth(x_m) || !OnEarth(y_m) || (z_m && !OnEarth(*z_m))) return std::nullopt;
  const Eigen::Vector2d p(x_m, y_m);
  thread_local std::vector<Hit> hits;
  hits.clear();
  thread_local std::vector<std::uint32_t> near;
  near.clear();
  index_.Around(p, [&](std::uint32_t band) {
    records_.Fetch(band);
    near.push_back(band);
  });
  std::size_t held = 0;
  for (const std::uint32_t band : near) {
    const BandRecord& record = records_.Of(band);
    if (!record.MayHold(p)) continue;
    records_.FetchLanes(record);
    near[held++] = band;
  }
  near.resize(held);
  for (const std::uint32_t band : near) {
    Hit hit = Try(p, band);
    if (hit.outside_m > 0.0) continue;
    SetHeight(z_m, hit);
    if (hit.place.distance_m == 0.0) hits.push_back(hit);
  }
  if (const auto place = Choose(hits, z_m.has_value())) return place;

  // On no road: the nearest band, of equally near ones the first.
  double best_m = std::numeric_limits<double>::infinity();
  std::optional<Hit> best;
  const auto visit = [&](std::uint32_t band) {
    Hit hit = Try(p, band);
    SetHeight(z_m, hit);
    if (best && (hit.place.distance_m > best_m || (hit.place.distance_m == best_m && band >= best->claim.band))) return;
    best = hit;
    best_m = hit.place.distance_m;
  };
  if (hint != nullptr && hint->band < index_.bands().size()) visit(hint->band);
  index_.Nearest(p, best_m, visit);
  if (!best) return std::nullopt;
  if (hint != nullptr) hint->band = best->claim.band;
  return best->place;
}

std::optional<Place> Network::LocateSlowly(double x_m, double y_m, std::optional<double> z_m) const {
  if (!OnEarth(x_m) || !OnEarth(y_m) || (z_m && !OnEarth(*z_m))) return std::nullopt;
  std::vector<Hit> hits;
  std::optional<Hit> best;
  for (std::uint32_t band = 0; band < index_.bands().size(); ++band) {
    Hit hit = TryRoad({x_m, y_m}, band);
    SetHeight(z_m, hit);
    if (hit.place.distance_m == 0.0) hits.push_back(hit);
    if (!best || hit.place.distance_m < best->place.distance_m) best = hit;
  }
  if (const auto place = Choose(hits, z_m.has_value())) return place;
  return best ? std::optional(best->place) : std::nullopt;
}

void Network::Surfaces(double x_m, double y_m, std::vector<Surfacing>& surfaces) const {
  surfaces.clear();
  if (!OnEarth(x_m) || !OnEarth(y_m)) return;
  const Eigen::Vector2d p(x_m, y_m);
  index_.Around(p, [&](std::uint32_t band) {
    if (!records_.Of(band).MayHold(p)) return;
    const Hit hit = Try(p, band);
    if (hit.outside_m > 0.0) return;
    const SurfaceSample sample = SurfaceAt(hit);
    // Of one road on one level the better place: neighbouring panels share their ends.
    const auto same = std::find_if(surfaces.begin(), surfaces.end(), [&](const Surfacing& other) {
      return other.place.lane.road == hit.place.lane.road && std::fabs(other.place.z_m - sample.p_W.z()) < kLevel_m;
    });
    if (same != surfaces.end() && !hit.claim.Before(same->claim)) return;
    Surfacing& found = same == surfaces.end() ? surfaces.emplace_back() : *same;
    found = {hit.place, sample, hit.claim};
    found.place.z_m = sample.p_W.z();
  });
  if (surfaces.size() < 2) return;
  std::sort(surfaces.begin(), surfaces.end(), [](const Surfacing& a, const Surfacing& b) {
    return a.place.z_m > b.place.z_m || (a.place.z_m == b.place.z_m && a.claim.Before(b.claim));
  });
}

}  // namespace rodeira::network
