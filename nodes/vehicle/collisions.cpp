// SPDX-License-Identifier: Apache-2.0
#include "nodes/vehicle/collisions.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "idl/codec.hpp"
#include "idl/topics.hpp"
#include "nodes/messages/vehicle_state.hpp"

namespace rodeira::nodes {
namespace {

constexpr std::uint32_t kInWorld = 0,
                        kAgent = 1;  // collisions.idl; another node's car is an agent by its stream, with the id 0

// The same of another node's car, which turns as well.
dynamics::Obstacle BoxOf(const msg::VehicleState& wire, double late_s) {
  const dynamics::VehicleState car = FromMessage(wire);
  dynamics::VehicleDimensions dimensions;
  dimensions.front_m = static_cast<double>(wire.front_m());
  dimensions.rear_m = static_cast<double>(wire.length_m()) - dimensions.front_m;
  dimensions.width_m = static_cast<double>(wire.width_m());
  dimensions.height_m = static_cast<double>(wire.height_m());
  const dynamics::BodyBox box = dynamics::BoxOf(dimensions, {});
  const Eigen::Vector3d middle_W = car.q_WB * box.centre_B;
  dynamics::Obstacle obstacle;
  obstacle.q_WO = car.q_WB;
  obstacle.w_WO_W = car.q_WB * car.w_WB_B;
  obstacle.v_WO_W = car.v_WB_W + obstacle.w_WO_W.cross(middle_W);
  obstacle.centre_W = car.p_WB_W + middle_W + late_s * obstacle.v_WO_W;
  obstacle.half_m = box.half_m;
  return obstacle;
}

// The agent's box `late_s` after it was there.
dynamics::Obstacle BoxOf(const msg::TrafficAgent& agent, double late_s) {
  const dynamics::CollisionSettings settings;
  const double half_length = 0.5 * static_cast<double>(agent.length_m());
  dynamics::VehicleDimensions dimensions;
  dimensions.front_m = dimensions.rear_m = half_length;
  dimensions.width_m = static_cast<double>(agent.width_m());
  dimensions.height_m = static_cast<double>(agent.height_m());
  const dynamics::BodyBox box = dynamics::BoxOf(dimensions, settings);
  dynamics::Obstacle obstacle;
  obstacle.q_WO = Eigen::AngleAxisd(static_cast<double>(agent.heading_rad()), Eigen::Vector3d::UnitZ()) *
                  Eigen::AngleAxisd(static_cast<double>(agent.pitch_rad()), Eigen::Vector3d::UnitY()) *
                  Eigen::AngleAxisd(static_cast<double>(agent.roll_rad()), Eigen::Vector3d::UnitX());
  obstacle.v_WO_W = agent.speed_mps() * (obstacle.q_WO * Eigen::Vector3d::UnitX());
  obstacle.centre_W = Eigen::Vector3d(agent.position_x_m(), agent.position_y_m(), agent.position_z_m()) +
                      late_s * obstacle.v_WO_W + obstacle.q_WO * box.centre_B;
  obstacle.half_m = box.half_m;
  return obstacle;
}

}  // namespace

Collisions::Collisions(const dynamics::VehicleDimensions& dimensions, ObstacleMap world)
    : world_(std::move(world)), space_(dimensions, {}), reach_m_(dynamics::BoxOf(dimensions, {}).reach_m()) {}

base::Status Collisions::SeeTraffic(const dynamics::VehicleState& car, const lockstep::Inbox& inbox,
                                    const lockstep::StepInfo& step) {
  if (!inbox.Has(idl::topics::kTrafficState)) return {};
  for (const lockstep::Sample& sample : inbox.All(idl::topics::kTrafficState)) {
    Said& said = said_[sample.source()];
    if (said.payload != sample.payload) {
      auto state = idl::Decode<msg::TrafficState>(*sample.payload);
      if (!state) return state.error();
      said = {sample.payload, std::move(state).value()};
    }
    const double late_s = static_cast<double>(step.time_ns - sample.header.time_ns) * 1e-9;
    for (const msg::TrafficAgent& agent : said.state.agents()) {
      const double around = reach_m_ + static_cast<double>(agent.length_m()) + static_cast<double>(agent.width_m()) +
                            std::fabs(agent.speed_mps()) * late_s;
      if (std::hypot(agent.position_x_m() - car.p_WB_W.x(), agent.position_y_m() - car.p_WB_W.y()) > around) continue;
      obstacles_.push_back(BoxOf(agent, late_s));
      partners_.push_back({kAgent, sample.source(), agent.id()});
    }
  }
  return {};
}

base::Status Collisions::SeeCars(const dynamics::VehicleState& car, const lockstep::Inbox& inbox,
                                 const lockstep::StepInfo& step) {
  if (!inbox.Has(idl::topics::kVehicleState)) return {};
  for (const lockstep::Sample& sample : inbox.All(idl::topics::kVehicleState)) {
    const auto state = idl::Decode<msg::VehicleState>(*sample.payload);
    if (!state) return state.error();
    const dynamics::Obstacle box =
        BoxOf(state.value(), static_cast<double>(step.time_ns - sample.header.time_ns) * 1e-9);
    if ((box.centre_W - car.p_WB_W).norm() > reach_m_ + box.half_m.norm()) continue;
    obstacles_.push_back(box);
    partners_.push_back({kAgent, sample.source(), 0});
  }
  return {};
}

void Collisions::SeeWorld(const dynamics::VehicleState& car) {
  for (const std::uint32_t number : world_.Near(car.p_WB_W)) {
    obstacles_.push_back(world_.all()[number]);
    partners_.push_back({kInWorld, 0, number});
  }
}

msg::Contact Collisions::EventOf(const dynamics::Impact& impact, double dt_s) const {
  const Partner& partner = partners_[impact.id];
  const auto single = [](double value) { return static_cast<float>(value); };
  msg::Contact out;
  out.position_x_m(impact.point_W.x());
  out.position_y_m(impact.point_W.y());
  out.position_z_m(impact.point_W.z());
  out.impulse_x_newton_s(dt_s * impact.force_W.x());
  out.impulse_y_newton_s(dt_s * impact.force_W.y());
  out.impulse_z_newton_s(dt_s * impact.force_W.z());
  out.normal_x(single(impact.normal_W.x()));
  out.normal_y(single(impact.normal_W.y()));
  out.normal_z(single(impact.normal_W.z()));
  out.penetration_m(single(impact.depth_m));
  out.closing_speed_mps(single(impact.closing_mps));
  out.partner_kind(partner.kind);
  out.partner_source(partner.source);
  out.partner_id(partner.id);
  if (partner.kind == kInWorld) out.partner_name(world_.NameOf(partner.id));
  out.begins(std::ranges::find(touched_, partner.key()) == touched_.end() ? 1 : 0);
  return out;
}

base::Result<Collisions::Touched> Collisions::Find(const dynamics::VehicleState& car, const lockstep::Inbox& inbox,
                                                   const lockstep::StepInfo& step) {
  obstacles_.clear();
  partners_.clear();
  if (auto status = SeeTraffic(car, inbox, step); !status) return status.error();
  if (auto status = SeeCars(car, inbox, step); !status) return status.error();
  SeeWorld(car);
  for (std::size_t i = 0; i < obstacles_.size(); ++i) obstacles_[i].id = i;
  const std::vector<dynamics::Impact> impacts = space_.Touch(car, obstacles_);
  Touched touched;
  touched.push = dynamics::WrenchOf(impacts);
  std::vector<std::uint64_t> keys;
  for (const dynamics::Impact& impact : impacts) {
    msg::Contact event = EventOf(impact, step.dt_s);
    event.index(static_cast<std::uint32_t>(keys.size()));
    touched.event.contacts().push_back(std::move(event));
    keys.push_back(partners_[impact.id].key());
  }
  touched_ = std::move(keys);
  return touched;
}

void Collisions::Save(base::StateWriter& writer) const { writer.Put("touched", touched_); }
void Collisions::Restore(base::StateReader& reader) { reader.Get("touched", touched_); }

}  // namespace rodeira::nodes
