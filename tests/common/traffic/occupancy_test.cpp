// SPDX-License-Identifier: Apache-2.0
// The vehicles on each track: what a list of all that were added says.
#include "common/traffic/perception/occupancy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <tuple>

namespace rodeira::traffic {
namespace {

TEST(Occupancy, SaysWhatWasAddedInOrder) {
  constexpr std::uint32_t kTracks = 7;
  std::mt19937 random(3);
  Occupancy occupancy(kTracks);
  for (int step = 0; step < 200; ++step) {
    std::vector<std::vector<Occupant>> all(kTracks);
    occupancy.Clear();
    const auto one = [&](std::uint32_t id) {
      return Occupant{id, -1, static_cast<double>(random() % 5), 6.0};
    };  // many are beside one another
    for (std::uint32_t id = 0; id < random() % 30; ++id) {
      const std::uint32_t track = random() % kTracks;
      all[track].push_back(one(id));
      occupancy.Add(track, all[track].back());
    }
    occupancy.Sort();
    for (std::uint32_t id = 100; id < 100 + random() % 5; ++id) {
      const std::uint32_t track = random() % kTracks;
      all[track].push_back(one(id));
      occupancy.Insert(track, all[track].back());
    }
    for (std::uint32_t track = 0; track < kTracks; ++track) {
      std::sort(all[track].begin(), all[track].end(), [](const Occupant& a, const Occupant& b) {
        return std::tuple(a.middle_m(), a.id) < std::tuple(b.middle_m(), b.id);
      });
      const auto on = occupancy.On(track);
      ASSERT_EQ(on.size(), all[track].size());
      for (std::size_t i = 0; i < on.size(); ++i) EXPECT_EQ(on[i].id, all[track][i].id);
      for (double d = -1.0; d < 7.0; d += 0.25) {
        const auto beyond = occupancy.Beyond(track, d);
        const auto count = std::count_if(all[track].begin(), all[track].end(),
                                         [&](const Occupant& other) { return other.middle_m() >= d; });
        EXPECT_EQ(static_cast<std::ptrdiff_t>(beyond.size()), count) << d;
      }
    }
  }
}

}  // namespace
}  // namespace rodeira::traffic
