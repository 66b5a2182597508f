// Whether there is room behind conflict zones, told from how far everybody comes whatever others decide.
#include <algorithm>
#include <cmath>

#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kHardest_mps2 = 3.0;  // braking by which it is told where a vehicle could stand that may stop
constexpr double kSameLine_m = 1.2;    // lines nearer to one another than this are one
constexpr double kLoose_m = 0.5;       // more than its standing gap that a queueing car leaves

double StopsWithin(double speed_mps) { return std::max(0.0, speed_mps) * speed_mps / (2.0 * kHardest_mps2); }

}  // namespace

// As far as it sees, to the line before zones that are not its own, and behind who is ahead as far as that one comes. Who is
// told to brake, and whoever is no agent, may stop at once.
double TrafficModel::ReachOf(std::uint32_t id) const {
  const Agent& agent = agents_[id];
  const Passage& passage = passages_[id];
  if (agent.brake_mps2 > 0.0) return StopsWithin(agent.speed_mps);
  double reach = SightOf(agent);
  if (passage.any) reach = std::min(reach, passage.line_m - agent.o_m - 0.5 * traits_[id].length_m);
  const Ahead& ahead = ahead_[id];
  if (ahead.any) {
    const double its = ahead.id < 0 ? StopsWithin(ahead.speed_mps) : reaches_[static_cast<std::size_t>(ahead.id)];
    reach = std::min(reach, ahead.gap_m + its - traits_[id].idm.standing_gap_m - kLoose_m);
  }
  return std::max(0.0, reach);
}

// From the first of each column back. In a ring of followers the one that closes it counts as standing.
void TrafficModel::FindReaches() {
  std::vector<bool> told(agents_.size(), false);
  std::vector<std::uint32_t> column;
  std::fill(reaches_.begin(), reaches_.end(), 0.0);
  for (std::uint32_t start = 0; start < agents_.size(); ++start) {
    column.clear();
    for (std::int64_t at = start; at >= 0 && !told[static_cast<std::size_t>(at)]; ) {
      const auto id = static_cast<std::uint32_t>(at);
      told[id] = true;
      if (!agents_[id].on_road) break;
      column.push_back(id);
      at = ahead_[id].any ? ahead_[id].id : -1;
    }
    for (auto id = column.rbegin(); id != column.rend(); ++id) reaches_[*id] = ReachOf(*id);
  }
}

// Whether it can stand behind the zones once who is ahead has come as far as he surely does. Who waits before it on the same
// way makes it no head.
void TrafficModel::FindRoom(std::uint32_t id) {
  Passage& passage = passages_[id];
  passage.head = passage.able = true;
  const Ahead& ahead = ahead_[id];
  if (!ahead.any) return;
  const double rear = agents_[id].o_m + 0.5 * traits_[id].length_m + ahead.gap_m;
  const double reach = ahead.id < 0 ? StopsWithin(ahead.speed_mps) : reaches_[static_cast<std::size_t>(ahead.id)];
  passage.able = rear + reach >= passage.end_m + traits_[id].length_m + settings_.idm.standing_gap_m + kLoose_m;
  if (!passage.able) passage.waits_for = ahead.id;
  if (ahead.id < 0 || rear >= passage.end_m) return;
  const auto next = static_cast<std::uint32_t>(ahead.id);
  const double its_line = rear + 0.5 * traits_[next].length_m + passages_[next].line_m - agents_[next].o_m;
  if (passages_[next].any && its_line < passage.line_m + kSameLine_m) passage.head = false;
}

}  // namespace rodeira::traffic
