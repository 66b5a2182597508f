#include "common/traffic/zone_book.hpp"

#include <algorithm>

namespace rodeira::traffic {

ZoneBook::ZoneBook(std::size_t zones) : holders_(2 * zones), comers_(2 * zones), awaited_(2 * zones), room_for_s_(2 * zones) {}

void ZoneBook::Clear() {
  holders_.Clear(), comers_.Clear();
  for (const std::size_t side : urged_) awaited_[side] = 0, room_for_s_[side] = 0.0;
  urged_.clear();
}

void ZoneBook::Await(std::size_t zone, std::size_t side) {
  awaited_[Side(zone, side)] = 1;
  urged_.push_back(Side(zone, side));
}

void ZoneBook::WantRoom(std::size_t zone, std::size_t side, double waited_s) {
  double& wanted = room_for_s_[Side(zone, side)];
  wanted = std::max(wanted, waited_s);
  urged_.push_back(Side(zone, side));
}

}  // namespace rodeira::traffic
