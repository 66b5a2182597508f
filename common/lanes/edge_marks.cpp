#include "common/lanes/edge_marks.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "common/network/marking.hpp"

namespace rodeira::lanes {
namespace {

using network::LaneKey;
using network::Marking;

constexpr double kEvery_m = 2.0;
constexpr double kAtEdge_m = 0.6;  // lines so near to an edge are the edge's

// The lane on whose outer edge two neighbours meet: the inner one of two on one side, else the centre.
int EdgeLane(int a, int b) {
  if ((a > 0) != (b > 0)) return 0;
  return std::abs(a) < std::abs(b) ? a : b;
}

// What OpenDRIVE's laneChange says of crossing from lane `from` to lane `to` (ids grow to the left); nothing where it is silent
// ("both" is what a file without it says, too).
std::optional<bool> Said(const network::Road& road, const network::LaneSection& section, int edge, int from, int to, double s_m) {
  const network::Lane* lane = section.Find(edge);
  const network::RoadMark* mark = lane == nullptr ? nullptr : road.MarkAt(*lane, s_m);
  if (mark == nullptr || mark->lane_change.empty()) return std::nullopt;
  if (mark->lane_change == "none") return false;
  if (mark->lane_change == "increase") return to > from;
  if (mark->lane_change == "decrease") return to < from;
  return std::nullopt;
}

// Whether the line nearest to the lane's own side is none, or is not continuous.
bool Painted(const network::Road& road, const std::vector<Marking>& markings, double s_m, double edge_t_m, double own_t_m) {
  const Marking* nearest = nullptr;
  double nearest_m = 0.0;
  for (const Marking& marking : markings) {
    if (s_m < marking.from_s_m || s_m > marking.to_s_m) continue;
    const double t = network::MarkingAt(road, marking, s_m).value;
    if (std::fabs(t - edge_t_m) > kAtEdge_m) continue;
    if (nearest == nullptr || std::fabs(t - own_t_m) < nearest_m) nearest = &marking, nearest_m = std::fabs(t - own_t_m);
  }
  return nearest == nullptr || nearest->gap_m > 0.0;
}

}  // namespace

EdgeMarks::EdgeMarks(const Graph& graph) : open_(graph.tracks().size()) {
  const network::Network& network = graph.network();
  std::map<std::uint32_t, std::vector<Marking>> markings;  // by road
  for (std::uint32_t i = 0; i < graph.tracks().size(); ++i) {
    const Track& track = graph[i];
    if (track.junction >= 0) continue;
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const auto beside = (side == Side::kLeft) == track.along ? network.Left(track.lane) : network.Right(track.lane);
      if (!beside || !graph.Find(*beside)) continue;
      const network::Road& road = network.roads()[track.lane.road];
      const network::LaneSection& section = network.Section(track.lane);
      const auto [of, made] = markings.try_emplace(track.lane.road);
      if (made) of->second = network::MarkingsOf(road);
      const int edge = EdgeLane(track.lane.lane, beside->lane);
      auto& open = open_[i][static_cast<std::size_t>(side)];
      const auto count = static_cast<std::size_t>(std::ceil(track.length_m() / kEvery_m)) + 1;
      for (std::size_t k = 0; k < count; ++k) {
        const double s = track.curve.StationAt(static_cast<double>(k) * kEvery_m);
        const auto own = network.Span(track.lane, s), other = network.Span(*beside, s);
        if (!own || !other) {
          open.push_back(false);
          continue;
        }
        const double edge_t = edge == track.lane.lane ? own->outer_t_m : edge == beside->lane ? other->outer_t_m : own->inner_t_m;
        const auto said = Said(road, section, edge, track.lane.lane, beside->lane, s);
        open.push_back(said ? *said : Painted(road, of->second, s, edge_t, own->centre_t_m()));
      }
    }
  }
}

bool EdgeMarks::MayCross(std::uint32_t track, Side side, double from_d_m, double to_d_m) const {
  const auto& open = open_[track][static_cast<std::size_t>(side)];
  if (open.empty()) return false;
  const auto at = [&](double d_m) { return std::min(open.size() - 1, static_cast<std::size_t>(std::max(0.0, d_m) / kEvery_m)); };
  for (std::size_t k = at(from_d_m); k <= std::min(open.size() - 1, at(to_d_m) + 1); ++k) {
    if (!open[k]) return false;
  }
  return true;
}

}  // namespace rodeira::lanes
