// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "launch/rodeira/replay/recorded_moments.hpp"
#include "launch/rodeira/replay/recorded_view.hpp"
#include "nodes/view/run_connection/from_wire.hpp"
#include "tests/common/runtime/replay/made_recording.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/system/command.hpp"

namespace rodeira::cli {

// A made recording of 6 s, which is watched.
class WatchTest : public ::testing::Test {
 protected:
  static constexpr lockstep::Step kLast = 6'010;  // no activation of the view

  // A car that weaves and traffic of which one agent goes away at 3 s and comes again elsewhere, seen every 20 ms.
  static constexpr const char* kLaunch =
      "rodeira: launch/1\nname: made\nnodes:\n  hands: {kind: input}\n  ego: {kind: vehicle, period_s: 0.004}\n  "
      "others: "
      "{kind: "
      "traffic, period_s: 0.01}\n"
      "  picture: {kind: view, config: {width_px: 320, height_px: 180, camera: driver, instruments: false, window: "
      "never, "
      "frames: {times_s: [1], folder: /proc/nowhere}}}\n";

  static base::Bytes Payload(const lockstep::Source& source, lockstep::Step step) {
    const double t = 0.001 * static_cast<double>(step);
    if (source.topic == idl::topics::kControls) return idl::Encode(msg::Controls());
    if (source.topic == idl::topics::kVehicleState) {
      msg::VehicleState car;
      car.position_w_m().x(20.0 * t);
      car.position_w_m().y(3.0 * std::sin(t));
      car.attitude_wb().w(std::cos(0.1 * t));
      car.attitude_wb().z(std::sin(0.1 * t));
      for (auto& wheel : car.wheels()) {
        wheel.spin_rad(std::remainder(60.0 * t, 6.283185307179586));
        wheel.spin_radps(60.0);
      }
      return idl::Encode(car);
    }
    if (source.topic == idl::topics::kSignalsState) return idl::Encode(msg::SignalsState());
    if (source.topic == idl::topics::kTrafficDetails) {  // ten times a second; nothing between
      msg::TrafficDetails details;
      for (const std::uint32_t id : {4U, 9U}) {
        if (step % 100 != 0) break;
        msg::TrafficDetail detail;
        detail.id(id);
        detail.gear(static_cast<std::int32_t>(id));
        detail.target_speed_mps(static_cast<float>(t));
        details.agents().push_back(detail);
      }
      return idl::Encode(details);
    }
    msg::TrafficState traffic;
    for (const std::uint32_t id : {4U, 9U}) {
      msg::TrafficAgent agent;
      agent.id(id);
      agent.trip(id == 9 && step >= 3'000 ? 1 : 0);
      agent.position_x_m(id == 9 && step >= 3'000 ? -500.0 : 10.0 * t + id);
      agent.heading_rad(0.2 * t);
      traffic.agents().push_back(agent);
    }
    return idl::Encode(traffic);
  }

  static bool Same(const scene::SceneSnapshot& a, const scene::SceneSnapshot& b) {
    if (a.time_ns != b.time_ns || a.cars.size() != b.cars.size() || a.agents.size() != b.agents.size()) return false;
    for (std::size_t i = 0; i < a.cars.size(); ++i) {
      if (a.cars[i].p_WB_W != b.cars[i].p_WB_W || a.cars[i].q_WB.coeffs() != b.cars[i].q_WB.coeffs()) return false;
      if (a.cars[i].wheels[2].spin_rad != b.cars[i].wheels[2].spin_rad || a.cars[i].gear != b.cars[i].gear)
        return false;
    }
    for (std::size_t i = 0; i < a.agents.size(); ++i) {
      if (a.agents[i].id != b.agents[i].id || a.agents[i].p_WB_W != b.agents[i].p_WB_W ||
          a.agents[i].q_WB.coeffs() != b.agents[i].q_WB.coeffs())
        return false;
    }
    return true;
  }

  std::string Path(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string Made(const std::string& launch = kLaunch, const std::function<void(record::McapWriter&)>& more = {}) {
    replay::MadeRecording spec;
    spec.launch_text = launch;
    spec.last_step = kLast;
    spec.payload = Payload;
    spec.more = more;
    replay::Make(spec, Path("made.mcap"));
    return Path("made.mcap");
  }
  static RecordedMoments MomentsOf(const replay::RecordedRun& run) {
    const auto seen = LookAt(run, {});
    EXPECT_TRUE(seen.ok()) << seen.error().Text();
    return {run, seen.value().sources, seen.value().period};
  }
  static system_test::Ended Replay(std::vector<std::string> words) {
    words.insert(words.begin(), {"DISPLAY=", "WAYLAND_DISPLAY=", system_test::Bin("rodeira"), "replay"});
    return system_test::RunCommand(words);
  }
  // What the live view's window had in hand: a moment at each of its activations, made from the newest samples.
  static scene::PoseHistory HistoryUpTo(const replay::RecordedRun& run, lockstep::Step step) {
    scene::PoseHistory history;
    for (lockstep::Step at = std::max<lockstep::Step>(0, step - 100) / 20 * 20; at <= std::min(step, kLast); at += 20) {
      nodes::NewestSamples newest;
      for (lockstep::SourceIndex s = 0; s < run.roster().sources().size(); ++s) {
        const auto& source = run.roster().source(s);
        if (source.topic != idl::topics::kVehicleState && source.topic != idl::topics::kTrafficState) continue;
        newest[s] = std::make_shared<const base::Bytes>(Payload(source, lockstep::FloorTo(at, source.period)));
      }
      history.Add(nodes::MakeMoment(run.roster(), at, newest).value());
    }
    return history;
  }

  TemporaryFolder folder_;
};

}  // namespace rodeira::cli
