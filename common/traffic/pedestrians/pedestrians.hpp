// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/core/base/state.hpp"
#include "common/driving/driver/footprint.hpp"
#include "common/traffic/pedestrians/pedestrian_settings.hpp"
#include "common/world/lanes/foot_crossings.hpp"

namespace rodeira::traffic {

// A pedestrian as others see it, at the middle between its feet.
struct PersonPose {
  std::uint32_t id = 0;
  std::uint32_t trip = 0;  // another trip is another person
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
  double heading_rad = 0.0;
  double speed_mps = 0.0;
  double stride_rad = 0.0;  // of a wheel of kStrideRadius_m that rolls along: it turns once in two steps
  double height_m = 1.75;
  std::uint32_t colour_rgb = 0x808080;
};

// Why no pedestrian crosses a road: it is not there, or has no crossing.
std::string WithoutCrossing(const network::Network& network, std::string_view road);

// People on foot at a network's crossings: they arrive by Poisson flows, wait at the kerb until they are let go, cross
// straight at a speed of their own, keeping to the right and behind one another, and are gone. One that is hit stays
// where it is. What cars do is told from outside. A step is a function of the state and of what is told; draws are
// keyed by seed, crossing and number of arrival.
class Pedestrians {
 public:
  static constexpr std::uint32_t kFirstId = 2'000'000;  // their numbers lie beyond those of vehicles
  static constexpr double kLength_m = 0.4, kWidth_m = 0.5;
  static constexpr double kStrideRadius_m = 0.24;

  // A pedestrian, walking or waiting.
  struct Person {
    bool present = false;  // between arrival and end; else the place is free for another one
    bool walks = false;    // has been let go
    bool is_hit = false;
    std::uint32_t crossing = 0;
    std::uint32_t side = 0;    // begins at the crossing's beginning (0) or end (1)
    std::uint32_t number = 0;  // of arrival at the crossing
    std::uint32_t trip = 0;
    double u_m = 0.0;        // gone from the kerb; below 0 before it
    double speed_mps = 0.0;  // now
    double gone_m = 0.0;
    double waited_s = 0.0;  // at the kerb

    void Save(base::StateWriter& writer) const;
    void Restore(base::StateReader& reader);
  };
  // Of one side of a crossing.
  struct Count {
    std::uint32_t arrived = 0, left = 0;
    std::uint32_t flowed = 0;   // of those that have arrived: not called
    std::int64_t next_ns = -1;  // when the next one comes; below 0: none does
    double waited_s = 0.0;      // summed over all that have been let go
    std::uint32_t let_go = 0;

    void Save(base::StateWriter& writer) const;
    void Restore(base::StateReader& reader);
  };

  // Wrong input where a pedestrian should walk and there is no crossing.
  static base::Result<Pedestrians> Make(const lanes::Graph& graph, const lanes::LargestCar& car,
                                        const PedestrianSettings& settings, std::uint64_t seed);

  const std::vector<lanes::FootCrossing>& crossings() const { return *crossings_; }
  // The passes that lead over a track: crossing and index of the pass.
  struct OnTrack {
    std::uint32_t crossing = 0, pass = 0;
  };
  // Precondition: a track of the graph.
  const std::vector<OnTrack>& OfTrack(std::uint32_t track) const { return (*of_track_)[track]; }

  // Whether a pedestrian stands at the kerb of a crossing, ready to go.
  bool Waits(std::uint32_t crossing) const;
  // Whether a pedestrian has been let go and is not beyond a pass yet, or lies there.
  bool IsUsed(std::uint32_t crossing, std::uint32_t pass) const;
  // All that wait at its kerbs begin to cross.
  void LetGo(std::uint32_t crossing);
  // All move, and arrivals within the step appear.
  void Step(double dt_s, std::int64_t until_ns);
  // One more comes, from a side (0, 1), at once.
  void Come(std::uint32_t crossing, std::uint32_t side);
  // One that has been hit stays there; nothing where there is none with this number.
  void Hit(std::uint32_t id);
  // The crossing of a road nearest to a station; nothing where the road has none.
  std::optional<std::uint32_t> Nearest(const network::Network& network, std::string_view road, double s_m) const;

  // Of all that are seen, ascending by id.
  std::vector<PersonPose> Poses() const;
  // The same as rectangles of kLength_m by kWidth_m.
  std::vector<driver::Footprint> Footprints() const;
  const std::vector<Person>& people() const { return people_; }
  const std::vector<Count>& counts() const { return counts_; }

  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);

 private:
  Pedestrians(const PedestrianSettings& settings, std::uint64_t seed) : settings_(settings), seed_(seed) {}

  double Draw(const Person& person, std::uint64_t what) const;
  double WalkingSpeed(const Person& person) const;
  int FileOf(const Person& person) const;
  int FilesOf(std::uint32_t crossing) const;
  double BeforeOf(const Person& person) const;
  double AfterOf(const Person& person) const;
  std::int64_t NextAt(std::uint32_t crossing) const;
  Eigen::Vector3d PlaceOf(const Person& person) const;
  bool IsSeen(const Person& person) const { return person.present && person.u_m >= -BeforeOf(person) - 1e-9; }
  void OrderAll();

  PedestrianSettings settings_;
  std::uint64_t seed_ = 1;
  std::shared_ptr<const std::vector<lanes::FootCrossing>> crossings_;
  std::shared_ptr<const std::vector<std::vector<OnTrack>>> of_track_;
  std::vector<double> per_h_;  // by crossing
  std::vector<Count> counts_;  // by crossing
  std::vector<Person> people_;
  std::vector<std::vector<std::uint32_t>> order_;  // by crossing: the present ones, by arrival; found from people_
};

}  // namespace rodeira::traffic
