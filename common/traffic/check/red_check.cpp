// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/check/red_check.hpp"

#include "common/world/lanes/lights.hpp"

namespace rodeira::traffic {

RedCheck::RedCheck(const lanes::Graph& graph, std::size_t vehicles) : seen_(vehicles) {
  for (std::uint32_t track = 0; track < graph.tracks().size(); ++track) {
    first_.push_back(static_cast<std::uint32_t>(lines_.size()));
    for (const lanes::LightPlace& light : lanes::LightsOf(graph, track))
      lines_.push_back({light.d_m, light.controller});
  }
  first_.push_back(static_cast<std::uint32_t>(lines_.size()));
}

void RedCheck::Begin(std::span<const network::LightColour> colours) {
  stopped_.swap(stops_);
  stops_.assign(colours.size(), 0);
  for (std::size_t i = 0; i < colours.size(); ++i)
    stops_[i] = colours[i] == network::LightColour::kRed || colours[i] == network::LightColour::kRedAmber ? 1 : 0;
  if (stopped_.size() != stops_.size()) stopped_ = stops_;
}

bool RedCheck::Passes(std::uint32_t id, std::uint32_t trip, const Path& path, double front_m) {
  Seen& seen = seen_[id];
  const bool goes_on = seen.trip == static_cast<std::int64_t>(trip);
  const double before_m = seen.front_m;
  seen = {front_m, static_cast<std::int64_t>(trip)};
  if (!goes_on) return false;
  double end_m = 1e18;  // of the piece
  for (std::size_t i = path.size(); i-- > 0 && end_m > before_m; end_m = path[i].begin_m) {
    const Piece& piece = path[i];
    for (std::uint32_t k = first_[piece.track]; k < first_[piece.track + 1]; ++k) {
      const double at = piece.zero_m + lines_[k].d_m;
      if (at <= before_m || at > front_m || at < piece.begin_m || at >= end_m) continue;
      if (stops_[lines_[k].controller] != 0 && stopped_[lines_[k].controller] != 0) return true;
    }
  }
  return false;
}

}  // namespace rodeira::traffic
