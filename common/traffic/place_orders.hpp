// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/core/base/state.hpp"
#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {

// A command to a vehicle: brake with a deceleration, keep a speed, end all commands, overtake, change lanes to a
// side.
enum class OrderKind : std::uint8_t { kBrake = 0, kSpeed = 1, kRelease = 2, kOvertake = 3, kChangeLane = 4 };
// Whether the value is valid for the command: above 0 for braking and speed, 1 (left) or -1 (right) for a side.
bool IsSound(OrderKind kind, double value);

// Applies a command to a vehicle at once.
void ApplyOrder(TrafficModel& model, std::uint32_t id, OrderKind kind, double value);

// A command that vehicles get at a place: as soon as a vehicle's middle has passed a station of a road, in either
// direction.
struct PlaceOrder {
  OrderKind kind = OrderKind::kBrake;
  double value = 0.0;      // m/s², m/s, or a side
  std::uint32_t road = 0;  // index into the network's roads
  double s_m = 0.0;        // of the road's axis
  enum class Recipients : std::uint8_t { kOne = 0, kNext = 1, kAll = 2 } recipients = Recipients::kNext;
  std::uint32_t id = 0;  // kOne: this agent, when it passes next
};

// Commands that wait for a vehicle to pass. Commands for one vehicle, or for the next one, end when they have been
// applied; commands for all vehicles persist.
class PlaceOrders {
 public:
  // Wrong input with the nearest name where the network has no such road, or the road is shorter.
  static base::Result<PlaceOrder> At(const TrafficModel& model, std::string_view road, double s_m);
  // It holds from the next step on.
  void Add(const PlaceOrder& order) { orders_.push_back(order); }

  // Before the model's step, and after it: a vehicle that has passed in between is told.
  void Before(const TrafficModel& model);
  void After(TrafficModel& model);

  void Save(base::StateWriter& writer) const;
  // Nothing that is not the model's is kept.
  void Restore(base::StateReader& reader, const TrafficModel& model);

 private:
  struct Seen {
    std::uint32_t trip = 0, road = 0;
    double s_m = 0.0, ends_s_m = 0.0;  // of its middle; where it leaves the road
    double begins_s_m = 0.0;           // and where it came onto it
  };
  static std::optional<Seen> SeenAt(const TrafficModel& model, std::uint32_t id);

  std::vector<PlaceOrder> orders_;
  std::vector<std::optional<Seen>> seen_;  // by agent; empty where none is waited for
};

}  // namespace rodeira::traffic
