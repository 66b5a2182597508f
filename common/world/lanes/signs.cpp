// SPDX-License-Identifier: Apache-2.0
#include "common/world/lanes/signs.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "common/world/lanes/approach.hpp"
#include "common/world/network/sign_kinds.hpp"

namespace rodeira::lanes {
namespace {

std::optional<Sign> SignOf(const network::Signal& signal) {
  const std::string_view type = signal.type;
  if (type == "206") return Sign::kStop;
  if (type == "205") return Sign::kGiveWay;
  if (type == "301" || type == "306") return Sign::kPriority;
  if (type == "307") return Sign::kNone;
  // Signs of other countries' numbers say what they mean.
  const std::string_view priority = signal.priority;
  if (priority == "stop" || priority == "4way") return Sign::kStop;
  if (priority == "yield") return Sign::kGiveWay;
  if (priority == "priorityRoad") return Sign::kPriority;
  if (priority == "priorityRoadEnd") return Sign::kNone;
  const auto kind = network::SignKindOf(signal);
  if (kind == "stop") return Sign::kStop;
  if (kind == "give_way") return Sign::kGiveWay;
  return std::nullopt;
}

}  // namespace

std::vector<SignPlace> SignsOf(const Graph& graph, std::uint32_t track) {
  const Track& t = graph[track];
  const network::RoadSpec& road = graph.network().roads()[t.lane.road].spec();
  const auto& nodes = t.curve.nodes();
  const double low = std::min(nodes.front().s_m, nodes.back().s_m),
               high = std::max(nodes.front().s_m, nodes.back().s_m);
  std::vector<SignPlace> signs;
  for (const network::Signal& signal : road.signals) {
    const auto sign = SignOf(signal);
    if (!sign || signal.s_m < low || signal.s_m > high ||
        !HoldsFor(t.lane.lane, t.along, signal.orientation, signal.validity))
      continue;
    const double share = (signal.s_m - nodes.front().s_m) / (nodes.back().s_m - nodes.front().s_m);
    signs.push_back({share * t.length_m(), *sign});
  }
  std::stable_sort(signs.begin(), signs.end(), [](const SignPlace& a, const SignPlace& b) { return a.d_m < b.d_m; });
  return signs;
}

Sign SignFor(const Graph& graph, std::uint32_t track, double d_m) {
  double back = 0.0;
  while (true) {
    const auto signs = SignsOf(graph, track);
    for (auto sign = signs.rbegin(); sign != signs.rend(); ++sign) {
      if (sign->d_m <= d_m + kPastZoneBegin_m) return sign->sign;
    }
    back += d_m;
    if (back > kMaxUpstream_m || graph[track].before.size() != 1) return Sign::kNone;
    track = graph[track].before.front();
    d_m = graph[track].length_m();
  }
}

}  // namespace rodeira::lanes
