// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/replay/branch_ground.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "common/core/base/hash.hpp"
#include "common/world/network/network.hpp"
#include "common/world/road/world.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "launch/rodeira/commands/measured_recording.hpp"

namespace rodeira::cli {
namespace {

constexpr double kMaxStep_m = 0.3;  // between both grounds: a car's suspension takes it
constexpr double kSameLength_m = 0.001;

struct VehiclePlace {
  std::string name;
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;
};

// Every car and traffic vehicle at a step at which all nodes are activated.
base::Result<std::vector<VehiclePlace>> VehiclesAt(const replay::RecordedRun& parent, lockstep::Step at) {
  std::vector<VehiclePlace> vehicles;
  auto samples = parent.Samples(at);
  for (;;) {
    const auto next = samples.Next();
    if (!next) return next.error();
    if (!next.value() || next.value()->valid() > at) return vehicles;
    const lockstep::Sample& sample = *next.value();
    const auto& source = parent.roster().source(sample.source());
    if (source.topic == idl::topics::kVehicleState) {
      const auto car = idl::Decode<msg::VehicleState>(*sample.payload);
      if (!car) return car.error();
      const auto& p = car.value().position_w_m();
      vehicles.push_back({fmt::format("node '{}'", parent.roster().node(source.node).name), p.x(), p.y(), p.z()});
    } else if (source.topic == idl::topics::kTrafficState) {
      const auto traffic = idl::Decode<msg::TrafficState>(*sample.payload);
      if (!traffic) return traffic.error();
      for (const msg::TrafficAgent& agent : traffic.value().agents())
        vehicles.push_back({fmt::format("traffic vehicle {}", agent.id()), agent.position_x_m(), agent.position_y_m(),
                            agent.position_z_m()});
    }
  }
}

bool HasRoadAt(const road::World& world, const VehiclePlace& vehicle, double z_m) {
  if (world.network() == nullptr) return false;
  const auto place = world.network()->Locate(vehicle.x_m, vehicle.y_m, z_m);
  return place && place->distance_m == 0.0;
}

// Empty: the vehicle can go on there.
std::string WhyNotOn(const road::World& world, const road::World& before, const VehiclePlace& vehicle) {
  const road::SurfacePoint now = world.At(vehicle.x_m, vehicle.y_m, vehicle.z_m);
  if (!now.inside) return "there is no ground";
  const road::SurfacePoint was = before.At(vehicle.x_m, vehicle.y_m, vehicle.z_m);
  if (HasRoadAt(before, vehicle, was.z_m) && !HasRoadAt(world, vehicle, now.z_m)) return "there is no road";
  const double step_m = now.z_m - was.z_m;
  if (!was.inside || std::fabs(step_m) <= kMaxStep_m) return "";
  return fmt::format("the ground is {:.1f} m {} than in the parent's world", std::fabs(step_m),
                     step_m > 0.0 ? "higher" : "lower");
}

// Empty: the same roads, in the same order.
std::string OtherRoads(const network::Network& now, const network::Network& before) {
  if (now.roads().size() != before.roads().size())
    return fmt::format("it has {} roads, the parent's has {}", now.roads().size(), before.roads().size());
  for (std::size_t i = 0; i < now.roads().size(); ++i) {
    const network::Road &is = now.roads()[i], &was = before.roads()[i];
    if (std::fabs(is.length_m() - was.length_m()) > kSameLength_m || is.spec().id != was.spec().id)
      return fmt::format("its road '{}' is {:.1f} m long, in the parent's place is road '{}' of {:.1f} m", is.spec().id,
                         is.length_m(), was.spec().id, was.length_m());
  }
  return "";
}

}  // namespace

base::Status CheckGroundOfBranch(const replay::RecordedRun& parent, const replay::RecordedRun& changed,
                                 const launch::Overrides& changes, lockstep::Step at) {
  const bool names_world = std::ranges::any_of(changes, [](const auto& change) { return change.first == "world"; });
  if (!names_world || changed.launch().world().empty() || parent.launch().world().empty()) return {};
  const auto world = road::World::Load(changed.launch().world());
  if (!world) return changed.Named(world.error());
  if (base::Hex(world.value()->content_hash()) == parent.world_hash()) return {};
  const auto before = EmbeddedWorld(parent);
  if (!before) return before.error();
  const bool has_roads = before.value()->network() != nullptr;
  const auto refused = [&](const std::string& why) {
    return base::WrongInput(
        "replay.wrong_world",
        fmt::format("{}; a branch needs {}", why,
                    has_roads ? "a world with the parent's roads" : "ground of the parent's height below each vehicle"),
        changed.launch().world().string());
  };
  const auto vehicles = VehiclesAt(parent, at);
  if (!vehicles) return vehicles.error();
  for (const VehiclePlace& vehicle : vehicles.value()) {
    const std::string why = WhyNotOn(*world.value(), *before.value(), vehicle);
    if (!why.empty())
      return refused(fmt::format("{} is at ({:.1f}, {:.1f}), where {}", vehicle.name, vehicle.x_m, vehicle.y_m, why));
  }
  const auto& nodes = parent.launch().nodes();
  const bool has_traffic = std::ranges::any_of(nodes, [](const auto& node) { return node.kind->name == "traffic"; });
  if (!has_traffic || world.value()->network() == nullptr || before.value()->network() == nullptr) return {};
  const std::string roads = OtherRoads(*world.value()->network(), *before.value()->network());
  return roads.empty() ? base::Status() : refused(roads);
}

}  // namespace rodeira::cli
