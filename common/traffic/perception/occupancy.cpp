// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/perception/occupancy.hpp"

#include <algorithm>

namespace rodeira::traffic {
namespace {

bool ComesFirst(const Occupant& a, const Occupant& b) {
  return a.middle_m() != b.middle_m() ? a.middle_m() < b.middle_m() : a.id < b.id;
}

}  // namespace

void Occupancy::Clear() {
  for (const std::uint32_t track : taken_) places_[track].count = 0;
  taken_.clear(), added_.clear(), all_.clear();
}

// Counted, and then put into their tracks' parts.
void Occupancy::Sort() {
  for (const auto& [track, occupant] : added_) {
    if (places_[track].count++ == 0) taken_.push_back(track);
  }
  std::uint32_t begin = 0;
  for (const std::uint32_t track : taken_) {
    places_[track].begin = begin;
    begin += std::exchange(places_[track].count, 0);
  }
  all_.resize(added_.size());
  for (const auto& [track, occupant] : added_) {
    Place& place = places_[track];
    all_[place.begin + place.count++] = occupant;
  }
  for (const std::uint32_t track : taken_) {
    const auto first = all_.begin() + places_[track].begin;
    if (places_[track].count > 1) std::sort(first, first + places_[track].count, ComesFirst);
  }
}

// The track's part moves to the end: few come in the middle of a step.
void Occupancy::Insert(std::uint32_t track, const Occupant& occupant) {
  Place& place = places_[track];
  if (place.count == 0) taken_.push_back(track);
  const auto begin = static_cast<std::uint32_t>(all_.size());
  for (std::uint32_t i = 0; i < place.count; ++i) all_.push_back(Occupant(all_[place.begin + i]));
  place.begin = begin;
  ++place.count;
  all_.insert(std::upper_bound(all_.begin() + begin, all_.end(), occupant, ComesFirst), occupant);
}

std::span<const Occupant> Occupancy::Beyond(std::uint32_t track, double d_m) const {
  const auto all = On(track);
  const auto from = std::lower_bound(all.begin(), all.end(), d_m - 1e-6,
                                     [](const Occupant& occupant, double d) { return occupant.middle_m() < d; });
  return {from, all.end()};
}

}  // namespace rodeira::traffic
