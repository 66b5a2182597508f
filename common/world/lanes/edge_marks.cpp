// SPDX-License-Identifier: Apache-2.0
#include "common/world/lanes/edge_marks.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "common/world/network/marking.hpp"

namespace rodeira::lanes {
namespace {

using network::LaneKey;
using network::Marking;

constexpr double kEvery_m = 2.0;
constexpr double kAtEdge_m = 0.6;  // lines so near to an edge are the edge's

// The lane with the outer edge on which two neighbours meet: the inner one of two on one side, else the centre.
int EdgeLane(int a, int b) {
  if ((a > 0) != (b > 0)) return 0;
  return std::abs(a) < std::abs(b) ? a : b;
}

// What OpenDRIVE's laneChange says of crossing from lane `from` to lane `to` (ids grow to the left); nothing where it
// is silent
// ("both" is what a file without it says, too).
std::optional<bool> Said(const network::Road& road, const network::LaneSection& section, int edge, int from, int to,
                         double s_m) {
  const network::Lane* lane = section.Find(edge);
  const network::RoadMark* mark = lane == nullptr ? nullptr : road.MarkAt(*lane, s_m);
  if (mark == nullptr || mark->lane_change.empty()) return std::nullopt;
  if (mark->lane_change == "none") return false;
  if (mark->lane_change == "increase") return to > from;
  if (mark->lane_change == "decrease") return to < from;
  return std::nullopt;
}

// Whether the line nearest to the lane's own side is not continuous; nothing where there is none.
std::optional<bool> Painted(const network::Road& road, const std::vector<Marking>& markings, double s_m,
                            double edge_t_m, double own_t_m) {
  const Marking* nearest = nullptr;
  double nearest_m = 0.0;
  for (const Marking& marking : markings) {
    if (s_m < marking.from_s_m || s_m > marking.to_s_m) continue;
    const double t = network::MarkingAt(road, marking, s_m).value;
    if (std::fabs(t - edge_t_m) > kAtEdge_m) continue;
    if (nearest == nullptr || std::fabs(t - own_t_m) < nearest_m)
      nearest = &marking, nearest_m = std::fabs(t - own_t_m);
  }
  return nearest == nullptr ? std::nullopt : std::optional(nearest->gap_m > 0.0);
}

// Roads' lines, made when they are asked for.
class Lines {
 public:
  explicit Lines(const network::Network& network) : network_(network) {}
  const std::vector<Marking>& Of(std::uint32_t road) {
    const auto [of, made] = markings_.try_emplace(road);
    if (made) of->second = network::MarkingsOf(network_.roads()[road]);
    return of->second;
  }

 private:
  const network::Network& network_;
  std::map<std::uint32_t, std::vector<Marking>> markings_;
};

// The lines at one side of a lane, on its own road.
std::optional<bool> PaintedAt(const network::Network& network, Lines& lines, const LaneKey& key, bool left_along_s,
                              double s_m) {
  const auto span = network.Span(key, s_m);
  if (!span) return false;
  const double edge_t_m = (key.lane < 0) == left_along_s ? span->inner_t_m : span->outer_t_m;
  return Painted(network.roads()[key.road], lines.Of(key.road), s_m, edge_t_m, span->centre_t_m());
}

}  // namespace

EdgeMarks::EdgeMarks(const Graph& graph) : open_(graph.tracks().size()) {
  const network::Network& network = graph.network();
  Lines lines(network);
  for (std::uint32_t i = 0; i < graph.tracks().size(); ++i) {
    const Track& track = graph[i];
    if (track.junction >= 0) continue;
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const bool left = (side == Side::kLeft) == track.along;  // as seen along s
      auto& open = open_[i][static_cast<std::size_t>(side)];
      const auto count = static_cast<std::size_t>(std::ceil(track.length_m() / kEvery_m)) + 1;
      const auto beside = left ? network.Left(track.lane) : network.Right(track.lane);
      const auto sharing = left ? network.SharingLeft(track.lane) : network.SharingRight(track.lane);
      if (beside ? !graph.Find(*beside) : !sharing || !graph.Find(sharing->lane)) continue;
      const network::Road& road = network.roads()[track.lane.road];
      const network::LaneSection& section = network.Section(track.lane);
      for (std::size_t k = 0; k < count; ++k) {
        const double d = static_cast<double>(k) * kEvery_m, s = track.curve.StationAt(d);
        if (!beside) {
          const std::uint32_t other = *graph.Find(sharing->lane);
          const auto own = PaintedAt(network, lines, track.lane, left, s);
          open.push_back(own ? *own
                             : PaintedAt(network, lines, sharing->lane, left != sharing->same_way,
                                         graph[other].curve.StationAt(graph.Across(i, d, other)))
                                   .value_or(true));
          continue;
        }
        const auto own = network.Span(track.lane, s), other = network.Span(*beside, s);
        if (!own || !other) {
          open.push_back(false);
          continue;
        }
        const int edge = EdgeLane(track.lane.lane, beside->lane);
        const double edge_t = edge == track.lane.lane ? own->outer_t_m
                              : edge == beside->lane  ? other->outer_t_m
                                                      : own->inner_t_m;
        const auto said = Said(road, section, edge, track.lane.lane, beside->lane, s);
        open.push_back(said ? *said
                            : Painted(road, lines.Of(track.lane.road), s, edge_t, own->centre_t_m()).value_or(true));
      }
    }
  }
}

bool EdgeMarks::MayCross(std::uint32_t track, Side side, double from_d_m, double to_d_m) const {
  const auto& open = open_[track][static_cast<std::size_t>(side)];
  if (open.empty()) return false;
  const auto at = [&](double d_m) {
    return std::min(open.size() - 1, static_cast<std::size_t>(std::max(0.0, d_m) / kEvery_m));
  };
  for (std::size_t k = at(from_d_m); k <= std::min(open.size() - 1, at(to_d_m) + 1); ++k) {
    if (!open[k]) return false;
  }
  return true;
}

}  // namespace rodeira::lanes
