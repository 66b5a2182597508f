// SPDX-License-Identifier: Apache-2.0
#include "common/world/design/marking_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/geometry/angle.hpp"
#include "common/world/design/section_reader.hpp"
#include "common/world/design/station.hpp"
#include "common/world/design/tables.hpp"

namespace rodeira::design {
namespace {

using config::DeclaredList;
using config::DeclaredMap;
using config::List;

// Vienna Convention, annex 2: stripes of a crossing 0.4 to 0.6 m wide with gaps of one to two of them; a stop line of
// 0.2 to 0.6 m.
constexpr double kStripe_m = 0.5, kStripeGap_m = 0.5;
constexpr double kBesideStopLine_m = 0.1;  // what stays free at each edge of the lane
constexpr double kNarrowest_m = 0.3;

struct Edges {
  double right_m = 0.0, left_m = 0.0;
  double width_m() const { return left_m - right_m; }
};

Edges LaneEdges(const network::RoadSpec& spec, const network::Lane& lane, double s_m) {
  const double inner = EdgeOf(spec, lane.id > 0 ? lane.id - 1 : lane.id + 1).Value(s_m),
               outer = EdgeOf(spec, lane.id).Value(s_m);
  return {std::min(inner, outer), std::max(inner, outer)};
}

// Required of an arrow, optional of the others; the reading of both is the same where it is there.
int LaneId(const DeclaredMap& item) { return static_cast<int>(item.MapWith("lane").Integer("lane", -30, 30)); }

// The lanes that are driven on, from the left, or the one that 'lane' says.
std::vector<const network::Lane*> MarkedLanes(const DeclaredMap& item, const network::RoadSpec& spec) {
  const network::LaneSection& section = spec.sections[0];
  if (item.map().Has("lane")) {
    const int id = LaneId(item);
    const network::Lane* lane = id == 0 ? nullptr : section.Find(id);
    if (lane == nullptr) item.map().Problem("lane", "world.unknown_lane", fmt::format("the road has no lane {}", id));
    return lane == nullptr ? std::vector<const network::Lane*>() : std::vector{lane};
  }
  std::vector<const network::Lane*> lanes;
  for (const auto* side : {&section.left, &section.right}) {
    for (const network::Lane& lane : *side) {
      if (network::IsDrivable(lane.type)) lanes.push_back(&lane);
    }
  }
  return lanes;
}

void Paint(double s_m, double length_m, double road_m, const Edges& edges, network::RoadSpec& spec) {
  const double from = std::max(0.0, s_m - 0.5 * length_m), to = std::min(road_m, s_m + 0.5 * length_m);
  if (from < to)
    spec.lines.push_back(
        {from, to, Constant(0.5 * (edges.right_m + edges.left_m)), edges.width_m(), 0.0, 0.0, "white"});
}

// Stripes along the road, spread evenly about the middle of all that is driven on; and an object that names the place,
// that the paint belongs to.
void ReadCrossing(const DeclaredMap& item, double s_m, double road_m, network::RoadSpec& spec) {
  const double length = item.Number("length_m");
  Edges all{1e9, -1e9};
  for (const network::Lane* lane : MarkedLanes(item, spec)) {
    const Edges edges = LaneEdges(spec, *lane, s_m);
    all = {std::min(all.right_m, edges.right_m), std::max(all.left_m, edges.left_m)};
  }
  if (!(all.width_m() >= kStripe_m)) return;
  const double period = kStripe_m + kStripeGap_m, count = std::floor((all.width_m() + kStripeGap_m) / period + 1e-9);
  const double first = 0.5 * (all.right_m + all.left_m) - 0.5 * (count * period - kStripeGap_m);
  for (double i = 0.0; i < count; i += 1.0)
    Paint(s_m, length, road_m, {first + i * period, first + i * period + kStripe_m}, spec);
  network::Object object;
  object.id = fmt::format("{}-object{}", spec.id, spec.objects.size());
  object.type = "crosswalk";
  object.subtype = "virtual";
  object.name = "crossing";
  object.orientation = "none";
  object.s_m = s_m, object.t_m = 0.5 * (all.right_m + all.left_m);
  object.length_m = length, object.width_m = all.width_m();
  spec.objects.push_back(std::move(object));
}

// Before the traffic that comes along, or against, where no lane is said.
void ReadStopLine(const DeclaredMap& item, double s_m, double road_m, network::RoadSpec& spec) {
  const double thickness = item.Number("length_m");
  const int direction = item.Word("for") == "along" ? 1 : -1;
  const bool of_lane = item.map().Has("lane");
  if (item.map().Has("for") && of_lane)
    item.map().Problem("for", "config.conflicting_keys", "a stop line has either 'lane' or 'for'");
  for (const network::Lane* lane : MarkedLanes(item, spec)) {
    if (!of_lane && lane->direction == -direction) continue;
    Edges edges = LaneEdges(spec, *lane, s_m);
    edges.right_m += kBesideStopLine_m, edges.left_m -= kBesideStopLine_m;
    if (edges.width_m() > kNarrowest_m) Paint(s_m, thickness, road_m, edges, spec);
  }
}

// In the lane's middle, for its traffic.
void ReadArrow(const DeclaredMap& item, double s_m, network::RoadSpec& spec) {
  (void)LaneId(item);
  std::string ways;
  const DeclaredList declared = item.Items("ways");
  const List& said = declared.list();
  for (const auto& [word, part] :
       {std::pair("straight", "Straight"), std::pair("left", "Left"), std::pair("right", "Right")}) {
    for (std::size_t i = 0; i < said.size(); ++i) {
      if (said.Text(i) == word && ways.find(part) == std::string::npos) ways += part;
    }
  }
  for (std::size_t i = 0; i < said.size(); ++i) {
    const std::string word = said.Text(i);
    if (word != "straight" && word != "left" && word != "right")
      said.Problem(i, "config.unknown_name",
                   fmt::format("'{}' is no way that an arrow points; left, straight or right was expected", word));
  }
  if (item.map().Has("ways") && said.size() == 0)
    item.map().Problem("ways", "config.too_few", "'ways' is empty; left, straight or right was expected");
  const double length = item.Number("length_m");
  if (!item.map().Has("lane")) return;
  for (const network::Lane* lane : MarkedLanes(item, spec)) {
    const Edges edges = LaneEdges(spec, *lane, s_m);
    network::Object object;
    object.id = fmt::format("{}-object{}", spec.id, spec.objects.size());
    object.type = "roadMark";
    object.subtype = object.name = "arrow" + ways;
    object.s_m = s_m;
    object.t_m = 0.5 * (edges.right_m + edges.left_m);
    object.length_m = length;
    object.hdg_rad = lane->direction < 0 ? geometry::kPi : 0.0;
    object.orientation = "none";
    spec.objects.push_back(std::move(object));
  }
}

}  // namespace

void ReadMarkings(const DeclaredMap& road, double length_m, network::RoadSpec& spec) {
  const DeclaredList list = road.Items("markings");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const DeclaredMap marking = list.At(i);
    const std::string type = marking.Word("type");
    const DeclaredMap item = marking.OfKind(type);
    const double s = Station(item, "s_m", length_m);
    if (type == "crossing")
      ReadCrossing(item, s, length_m, spec);
    else if (type == "stop_line")
      ReadStopLine(item, s, length_m, spec);
    else if (type == "arrow")
      ReadArrow(item, s, spec);
  }
}

}  // namespace rodeira::design
