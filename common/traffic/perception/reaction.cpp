// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/perception/reaction.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rodeira::traffic {

void PastLeaders::Save(base::StateWriter& writer) const {
  std::vector<double> places;
  std::vector<std::int64_t> numbers;
  for (const Of& one : of) {
    places.insert(places.end(), {one.gap_m, one.speed_mps});
    numbers.insert(numbers.end(), {one.id, one.body, one.trip});
  }
  writer.Put("time_ns", time_ns);
  writer.Put("places", places);
  writer.Put("numbers", numbers);
}

void PastLeaders::Restore(base::StateReader& reader) {
  std::vector<double> places;
  std::vector<std::int64_t> numbers;
  reader.Get("time_ns", time_ns);
  reader.Get("places", places);
  reader.Get("numbers", numbers);
  of.clear();
  for (std::size_t i = 0; 2 * i + 1 < places.size() && 3 * i + 2 < numbers.size(); ++i)
    of.push_back({places[2 * i], places[2 * i + 1], numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]});
}

void Reaction::Note() {
  PastLeaders now;
  if (out_.past.size() > 1 && out_.past[1].time_ns <= in_.time_ns - std::llround(in_.settings.reaction_s * 1e9)) {
    now = std::move(out_.past.front());  // its memory
    out_.past.pop_front();
  }
  now.time_ns = in_.time_ns;
  now.of.assign(in_.agents.size(), {});
  for (std::size_t id = 0; id < in_.agents.size(); ++id) {
    if (!in_.agents[id].on_road) continue;
    const Leader& ahead = in_.ahead[id];
    now.of[id] = {ahead.gap_m, ahead.speed_mps, ahead.any ? ahead.id : -1, ahead.any ? ahead.body : -1,
                  static_cast<std::int64_t>(in_.agents[id].trip)};
  }
  out_.past.push_back(std::move(now));
}

void Reaction::Perceive() {
  Note();
  const std::int64_t until = in_.time_ns - std::llround(in_.settings.reaction_s * 1e9);
  while (out_.past.size() > 1 && out_.past[1].time_ns <= until) out_.past.pop_front();
  for (std::size_t id = 0; id < in_.agents.size(); ++id) {
    if (!in_.agents[id].on_road) continue;
    const auto of_trip = [&](const PastLeaders& past) {
      return past.of[id].trip == static_cast<std::int64_t>(in_.agents[id].trip);
    };
    const PastLeaders::Of& seen = std::ranges::find_if(out_.past, of_trip)->of[id];
    Leader& leader = out_.perceived[id] = Leader();
    if (seen.id < 0 && seen.body < 0) continue;
    leader.any = true;
    leader.gap_m = seen.gap_m, leader.speed_mps = seen.speed_mps, leader.id = seen.id, leader.body = seen.body;
  }
}

}  // namespace rodeira::traffic
