// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "common/runtime/launch/launch.hpp"
#include "common/runtime/lockstep/in_process.hpp"
#include "common/vehicle/input_devices/key_names.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "launch/rodeira/run/local_nodes.hpp"
#include "tests/tree.hpp"

namespace rodeira {

// A car on the plane, driven by an input node of the test's choice, in this process.
inline std::string LiveLaunch(const std::string& input_config) {
  return "rodeira: launch/1\nworld: ../configs/worlds/plane.yaml\nnodes:\n  road: {kind: road}\n  driver:\n    kind: "
         "input\n    "
         "config: " +
         input_config + "\n  ego: {kind: vehicle, config: {vehicle: ../configs/vehicles/default.yaml}}\n";
}

struct LiveDrive {
  lockstep::RunOutcome outcome;
  std::map<lockstep::Step, msg::Controls> controls;  // by the step at which they are valid
  msg::VehicleState last;
};

// `hands` is called with each of the input's samples, on its thread, before its next activation: what a test does there
// comes at the same step every time.
inline LiveDrive DriveLive(const launch::Launch& launch, cli::LocalNodes& nodes, lockstep::Step last,
                           const std::function<void(lockstep::Step)>& hands) {
  LiveDrive drive;
  lockstep::InProcessSettings settings;
  settings.last_step = last;
  settings.on_sample = [&](const lockstep::Sample& sample) {
    const auto& topic = launch.roster().source(sample.source()).topic;
    if (topic == idl::topics::kControls) {
      drive.controls[sample.valid()] = idl::Decode<msg::Controls>(*sample.payload).value();
      if (hands) hands(sample.valid());
    } else if (topic == idl::topics::kVehicleState && sample.valid() == last) {
      drive.last = idl::Decode<msg::VehicleState>(*sample.payload).value();
    }
  };
  drive.outcome = lockstep::RunThreaded(launch.roster(), nodes.nodes(), settings);
  EXPECT_TRUE(drive.outcome.ok) << drive.outcome.fault;
  return drive;
}

// Keys down from a step on (until the next entry).
using KeyScript = std::map<lockstep::Step, std::vector<std::string>>;

// The same of a launch file's text, as if it lay in `launch`, with a window in which keys are held by a script.
inline LiveDrive DriveByKeys(const std::string& launch_text, const KeyScript& script, lockstep::Step last) {
  const auto launch = launch::Launch::Parse(launch_text, std::filesystem::path(SourceDir()) / "launch/live.yaml");
  EXPECT_TRUE(launch.ok()) << launch.error().Text();
  auto nodes = cli::LocalNodes::Make(launch.value());
  EXPECT_TRUE(nodes.ok()) << nodes.error().Text();
  const auto window = nodes.value().keys().MakeSender();
  std::map<input_devices::Key, launch::LiveKey> keys;
  return DriveLive(launch.value(), nodes.value(), last, [&](lockstep::Step step) {
    if (const auto now = script.find(step); now != script.end()) {
      for (auto& [key, entry] : keys) entry.held = false;
      for (const std::string& name : now->second) {
        launch::LiveKey& entry = keys[input_devices::KeyOf(name).value()];
        entry.key = input_devices::KeyOf(name).value();
        entry.held = true;
        ++entry.presses;
      }
    }
    std::vector<launch::LiveKey> all;
    for (const auto& [key, entry] : keys) all.push_back(entry);
    window->Say(std::move(all));
  });
}

}  // namespace rodeira
