// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "common/analysis/measures/drive.hpp"
#include "common/analysis/measures/encounter_finder.hpp"
#include "common/analysis/measures/sample_kinematics.hpp"
#include "common/analysis/measures/way_ahead.hpp"

namespace rodeira::measures {

// Puts a drive together from samples as they come. The subject's come in the order of time; the other vehicles' may be
// up to kLag samples earlier or later: leaders are looked for that much later, when the subject's way is known.
class DriveBuilder {
 public:
  // network may be null.
  DriveBuilder(const network::Network* network, double rate_hz);

  // front_m: from B's origin to the front bumper.
  void SetFootprint(double length_m, double front_m, double width_m);
  // k ascends; a sample that was there already, or comes late, is passed over.
  void AddSubject(std::size_t k, const SubjectSample& sample);
  // The others at a sample. `traffic`: these are all agents of it; without, vehicles beside them.
  void AddOthers(std::size_t k, const std::vector<OtherVehicle>& others, bool traffic);
  // The colour of a controller's lights from a sample on, as in Drive::light_ahead. Ascending samples.
  void AddLight(std::size_t k, std::uint32_t controller, double colour);
  // Whether there is traffic, so that samples without it are filled in between.
  void ExpectTraffic() { has_traffic_ = true; }
  // Once, after the last sample.
  Drive Finish();

  bool has_subject() const { return next_ > 0; }

 private:
  struct Frame {
    std::vector<OtherVehicle> others;
    bool traffic = false;
  };
  struct Visit {
    std::size_t from = 0;  // sample
    std::int64_t track = -1;
  };
  void GrowTo(std::size_t size);
  void AddToPath(std::size_t k, bool breaks);
  void AddLane(std::size_t k, const SubjectSample& sample);
  void ProcessThrough(std::size_t k);
  void FindNeighbours(std::size_t k, const Frame& frame);
  std::vector<std::uint32_t> LaterTracks(std::size_t visit) const;
  void PutAhead();

  static constexpr std::size_t kLag = 2000;
  static constexpr std::size_t kVisits = 60;  // of tracks, before and after, by which a way is chosen
  std::optional<lanes::Graph> graph_;
  std::optional<LaneFinder> lanes_;
  std::optional<LeaderFinder> leaders_;
  EncounterFinder encounters_;
  Drive drive_;
  network::Hint hint_;
  std::optional<LanePlace> last_place_;
  std::int32_t episode_ = 0;
  std::size_t next_ = 0;  // the sample behind the subject's newest
  bool has_traffic_ = false;
  std::map<std::size_t, Frame> frames_;
  std::vector<double> along_m_;                                     // the track of the sample
  std::vector<Visit> visits_;                                       // of tracks, one after the other
  std::vector<std::size_t> frame_samples_;                          // at which neighbours were looked for
  std::map<std::uint32_t, std::map<std::size_t, double>> colours_;  // by controller and sample: its changes
};

}  // namespace rodeira::measures
