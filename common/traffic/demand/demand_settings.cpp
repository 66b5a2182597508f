// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/demand/demand_settings.hpp"

#include <fmt/format.h>

#include "common/core/base/suggest.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kMaxAnHour = 1e5;
constexpr double kLongest_s = 1e9;

const std::vector<std::string> kRates{"vehicles_per_h", "by_hour", "every_s"};
constexpr const char* kOneRate = "one of 'vehicles_per_h', 'by_hour' and 'every_s' was expected";

// "'a', 'b' and 'c'"
std::string Listed(const std::vector<std::string>& keys) {
  std::string text;
  for (std::size_t i = 0; i < keys.size(); ++i)
    text += (i == 0 ? "'" : i + 1 == keys.size() ? " and '" : ", '") + keys[i] + "'";
  return text;
}

// A flow says in one way how many come.
void CheckRates(const config::Map& map) {
  std::vector<std::string> found;
  for (const std::string& key : kRates) {
    if (map.Has(key)) found.push_back(key);
  }
  if (found.size() == 1) return;
  for (const std::string& key : found) map.IgnoreKey(key);
  if (found.size() > 1)
    return map.Problem(found[1], "config.conflicting_keys", fmt::format("{} were found; {}", Listed(found), kOneRate));
  const std::vector<std::string> keys = map.Keys();
  for (const std::string& key : keys) {
    const std::string meant = base::NearestName(key, kRates);
    if (!meant.empty())
      return map.Problem(key, "config.conflicting_keys",
                         fmt::format("'{}' was found; {}; did you mean '{}'?", key, kOneRate, meant));
  }
  map.Problem("", "config.conflicting_keys",
              keys.empty() ? kOneRate
                           : fmt::format("{} {} found; {}", Listed(keys), keys.size() == 1 ? "was" : "were", kOneRate));
}

void ReadRate(const config::Map& map, FlowSettings& flow) {
  CheckRates(map);
  if (map.Has("every_s")) {
    const std::vector<double> gaps = map.Numbers("every_s", {0.1, 1e6});
    if (gaps.size() != 2 || gaps[0] > gaps[1])
      map.Problem("every_s", fmt::format("[{}] was found; the shortest and the longest gap, as [3, 8], were expected",
                                         fmt::join(gaps, ", ")));
    else
      flow.least_gap_s = gaps[0], flow.most_gap_s = gaps[1];
    flow.arrivals = Arrivals::kUniform;
    return;
  }
  flow.per_h = map.Has("by_hour") ? map.Numbers("by_hour", {0.0, kMaxAnHour})
                                  : std::vector<double>{map.Number("vehicles_per_h", {0.0, kMaxAnHour}, 0.0)};
  if (flow.per_h.empty()) map.Problem("by_hour", "config.too_few", "a number for each hour was expected");
  if (map.Choice("arrivals", {"poisson", "even"}, "poisson") == "even") flow.arrivals = Arrivals::kEven;
}

FlowSettings ReadFlow(const config::Map& map) {
  FlowSettings flow;
  flow.place = map.Place();
  flow.lane = map.Text("lane", "");
  flow.route = map.Text("route", "");
  ReadRate(map, flow);
  flow.from_s = map.Number("from_s", {0.0, kLongest_s}, flow.from_s);
  flow.to_s = map.Number("to_s", {0.0, kLongest_s}, flow.to_s);
  if (flow.to_s < flow.from_s) map.Problem("to_s", "config.wrong_order", "'to_s' is before 'from_s'");
  if (map.Has("mix")) flow.mix = ReadMix(map.Child("mix"));
  return flow;
}

}  // namespace

DemandSettings ReadDemand(const config::Map& map) {
  DemandSettings demand;
  const config::Map routes = map.OptionalChild("routes");
  for (const std::string& name : routes.Keys()) {
    const config::List ways = routes.Items(name);
    RouteSettings route{name, {}, routes.Place(name)};
    for (std::size_t i = 0; i < ways.size(); ++i) route.ways.push_back(ways.Text(i));
    if (route.ways.empty())
      routes.Problem(name, "config.too_few", "a route without any road was found; a list of roads was expected");
    demand.routes.push_back(std::move(route));
  }
  const config::List flows = map.OptionalItems("flows");
  for (std::size_t i = 0; i < flows.size(); ++i) demand.flows.push_back(ReadFlow(flows.At(i)));
  const config::List turns = map.OptionalItems("turns");
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const config::Map turn = turns.At(i);
    TurnSettings read{turn.Text("lane"), {}, turn.Place()};
    const config::Map shares = turn.Child("shares");
    for (const std::string& way : shares.Keys()) read.shares.emplace_back(way, shares.Number(way, {0.0, 1e6}));
    demand.turns.push_back(std::move(read));
  }
  return demand;
}

}  // namespace rodeira::traffic
