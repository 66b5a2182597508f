// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "common/runtime/replay/sample_reader.hpp"
#include "common/view/scene/vehicles/scene_snapshot.hpp"

namespace rodeira::cli {

// What a view of a recorded run shows at any time, without any node of the run: as the view of the live run did.
class RecordedMoments {
 public:
  // `sources`: cars and traffic, as the view is wired; `view_period`: of its activations. The run must outlive it.
  RecordedMoments(const replay::RecordedRun& run, std::vector<lockstep::SourceIndex> sources,
                  lockstep::Step view_period);

  // As the window shows it: between the moments of the two activations around that time (the last one: the run's end).
  base::Result<scene::SceneSnapshot> At(std::int64_t time_ns);
  // As a frame of that step shows it: the samples as they are.
  base::Result<scene::SceneSnapshot> Exactly(lockstep::Step step);
  const replay::SampleReader& sample_reader() const { return sample_reader_; }

 private:
  // Instead of a sample that says nothing, the newest one of its source before it that does.
  base::Status FindWhatSays(std::optional<lockstep::Sample>& sample);
  const replay::RecordedRun& run_;
  replay::SampleReader sample_reader_;
  lockstep::Step view_period_;
  lockstep::Step between_from_ = -1;  // the first of the two activations
  scene::PoseHistory between_;
};

}  // namespace rodeira::cli
