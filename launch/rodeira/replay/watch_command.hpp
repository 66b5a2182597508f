// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace rodeira::cli {

// What of a recording is shown or drawn, and how.
struct WatchOptions {
  std::string file;
  double from_s = 0.0;  // of the window
  double speed = 1.0;
  bool paused = false;
  std::string frames;                  // folder of PNG files
  std::vector<double> at_s;            // their times …
  std::optional<double> fps;           // … or a film's pictures a simulated second, from from_s …
  std::optional<double> for_s;         // … for so long; otherwise to the run's end
  std::optional<std::string> camera;   // instead of the recorded view's; scene::CameraNames()
  std::optional<std::string> follow;   // name of a vehicle node
  std::optional<std::string> quality;  // likewise; nodes::QualityNames()
  std::optional<std::string> size;     // "1280x720"
};

// `rodeira replay --view`: the recorded view's window, fed from the file. No node runs. Exit status 0 where the person
// closed it, 2 for wrong input.
int WatchRecording(const WatchOptions& options);
// `rodeira replay --frames FOLDER --at S…` or `--fps N`: the frames that the recorded view would have written at these
// times.
int WriteRecordedFrames(const WatchOptions& options);

}  // namespace rodeira::cli
