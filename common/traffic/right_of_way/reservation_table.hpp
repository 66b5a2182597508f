// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/traffic/state/lists.hpp"

namespace rodeira::traffic {

// A vehicle that holds a side of a zone. Ids from the number of agents on are others.
struct Reservation {
  std::uint32_t id = 0;
  bool sure = false;         // there is room for it behind its zones
  std::uint64_t number = 0;  // of its grant; 0: none
  double out_m = 0.0;        // odometer at the zone's end
};

// A vehicle that comes to a side of a zone. When, is found out where it is asked for: few are.
struct ApproachingVehicle {
  std::uint32_t id = 0;
  double in_m = 0.0, out_m = 0.0;          // odometer; of agents
  double arrives_s = 0.0, clears_s = 0.0;  // of others
};

// The vehicles that have or want each side of each conflict zone in a step. Only zones that something is said of cost
// anything.
class ReservationTable {
 public:
  explicit ReservationTable(std::size_t zones);

  void Clear();  // all, for the next step

  // The number of a side, 0 or 1, of a zone.
  static std::size_t Side(std::size_t zone, std::size_t side) { return 2 * zone + side; }
  void Hold(std::size_t zone, std::size_t side, const Reservation& holder) { holders_.Add(Side(zone, side), holder); }
  Lists<Reservation>::Range ReservationsOf(std::size_t zone, std::size_t side) const {
    return holders_.Of(Side(zone, side));
  }
  void Come(std::size_t zone, std::size_t side, const ApproachingVehicle& comer) {
    comers_.Add(Side(zone, side), comer);
  }
  // In the order in which they were told.
  Lists<ApproachingVehicle>::Range ApproachingTo(std::size_t zone, std::size_t side) const {
    return comers_.Of(Side(zone, side));
  }

  // An urgent agent waits for this side to end …
  void Await(std::size_t zone, std::size_t side);
  bool IsAwaited(std::size_t zone, std::size_t side) const {
    return !urged_.empty() && awaited_[Side(zone, side)] != 0;
  }
  // … or has waited so long for room behind the zone that this side could take; of several the longest waiting, of
  // equals the first that said so.
  struct SpaceRequest {
    double waited_s = 0.0;
    std::uint32_t id = 0;
  };
  void WantRoom(std::size_t zone, std::size_t side, const SpaceRequest& request);
  SpaceRequest RoomWanted(std::size_t zone, std::size_t side) const {
    return urged_.empty() ? SpaceRequest{} : room_for_[Side(zone, side)];
  }

 private:
  Lists<Reservation> holders_;
  Lists<ApproachingVehicle> comers_;
  std::vector<std::uint8_t> awaited_;   // by side
  std::vector<SpaceRequest> room_for_;  // by side
  std::vector<std::size_t> urged_;      // sides of which one of both says something: hardly ever any
};

}  // namespace rodeira::traffic
