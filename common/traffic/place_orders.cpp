// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/place_orders.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "common/core/base/suggest.hpp"
#include "common/world/road/road_chains.hpp"

namespace rodeira::traffic {

void ApplyOrder(TrafficModel& model, std::uint32_t id, OrderKind kind, double value) {
  switch (kind) {
    case OrderKind::kBrake:
      model.Brake(id, value);
      return;
    case OrderKind::kSpeed:
      model.CapSpeed(id, value);
      return;
    case OrderKind::kRelease:
      model.Release(id);
      return;
    case OrderKind::kOvertake:
      model.CommandOvertake(id);
      return;
    case OrderKind::kChangeLane:
      model.CommandLaneChange(id, value > 0.0 ? 1 : -1);
      return;
  }
}

bool IsSound(OrderKind kind, double value) {
  switch (kind) {
    case OrderKind::kBrake:
    case OrderKind::kSpeed:
      return value > 0.0;
    case OrderKind::kRelease:
    case OrderKind::kOvertake:
      return true;
    case OrderKind::kChangeLane:
      return value == 1.0 || value == -1.0;
  }
  return false;
}

base::Result<PlaceOrder> PlaceOrders::At(const TrafficModel& model, std::string_view road, double s_m) {
  const network::Network& network = model.graph().network();
  const auto found = road::FindRoadOrChain(network, road);
  if (!found)
    return base::WrongInput(
        "world.unknown_road",
        fmt::format("there is no road '{}'{}", road, base::DidYouMean(std::string(road), road::NamesOfRoads(network))));
  if (!(s_m >= 0.0 && s_m <= found->length_m))
    return base::WrongInput(
        "traffic.off_the_road",
        fmt::format("the station {} m is not on the road '{}', which is {:.2f} m long", s_m, road, found->length_m));
  const auto [part, along_m] = found->At(network, s_m);
  PlaceOrder order;
  order.road = static_cast<std::uint32_t>(part - network.roads().data());
  order.s_m = along_m;
  return order;
}

std::optional<PlaceOrders::Seen> PlaceOrders::SeenAt(const TrafficModel& model, std::uint32_t id) {
  const Agent& agent = model.agent(id);
  if (!agent.on_road || agent.path.empty()) return std::nullopt;
  std::size_t i = agent.path.size() - 1;
  while (i > 0 && agent.path[i].begin_m > agent.o_m) --i;
  const lanes::Track& track = model.graph()[agent.path[i].track];
  const double length = model.graph().network().roads()[track.lane.road].length_m();
  return Seen{agent.trip, track.lane.road, track.curve.StationAt(agent.o_m - agent.path[i].zero_m),
              track.along ? length : 0.0, track.along ? 0.0 : length};
}

void PlaceOrders::Before(const TrafficModel& model) {
  seen_.clear();
  if (orders_.empty()) return;
  for (std::uint32_t id = 0; id < model.vehicles(); ++id) seen_.push_back(SeenAt(model, id));
}

void PlaceOrders::After(TrafficModel& model) {
  if (seen_.empty()) return;
  // From where to where it went on the order's road. A road that it has left it drove to its end, one that it has come
  // onto from its beginning.
  const auto passes = [&](const PlaceOrder& order, std::uint32_t id) {
    const auto& before = seen_[id];
    const auto now = SeenAt(model, id);
    if (!before || !now || before->trip != now->trip) return false;
    const auto between = [&](double from, double to) { return (from < order.s_m) != (to < order.s_m); };
    if (before->road == now->road) return before->road == order.road && between(before->s_m, now->s_m);
    return (before->road == order.road && between(before->s_m, before->ends_s_m)) ||
           (now->road == order.road && between(now->begins_s_m, now->s_m));
  };
  const auto done = [&](const PlaceOrder& order) {
    for (std::uint32_t id = 0; id < seen_.size(); ++id) {
      if ((order.recipients == PlaceOrder::Recipients::kOne && order.id != id) || !passes(order, id)) continue;
      ApplyOrder(model, id, order.kind, order.value);
      if (order.recipients != PlaceOrder::Recipients::kAll) return true;
    }
    return false;
  };
  std::vector<PlaceOrder> left;
  for (const PlaceOrder& order : orders_) {
    if (!done(order)) left.push_back(order);
  }
  orders_ = std::move(left);
}

void PlaceOrders::Save(base::StateWriter& writer) const {
  std::vector<std::uint32_t> words;
  std::vector<double> numbers;
  for (const PlaceOrder& order : orders_) {
    words.insert(words.end(), {static_cast<std::uint32_t>(order.kind), order.road,
                               static_cast<std::uint32_t>(order.recipients), order.id});
    numbers.insert(numbers.end(), {order.value, order.s_m});
  }
  writer.Put("orders", words);
  writer.Put("orders_at", numbers);
}

void PlaceOrders::Restore(base::StateReader& reader, const TrafficModel& model) {
  std::vector<std::uint32_t> words;
  std::vector<double> numbers;
  reader.Get("orders", words);
  reader.Get("orders_at", numbers);
  orders_.clear();
  seen_.clear();
  for (std::size_t i = 0; 4 * i + 3 < words.size() && 2 * i + 1 < numbers.size(); ++i) {
    const std::uint32_t* word = &words[4 * i];
    const bool sound = word[0] <= static_cast<std::uint32_t>(OrderKind::kChangeLane) &&
                       word[1] < model.graph().network().roads().size() &&
                       word[2] <= static_cast<std::uint32_t>(PlaceOrder::Recipients::kAll);
    if (!sound || !IsSound(static_cast<OrderKind>(word[0]), numbers[2 * i])) continue;
    orders_.push_back({static_cast<OrderKind>(word[0]), numbers[2 * i], word[1], numbers[2 * i + 1],
                       static_cast<PlaceOrder::Recipients>(word[2]), word[3]});
  }
}

}  // namespace rodeira::traffic
