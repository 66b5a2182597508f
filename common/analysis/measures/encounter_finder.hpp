// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "common/analysis/measures/encounter.hpp"
#include "common/analysis/measures/encroachment.hpp"
#include "common/analysis/measures/leader_finder.hpp"

namespace rodeira::measures {

// Poses are kept at this rate, and are linear between.
inline constexpr double kEncounterRate_hz = 10.0;
// Vehicles count that pass a place of the own path at most so long before or after the own one. While the own vehicle
// stands or creeps, those count, too, that pass the way that it drives next.
inline constexpr double kEncounterHorizon_s = 10.0;
inline constexpr double kEncounterWay_m = 30.0;
// Paths with a smaller angle between the headings follow one another. Larger differences of height are bridges.
inline constexpr double kEncounterAngle_rad = 0.26;
inline constexpr double kEncounterHeight_m = 2.5;

// Finds the encounters of a drive from poses of all vehicles, in the plane and with swept footprints. The common area
// lies where the paths have an angle: of paths that join it ends where both go one way. Paths that part from a common
// one have none. Of other vehicles only the poses near the own path are kept: memory grows with the duration.
class EncounterFinder {
 public:
  // A sample of the own vehicle; in the order of time. breaks: it is not reached from the one before.
  void AddOwn(double time_s, double z_m, const Footprint& footprint, bool breaks);
  // The others at a time, in the order of time. The own path must be known up to kEncounterHorizon_s later, or whole.
  void AddOthers(double time_s, std::span<const OtherVehicle> others);
  // By time.
  std::vector<Encounter> Finish();

 private:
  struct Pose {
    double time_s = 0.0, z_m = 0.0;
    Footprint footprint;
  };
  struct Knot : Pose {
    double way_m = 0.0;  // driven since the first one
    int part = 0;        // of the drive, between breaks
  };
  // Indices [from, to) of knots.
  struct Range {
    std::size_t from = 0, to = 0;
  };
  // What an other's pose is to the own path.
  struct Contact {
    bool touches = false;
    double angle_rad = 0.0, distance_m = 0.0;
    std::size_t nearest = 0;
  };
  void PutKnot(const Pose& pose, bool breaks);
  Range TimesAround(double time_s) const;
  Range PathOf(double time_s) const;
  bool IsNear(const Footprint& footprint, double step_m, Range range) const;
  Contact ContactAt(const Pose& pose, Range range) const;
  bool Touches(const Footprint& footprint, std::size_t knot) const;
  std::vector<Pose> OwnPath(Range range) const;
  void FindOnTrack(std::int64_t id, std::span<const Pose> track, std::vector<Encounter>& found) const;
  std::optional<Encounter> EncounterOf(std::span<const Pose> track, std::size_t from, std::size_t to,
                                       Range range) const;

  std::vector<Knot> knots_;
  std::optional<Pose> standing_;  // the newest pose of a standstill
  int part_ = 0;
  double next_own_s_ = 0.0, next_others_s_ = 0.0;
  std::map<std::int64_t, std::vector<Pose>> kept_;
};

}  // namespace rodeira::measures
