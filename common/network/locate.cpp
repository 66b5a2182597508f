// Where a point lies in the network.
#include <algorithm>
#include <cmath>

#include "common/network/network.hpp"

namespace rodeira::network {
namespace {

bool OnEarth(double coordinate_m) { return std::fabs(coordinate_m) < Network::kFarthest_m; }  // false for NaN

}  // namespace

// A point seen from one band: its place, and what decides between places.
struct Network::Hit {
  Place place;
  std::uint32_t band = 0;
  bool past_end = false;     // in a gap that is closed
  bool drivable = false;
  double from_centre_m = 0.0;
  double outside_m = 0.0;    // across, without the height

  // The better of two on the road, on one level.
  bool Before(const Hit& other) const {
    if (past_end != other.past_end) return other.past_end;
    if (drivable != other.drivable) return drivable;
    if (from_centre_m != other.from_centre_m) return from_centre_m < other.from_centre_m;
    return band < other.band;
  }
};

Network::Hit Network::Try(const Eigen::Vector2d& p_W, std::optional<double> z_m, std::uint32_t band_index) const {
  const Band& band = index_.bands()[band_index];
  const Road& road = spec_.roads[band.road];
  const geometry::AxisPanel& panel = road.axis().panels()[band.panel];
  const geometry::AxisFoot foot = road.axis().Foot(panel, p_W);
  Hit hit;
  hit.band = band_index;
  const double low = std::max(panel.begin_s_m(), 0.0), high = std::min(panel.end_s_m(), road.length_m());
  double s = std::clamp(panel.middle_s_m + foot.u_m, low, high), t = foot.t_m;
  double beyond = std::fabs(foot.beyond_m) + std::fabs(panel.middle_s_m + foot.u_m - s);
  if (road.rolled()) beyond = road.Settle(p_W, low, high, s, t);
  const std::size_t section_index = road.SectionIndex(s);
  const LaneSection& section = road.spec().sections[section_index];
  const LaneSpan span = section.At(t, road.CentreAt(s), s, hit.outside_m);
  hit.past_end = beyond > 0.0;
  if (road.rolled() && hit.outside_m > 0.0) {  // t runs along a slope there: what counts is seen from above
    const double edge = t + (t > road.CentreAt(s).value ? -hit.outside_m : hit.outside_m);
    hit.outside_m = road.DistanceToEdge(p_W, low, high, edge, s);
  } else if (beyond > (s <= low ? band.closed_before_m : band.closed_behind_m)) {
    hit.outside_m = std::sqrt(hit.outside_m * hit.outside_m + beyond * beyond);
  }
  hit.place.lane = {band.road, static_cast<std::uint32_t>(section_index), span.lane == nullptr ? 0 : span.lane->id};
  hit.place.s_m = s;
  hit.place.t_m = t;
  hit.drivable = span.lane != nullptr && IsDrivable(span.lane->type);
  hit.from_centre_m = span.lane == nullptr ? 0.0 : std::fabs(t - span.centre_t_m());
  hit.place.distance_m = hit.outside_m;
  hit.place.z_m = road.Height(s, t, section, span);
  if (z_m) {
    const double above = std::max(0.0, std::fabs(*z_m - hit.place.z_m) - kLevel_m);
    if (above > 0.0) hit.place.distance_m = std::sqrt(hit.outside_m * hit.outside_m + above * above);
  }
  return hit;
}

// Of the places on a road at all, the best on the level that is meant.
std::optional<Place> Network::Choose(std::vector<Hit>& hits, bool known_height) const {
  if (hits.empty()) return std::nullopt;
  double top = hits[0].place.z_m;
  for (const Hit& hit : hits) top = std::max(top, hit.place.z_m);
  const Hit* best = nullptr;
  for (const Hit& hit : hits) {
    if (!known_height && hit.place.z_m < top - kLevel_m) continue;
    if (best == nullptr || hit.Before(*best)) best = &hit;
  }
  return best->place;
}

std::optional<Place> Network::Locate(double x_m, double y_m, std::optional<double> z_m, Hint* hint) const {
  if (!OnEarth(x_m) || !OnEarth(y_m) || (z_m && !OnEarth(*z_m))) return std::nullopt;
  const Eigen::Vector2d p(x_m, y_m);
  thread_local std::vector<Hit> hits;
  hits.clear();
  for (const std::uint32_t band : index_.Around(p)) {
    if (index_.bands()[band].Distance(p) > 0.0) continue;
    const Hit hit = Try(p, z_m, band);
    if (hit.place.distance_m == 0.0) hits.push_back(hit);
  }
  if (const auto place = Choose(hits, z_m.has_value())) return place;

  // On no road: the nearest band, of equally near ones the first.
  double best_m = std::numeric_limits<double>::infinity();
  std::optional<Hit> best;
  const auto visit = [&](std::uint32_t band) {
    const Hit hit = Try(p, z_m, band);
    if (best && (hit.place.distance_m > best_m || (hit.place.distance_m == best_m && band >= best->band))) return;
    best = hit;
    best_m = hit.place.distance_m;
  };
  if (hint != nullptr && hint->band < index_.bands().size()) visit(hint->band);
  index_.Nearest(p, best_m, visit);
  if (!best) return std::nullopt;
  if (hint != nullptr) hint->band = best->band;
  return best->place;
}

std::optional<Place> Network::LocateSlowly(double x_m, double y_m, std::optional<double> z_m) const {
  if (!OnEarth(x_m) || !OnEarth(y_m) || (z_m && !OnEarth(*z_m))) return std::nullopt;
  std::vector<Hit> hits;
  std::optional<Hit> best;
  for (std::uint32_t band = 0; band < index_.bands().size(); ++band) {
    const Hit hit = Try({x_m, y_m}, z_m, band);
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
  thread_local std::vector<Hit> hits;
  hits.clear();
  for (const std::uint32_t band : index_.Around(p)) {
    if (index_.bands()[band].Distance(p) > 0.0) continue;
    const Hit hit = Try(p, std::nullopt, band);
    if (hit.outside_m > 0.0) continue;
    // Of one road on one level the better place: neighbouring panels share their ends.
    const auto same = std::find_if(hits.begin(), hits.end(), [&](const Hit& other) {
      return other.place.lane.road == hit.place.lane.road && std::fabs(other.place.z_m - hit.place.z_m) < kLevel_m;
    });
    if (same == hits.end()) hits.push_back(hit);
    else if (hit.Before(*same)) *same = hit;
  }
  std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) {
    return a.place.z_m > b.place.z_m || (a.place.z_m == b.place.z_m && a.Before(b));
  });
  for (const Hit& hit : hits) {
    const Road& road = spec_.roads[hit.place.lane.road];
    surfaces.push_back({hit.place, road.Surface(hit.place.s_m, hit.place.t_m)});
  }
}

}  // namespace rodeira::network
