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

// What an agent is told: the deceleration to brake by, the speed to keep to, to forget all, to overtake, the side to
// change lanes to.
enum class OrderKind : std::uint8_t { kBrake = 0, kSpeed = 1, kRelease = 2, kOvertake = 3, kChangeLane = 4 };
// Whether that may be told with this value: above 0 of braking and speed, 1 (left) or -1 (right) of a side.
bool IsSound(OrderKind kind, double value);

// Told at once.
void ApplyOrder(TrafficModel& model, std::uint32_t id, OrderKind kind, double value);

// What agents are told when they come to a place: as soon as the middle of one has passed a station of a road,
// whichever way it drives there.
struct PlaceOrder {
  OrderKind kind = OrderKind::kBrake;
  double value = 0.0;      // m/s², m/s, or a side
  std::uint32_t road = 0;  // index into the network's roads
  double s_m = 0.0;        // of the road's axis
  enum class Whom : std::uint8_t { kOne = 0, kNext = 1, kAll = 2 } whom = Whom::kNext;
  std::uint32_t id = 0;  // kOne: this agent, when it passes next
};

// Orders that wait for a vehicle to pass. Those for one agent, and for the next one, end when they have been obeyed;
// those for all go on.
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
