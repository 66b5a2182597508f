// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/network/long_enough.hpp"

#include <algorithm>

namespace rodeira::traffic {
namespace {

constexpr int kMaxLinks = 8;  // followed

bool Leads(const lanes::Graph& graph, std::uint32_t track, double length_m, int links) {
  const double left = length_m - graph[track].length_m();
  if (left <= 0.0) return true;
  return links < kMaxLinks &&
         std::any_of(graph[track].next.begin(), graph[track].next.end(),
                     [&](const lanes::Link& on) { return Leads(graph, on.to, left + on.from_d_m, links + 1); });
}

}  // namespace

bool IsLongEnough(const lanes::Graph& graph, std::uint32_t track, double length_m) {
  return Leads(graph, track, length_m, 0);
}

}  // namespace rodeira::traffic
