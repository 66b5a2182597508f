// What a scenario tells agents to do.
#include <cmath>

#include "common/base/assert.hpp"
#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {

void TrafficModel::Brake(std::uint32_t id, double deceleration_mps2) {
  RODEIRA_ASSERT(id < agents_.size() && deceleration_mps2 > 0.0);
  agents_[id].brake_mps2 = deceleration_mps2;
}

void TrafficModel::CapSpeed(std::uint32_t id, double speed_mps) {
  RODEIRA_ASSERT(id < agents_.size() && speed_mps > 0.0);
  agents_[id].cap_mps = speed_mps;
}

void TrafficModel::Release(std::uint32_t id) {
  RODEIRA_ASSERT(id < agents_.size());
  agents_[id].brake_mps2 = 0.0;
  agents_[id].cap_mps = kNoCap_mps;
}

std::optional<std::uint32_t> TrafficModel::AheadOf(const driver::Footprint& other) const {
  std::optional<std::uint32_t> nearest;
  double gap_m = settings_.sight_m;
  for (const Lane& lane : lanes_) {
    const auto place = lane.path.Locate(other.x_m, other.y_m);
    if (!place || std::fabs(place->offset_m) > 0.5 * lane.path.lane().width_m) continue;
    if (std::cos(other.heading_rad - lane.path.At(place->d_m).heading_rad) <= 0.0) continue;  // faces the other way
    for (const std::uint32_t id : lane.order) {
      const double gap = agents_[id].d_m - place->d_m;
      if (id == other.id || gap <= 0.0 || gap > gap_m) continue;
      gap_m = gap;
      nearest = id;
    }
  }
  return nearest;
}

}  // namespace rodeira::traffic
