// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/analysis/measures/table.hpp"
#include "common/core/base/result.hpp"
#include "common/data/record/mcap_reader.hpp"
#include "common/runtime/replay/recorded_run.hpp"
#include "common/world/road/world.hpp"

// What `measures`, `report`, `export --derived` and `export --fcd` have in common: a recording with the kinematics
// rebuilt from it.
namespace rodeira::cli {

// How much of several files is read, on a terminal and after two seconds.
class ReadingProgress {
 public:
  ReadingProgress(bool quiet, std::size_t files);
  ~ReadingProgress();
  // share: of file number `file`. False where the command was interrupted.
  bool Show(std::size_t file, double share);

 private:
  bool quiet_;
  std::size_t files_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// A recording that was read.
struct MeasuredRecording {
  std::shared_ptr<const road::World> world;  // null: none is embedded
  measures::DriveReading reading;
  measures::RecordingFacts facts;
  record::TextMap meta;
};

// The world that the recording embeds; null: there is none. Wrong input where it does not load, or is another one than
// the recording says.
base::Result<std::shared_ptr<const road::World>> EmbeddedWorld(const replay::RecordedRun& run);

// subject, progress: as in DriveQuery. Wrong input where the recording is damaged, or embeds another world than it
// says.
base::Result<MeasuredRecording> ReadMeasured(const std::string& file, const std::string& subject,
                                             const std::function<bool(double)>& progress);

// The rows of a recording, with participant, condition and run from its meta data.
std::vector<measures::MeasuresRow> RowsOf(const measures::MeasuresSpec& spec, const MeasuredRecording& recording);

// The spec of a command line: a measures file or every measure, with what the options replace in it. Texts may be
// empty.
base::Result<measures::MeasuresSpec> MeasuresSpecOf(const std::string& file, const std::vector<std::string>& intervals,
                                                    const std::string& baseline, const std::string& subject);

// Wrong input where an interval's mark, event or road is in none of the recordings.
base::Status CheckIntervalNames(const measures::MeasuresSpec& spec, const std::vector<measures::MeasuresRow>& rows);

}  // namespace rodeira::cli
