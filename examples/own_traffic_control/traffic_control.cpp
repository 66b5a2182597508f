// SPDX-License-Identifier: Apache-2.0
// Slows each vehicle that comes to be ahead of the driver's car, and holds a light red from 5 s on.
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>

#include "common/runtime/dds/external_node.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"

namespace {

using namespace rodeira;

class TrafficControl final : public lockstep::Node {
 public:
  explicit TrafficControl(std::string light) : light_(std::move(light)) {}

  base::Status Initialise(lockstep::Outbox& outbox) override {
    outbox.Put(idl::topics::kTrafficRequests, idl::Encode(msg::TrafficRequests()));
    return {};
  }
  base::Status Step(const lockstep::StepInfo& step, const lockstep::Inbox& inbox, lockstep::Outbox& outbox) override {
    for (const lockstep::Sample& sample : inbox.All(idl::topics::kTrafficAnswers)) {
      const auto answers = idl::Decode<msg::TrafficAnswers>(*sample.payload);
      if (!answers) return answers.error();
      for (const msg::TrafficAnswer& answer : answers.value().answers()) {
        if (answer.refused() != 0) std::printf("refused: %s\n", answer.sentence().c_str());
      }
    }
    const auto car = idl::Decode<msg::VehicleState>(*inbox.Latest(idl::topics::kVehicleState).payload);
    if (!car) return car.error();
    const auto traffic = idl::Decode<msg::TrafficState>(*inbox.Latest(idl::topics::kTrafficState).payload);
    if (!traffic) return traffic.error();
    msg::TrafficRequests out;
    const auto ask = [&](const char* name) -> msg::TrafficRequest& {
      out.requests().emplace_back();
      out.requests().back().number(++number_);
      out.requests().back().name(name);
      return out.requests().back();
    };
    if (step.time_ns == 5'000'000'000) {
      msg::TrafficRequest& light = ask("light");
      light.light(light_), light.choice("red"), light.duration_s(20.0);
    }
    const auto& q = car.value().attitude_wb();
    const double heading = 2.0 * std::atan2(q.z(), q.w());  // on a level road
    for (const msg::TrafficAgent& agent : traffic.value().agents()) {
      const double x = agent.position_x_m() - car.value().position_w_m().x(),
                   y = agent.position_y_m() - car.value().position_w_m().y(),
                   ahead_m = x * std::cos(heading) + y * std::sin(heading),
                   left_m = y * std::cos(heading) - x * std::sin(heading);
      if (ahead_m < 5.0 || ahead_m > 60.0 || std::fabs(left_m) > 1.5 || agent.id() == slowed_) continue;
      msg::TrafficRequest& speed = ask("speed");
      speed.agent(slowed_ = agent.id()), speed.speed_mps(6.0);
    }
    outbox.Put(idl::topics::kTrafficRequests, idl::Encode(out));
    return {};
  }
  void Save(base::StateWriter& out) const override { out.Put("number", number_), out.Put("slowed", slowed_); }
  void Restore(base::StateReader& in) override { in.Get("number", number_), in.Get("slowed", slowed_); }

 private:
  std::string light_;
  std::uint32_t number_ = 0, slowed_ = 0xFFFFFFFF;
};

base::Result<std::unique_ptr<lockstep::Node>> MakeTrafficControl(launch::NodeContext& context) {
  return std::unique_ptr<lockstep::Node>(std::make_unique<TrafficControl>(context.config().Text("light")));
}

}  // namespace

RODEIRA_NODE(MakeTrafficControl);
