// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

#include "nodes/input/source.hpp"

namespace rodeira::nodes {

// Controls over time from a table. Angles and pedals are linear between its rows, gear, mode and starter hold; before
// the first row and behind the last one their values hold.
class Script {
 public:
  // CSV with a head line: `time_s` and any of steering_wheel_rad (or steering_wheel_deg), throttle, brake, clutch,
  // handbrake, gear, manual (0 or 1), starter. Times ascend. Lines beginning with # are passed over. Wrong input with
  // file:line otherwise.
  static base::Result<Script> Parse(std::string_view text, const std::filesystem::path& name);

  // time_s: since the run's beginning.
  dynamics::Controls At(double time_s) const;

 private:
  struct Row {
    double time_s = 0.0;
    dynamics::Controls controls;
  };
  std::vector<Row> rows_;
};

// A source that gives the script's controls; signals stay off.
std::unique_ptr<Source> MakeScriptSource(Script script);

}  // namespace rodeira::nodes
