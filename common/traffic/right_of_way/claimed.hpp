// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/traffic/right_of_way/passage.hpp"
#include "common/traffic/right_of_way/reservation_table.hpp"

namespace rodeira::traffic {

// Conflict zones and vehicles in a step. Nothing here is saved.
struct Claimed {
  Claimed(std::size_t vehicles, std::size_t zones);
  void Forget();  // what is remembered of steps before

  // By vehicle.
  std::vector<ConflictPassage> passages;
  std::vector<std::array<PlannedAt, 2>> known;  // at the beginning and the end of its passage; the map alone says it
  std::vector<double> reaches;  // how far its front comes whatever others decide; below 0: not computed yet
  std::vector<double> leaves;   // acceleration that vehicles which hold its zones before it leave it
  // Of zones.
  ReservationTable book;
  std::vector<std::uint8_t> is_asked;      // by 2 zone + side: a vehicle asks what comes there
  std::vector<std::uint32_t> asked_sides;  // sides of which one does
  // Numbers of vehicles, ascending but for `order`.
  std::vector<std::uint32_t> coming;   // with zones before them
  std::vector<std::uint32_t> heads;    // that must know now, while no vehicle before them at their line must
  std::vector<std::uint32_t> held_up;  // that hold zones and stand
  std::vector<std::uint32_t> order;    // that may ask for a reservation, in the order of their priority
};

}  // namespace rodeira::traffic
