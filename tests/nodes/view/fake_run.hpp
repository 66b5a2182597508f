// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <memory>
#include <string>

#include "common/runtime/launch/node_context.hpp"
#include "common/runtime/lockstep/node.hpp"
#include "common/view/scene/vehicles/scene_snapshot.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"

// A car and an agent on known ways, for the view to look at: no vehicle or traffic model is needed.
namespace rodeira::nodes {

class PlainContext final : public launch::NodeContext {
 public:
  using NodeContext::NodeContext;
  ground::Ground& Ground() override { return ground_; }
  base::Result<launch::WorldSummary> World() override {
    return base::WrongInput("run.no_answer", "no road server here");
  }

 private:
  ground::PlaneGround ground_;
};

inline double HeadingAt(double time_s) { return 0.2 * time_s; }
inline Eigen::Vector3d CarAtTime(double time_s) { return {20.0 * time_s, 3.0 * std::sin(time_s), 0.0}; }
// 16 m ahead of the car, passing from its left to its right.
inline Eigen::Vector3d AgentInCar(double time_s) { return {16.0, 3.0 - 4.0 * time_s, 0.0}; }
inline Eigen::Vector3d AgentAtTime(double time_s) {
  return CarAtTime(time_s) + scene::Attitude(HeadingAt(time_s), 0.0, 0.0) * AgentInCar(time_s);
}

class FakeSource final : public lockstep::Node {
 public:
  FakeSource(std::string_view topic, double base_step_s) : topic_(topic), base_step_s_(base_step_s) {}
  base::Status Initialise(lockstep::Outbox& outbox) override {
    Publish(0, outbox);
    return {};
  }
  base::Status Step(const lockstep::StepInfo& step, const lockstep::Inbox&, lockstep::Outbox& outbox) override {
    Publish(step.output_valid, outbox);
    return {};
  }
  void Save(base::StateWriter&) const override {}
  void Restore(base::StateReader&) override {}

 private:
  void Publish(lockstep::Step valid, lockstep::Outbox& outbox) const {
    const double time_s = static_cast<double>(valid) * base_step_s_;
    if (topic_ == idl::topics::kControls) return outbox.Put(topic_, idl::Encode(msg::Controls()));
    if (topic_ == idl::topics::kVehicleState) {
      outbox.Put(idl::topics::kCollisions, idl::Encode(msg::Collisions()));
      return outbox.Put(topic_, idl::Encode(Car(time_s)));
    }
    outbox.Put(idl::topics::kSignalsState, idl::Encode(msg::SignalsState()));
    outbox.Put(idl::topics::kTrafficDetails, idl::Encode(msg::TrafficDetails()));
    msg::TrafficState traffic;
    msg::TrafficAgent agent;
    agent.id(7);
    agent.colour_rgb(0x1040e0);
    agent.position_x_m(AgentAtTime(time_s).x());
    agent.position_y_m(AgentAtTime(time_s).y());
    agent.heading_rad(HeadingAt(time_s));
    agent.length_m(4.2);
    agent.width_m(1.75);
    agent.height_m(1.45);
    agent.wheelbase_m(2.6);
    agent.wheel_radius_m(0.3);
    traffic.agents().push_back(agent);
    outbox.Put(topic_, idl::Encode(traffic));
  }
  static msg::VehicleState Car(double time_s) {
    msg::VehicleState car;
    const Eigen::Vector3d p = CarAtTime(time_s);
    car.position_w_m().x(p.x());
    car.position_w_m().y(p.y());
    const Eigen::Quaterniond q = scene::Attitude(HeadingAt(time_s), 0.0, 0.0);
    car.attitude_wb().w(q.w());
    car.attitude_wb().x(q.x());
    car.attitude_wb().y(q.y());
    car.attitude_wb().z(q.z());
    for (std::size_t i = 0; i < 4; ++i) {
      car.wheels()[i].hub_b_m().x(i < 2 ? 1.23 : -1.23);
      car.wheels()[i].hub_b_m().y(i % 2 == 0 ? 0.71 : -0.71);
      car.wheels()[i].hub_b_m().z(0.2915);
    }
    car.length_m(3.85);
    car.front_m(2.01);
    car.width_m(1.65);
    car.gear(3);
    return car;
  }

  std::string_view topic_;
  double base_step_s_;
};

// A launch file of the four, with the view's own keys.
inline std::string LaunchText(const std::string& view_config, const std::string& vehicle_period_s = "0.001") {
  return "rodeira: launch/1\nname: fake\nnodes:\n  hands: {kind: input}\n  ego: {kind: vehicle, period_s: " +
         vehicle_period_s + "}\n  others: {kind: traffic}\n  picture:\n    kind: view\n    config: " + view_config +
         "\n";
}

}  // namespace rodeira::nodes
