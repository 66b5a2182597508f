// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/right_of_way/reservation_table.hpp"

namespace rodeira::traffic {

ReservationTable::ReservationTable(std::size_t zones)
    : holders_(2 * zones), comers_(2 * zones), awaited_(2 * zones), room_for_(2 * zones) {}

void ReservationTable::Clear() {
  holders_.Clear(), comers_.Clear();
  for (const std::size_t side : urged_) awaited_[side] = 0, room_for_[side] = {};
  urged_.clear();
}

void ReservationTable::Await(std::size_t zone, std::size_t side) {
  awaited_[Side(zone, side)] = 1;
  urged_.push_back(Side(zone, side));
}

void ReservationTable::WantRoom(std::size_t zone, std::size_t side, const SpaceRequest& request) {
  SpaceRequest& wanted = room_for_[Side(zone, side)];
  if (request.waited_s > wanted.waited_s) wanted = request;
  urged_.push_back(Side(zone, side));
}

}  // namespace rodeira::traffic
