#pragma once

#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {

// What lies below an agent is in no near memory where there are thousands: while one is told, the lists of the next ones are fetched, then the tracks that these name.
inline void TrafficModel::Fetch(std::size_t id, std::size_t end) const {
  constexpr std::size_t kLists = 10, kTracks = 4, kLine_bytes = 64;
  if (id + kLists < end) {
    __builtin_prefetch(agents_[id + kLists].path.data());
    __builtin_prefetch(stretches_[id + kLists].data());
  }
  if (id + kTracks >= end || stretches_[id + kTracks].empty()) return;
  const std::uint32_t track = stretches_[id + kTracks].front().track;
  const auto* curve = reinterpret_cast<const char*>(&graph()[track].curve);
  for (std::size_t byte = 0; byte < sizeof(lanes::Curve); byte += kLine_bytes) __builtin_prefetch(curve + byte);
  __builtin_prefetch(&map_->plans[track].plan);
  __builtin_prefetch(&occupants_[track]);
}

template <class Tell>
void TrafficModel::EachDriving(const Tell& tell) {
  const auto some = [&](std::size_t begin, std::size_t end) {
    for (std::size_t id = begin; id < end; ++id) {
      Fetch(id, end);
      if (agents_[id].on_road) tell(static_cast<std::uint32_t>(id));
    }
  };
  base::Share(crew_.get(), agents_.size(), some);
}

}  // namespace rodeira::traffic
