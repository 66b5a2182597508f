// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "common/traffic/following/car_following.hpp"
#include "common/traffic/following/speed_limits.hpp"
#include "common/traffic/motion/full_cars.hpp"
#include "common/traffic/network/traffic_map.hpp"
#include "common/traffic/perception/sight.hpp"
#include "common/traffic/right_of_way/passage.hpp"
#include "common/traffic/right_of_way/reservation_table.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/traffic_settings.hpp"
#include "common/traffic/state/vehicle_way.hpp"

namespace rodeira::traffic {

// Vehicles that wait within their own zones for vehicles that hold them before, or follow them where ways merge.
class Merging {
 public:
  struct Reads {
    const TrafficMap& map;
    std::span<const AgentTraits> traits;
    const std::optional<FullCars>& full;
    std::span<const RouteSegments> stretches;
    std::span<const Leader> ahead;
    const ReservationTable& book;
    const SpeedLimits& limits;
    const CarFollowing& following;
  };
  struct Writes {
    std::span<Agent> agents;
    std::span<double> leaves;
  };
  Merging(const Reads& reads, const Writes& writes) : in_(reads), out_(writes) {}

  // From its front to the rear of the one that goes before it through a zone in which their ways come together, both by
  // their way to its end.
  double MergingGap(std::uint32_t id, double out_m, const Reservation& before) const;
  // Where two ways merge it may come behind the one nearer to the end of the zone, as behind a leader, if it need not
  // brake much for that.
  bool MayFollow(std::uint32_t id, const Crossing& crossing, const Reservation& holder) const;
  // What those that hold its zones before it leave it.
  void YieldInZones(std::uint32_t id);
  // The one that holds its zones before it and keeps it where it stands; of several the one that lets it drive on
  // least; below 0: none does.
  std::int64_t KeptInZonesBy(std::uint32_t id) const;
  // Those that hold its zones before it, and which: tell(holder, in_m, out_m, whether ways merge there), in its own
  // odometer.
  template <class Tell>
  void EachBefore(std::uint32_t id, const Tell& tell) const {
    const Agent& agent = out_.agents[id];
    const double front = FrontOf(out_.agents[id], in_.traits[id]);
    for (const RouteSegment& stretch : in_.stretches[id]) {
      if (agent.grants.empty() || stretch.begin_m > agent.granted_m)
        break;  // without any none goes before it by its number
      if (!stretch.crosses) continue;
      for (const lanes::ZoneSide& part : in_.map.zones.ConflictsOf(stretch.track)) {
        const double in = stretch.zero_m + part.in_m, out = stretch.zero_m + part.out_m;
        const bool merges = part.kind == lanes::ZoneKind::kMerge;
        if (in >= agent.granted_m || (merges ? out : in) < front) continue;
        const std::uint64_t number = agent.GrantOf(in).number;
        for (const Reservation& holder : in_.book.ReservationsOf(part.zone, static_cast<std::size_t>(1 - part.side))) {
          if (holder.id < out_.agents.size() && holder.id != id && holder.number < number)
            tell(holder, in, out, merges);
        }
      }
    }
  }

 private:
  template <class Tell>
  void EachLeaves(std::uint32_t id, const Tell& tell) const;

  Reads in_;
  Writes out_;
};

}  // namespace rodeira::traffic
