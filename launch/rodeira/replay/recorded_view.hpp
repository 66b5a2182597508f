// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "common/runtime/replay/recorded_run.hpp"
#include "launch/rodeira/replay/watch_command.hpp"
#include "nodes/view/playback/replay_window.hpp"
#include "nodes/view/view_settings.hpp"

namespace rodeira::cli {

// What a view of the run looks at, and how.
struct Seen {
  nodes::ViewSettings settings;
  std::vector<lockstep::SourceIndex> cars;
  std::vector<lockstep::SourceIndex> sources;  // cars, traffic, lights
  lockstep::Step period = 1;                   // of the view
};

// As the recorded launch file's first view; all cars and traffic at 50 Hz where it has none. Wrong input where there is
// nothing to see, or where an option is wrong.
base::Result<Seen> LookAt(const replay::RecordedRun& run, const WatchOptions& options);

// The operator's marks, what failed, and the events of scenarios, those included that people asked for: weather,
// places, texts. Of a run without a scenario only the chunks with remarks are read. Those found
// so far where `stop`, asked between two messages, says so.
base::Result<std::vector<nodes::ReplayMark>> MarksOf(const replay::RecordedRun& run,
                                                     const std::function<bool()>& stop = {});

}  // namespace rodeira::cli
