// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/demand/demand_settings.hpp"

#include <fmt/format.h>

#include "common/core/base/suggest.hpp"
#include "common/core/config/declared.hpp"
#include "common/traffic/demand/demand_schema.hpp"

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

void ReadRate(const config::DeclaredMap& declared, FlowSettings& flow) {
  const config::Map& map = declared.map();
  CheckRates(map);
  if (map.Has("every_s")) {
    const std::vector<double> gaps = declared.Numbers("every_s");
    if (gaps.size() != 2 || gaps[0] > gaps[1])
      map.Problem("every_s",
                  fmt::format("'every_s' is [{}]; the shortest and the longest gap, as [3, 8], were expected",
                              fmt::join(gaps, ", ")));
    else
      flow.least_gap_s = gaps[0], flow.most_gap_s = gaps[1];
    flow.arrivals = Arrivals::kUniform;
    return;
  }
  flow.per_h =
      map.Has("by_hour") ? declared.Numbers("by_hour") : std::vector<double>{declared.Number("vehicles_per_h", 0.0)};
  if (flow.per_h.empty()) map.Problem("by_hour", "config.too_few", "a number for each hour was expected");
  if (declared.Word("arrivals") == "even") flow.arrivals = Arrivals::kEven;
}

std::vector<config::Key> FlowKeys() {
  const FlowSettings usual;
  const std::string one = "or another rate";
  return {
      config::ComputedTextKey("lane", "a random entry", "main:-1", "ROAD:LANE where the vehicles enter."),
      config::ComputedTextKey("route", "by `turns`, else random", "through", "Name of a route."),
      config::ComputedNumberKey("vehicles_per_h", {0.0, kMaxAnHour}, one, "Vehicles an hour."),
      config::WithDefaultNote(one, config::ListKey("by_hour", config::NumberItem({0.0, kMaxAnHour}),
                                                   "Vehicles in each hour from `from_s` on; the last goes on.")),
      config::WithDefaultNote(one, config::Counted(2, 2,
                                                   config::ListKey("every_s", config::NumberItem({0.1, 1e6}),
                                                                   "Shortest and longest gap; drawn evenly between."))),
      config::WordKey("arrivals", {"poisson", "even"}, "poisson",
                      "Gaps of a rate an hour; `even` begins after half a gap."),
      config::NumberKey("from_s", {0.0, kLongest_s}, usual.from_s, "Begin of the flow."),
      config::NumberKey("to_s", {0.0, kLongest_s}, usual.to_s, "End of the flow; not before the begin."),
      config::MappingKey("mix", MixKeys(), "Kinds of vehicles of this flow.")};
}

FlowSettings ReadFlow(const config::DeclaredMap& declared) {
  const config::Map& map = declared.map();
  FlowSettings flow;
  flow.place = map.Place();
  flow.lane = declared.Text("lane", "");
  flow.route = declared.Text("route", "");
  ReadRate(declared, flow);
  flow.from_s = declared.Number("from_s");
  flow.to_s = declared.Number("to_s");
  if (flow.to_s < flow.from_s) map.Problem("to_s", "config.wrong_order", "'to_s' is before 'from_s'");
  if (map.Has("mix")) flow.mix = ReadMix(declared.MapWith("mix").Child("mix"));
  return flow;
}

}  // namespace

const std::vector<config::Key>& DemandKeys() {
  static const std::vector<config::Key> keys{
      config::NamedValueKey("routes", config::ListKey("", config::TextItem("main"), ""),
                            "Roads, or lanes as ROAD:LANE, that are passed in this order."),
      config::ListKey("flows", FlowKeys(), "Vehicles that enter."),
      config::ListKey("turns",
                      {config::RequiredTextKey("lane", "main:-1", "ROAD:LANE that vehicles without a route leave."),
                       config::Required(config::NamedValueKey("shares", config::NumberItem({0.0, 1e6}),
                                                              "Weight of the road or lane of this name."))},
                      "Where vehicles without a route go on.")};
  return keys;
}

DemandSettings ReadDemand(const config::Map& map) {
  DemandSettings demand;
  const config::DeclaredMap declared(map, DemandKeys());
  const config::Map routes = declared.MapWith("routes").OptionalChild("routes");
  for (const std::string& name : routes.Keys()) {
    const config::List ways = routes.Items(name);
    RouteSettings route{name, {}, routes.Place(name)};
    for (std::size_t i = 0; i < ways.size(); ++i) route.ways.push_back(ways.Text(i));
    if (route.ways.empty())
      routes.Problem(name, "config.too_few", "a route without any road was found; a list of roads was expected");
    demand.routes.push_back(std::move(route));
  }
  const config::DeclaredList flows = declared.Items("flows");
  for (std::size_t i = 0; i < flows.size(); ++i) demand.flows.push_back(ReadFlow(flows.At(i)));
  const config::DeclaredList turns = declared.Items("turns");
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const config::DeclaredMap turn = turns.At(i);
    TurnSettings read{turn.Text("lane"), {}, turn.map().Place()};
    const config::Map shares = turn.MapWith("shares").Child("shares");
    for (const std::string& way : shares.Keys()) read.shares.emplace_back(way, shares.Number(way, {0.0, 1e6}));
    demand.turns.push_back(std::move(read));
  }
  return demand;
}

}  // namespace rodeira::traffic
