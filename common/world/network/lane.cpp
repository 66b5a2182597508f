// SPDX-License-Identifier: Apache-2.0
#include "common/world/network/lane.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "common/world/network/lane_edge.hpp"

namespace rodeira::network {
namespace {

constexpr std::array<std::pair<LaneType, std::string_view>, 31> kNames = {{
    {LaneType::kNone, "none"},
    {LaneType::kDriving, "driving"},
    {LaneType::kStop, "stop"},
    {LaneType::kShoulder, "shoulder"},
    {LaneType::kBiking, "biking"},
    {LaneType::kSidewalk, "sidewalk"},
    {LaneType::kWalking, "walking"},
    {LaneType::kBorder, "border"},
    {LaneType::kRestricted, "restricted"},
    {LaneType::kParking, "parking"},
    {LaneType::kBidirectional, "bidirectional"},
    {LaneType::kMedian, "median"},
    {LaneType::kCurb, "curb"},
    {LaneType::kEntry, "entry"},
    {LaneType::kExit, "exit"},
    {LaneType::kOnRamp, "onRamp"},
    {LaneType::kOffRamp, "offRamp"},
    {LaneType::kConnectingRamp, "connectingRamp"},
    {LaneType::kSlipLane, "slipLane"},
    {LaneType::kShared, "shared"},
    {LaneType::kTram, "tram"},
    {LaneType::kRail, "rail"},
    {LaneType::kBus, "bus"},
    {LaneType::kTaxi, "taxi"},
    {LaneType::kHov, "HOV"},
    {LaneType::kMwyEntry, "mwyEntry"},
    {LaneType::kMwyExit, "mwyExit"},
    {LaneType::kRoadWorks, "roadWorks"},
    {LaneType::kSpecial1, "special1"},
    {LaneType::kSpecial2, "special2"},
    {LaneType::kSpecial3, "special3"},
}};

// Finds the records in force at one s, table after table. The tables of lanes side by side often have their records at
// the same places, and one s is often close to the one before: a record is looked for first where the last was found.
class RecordFinder {
 public:
  explicit RecordFinder(double s_m) : s_m_(s_m) {}

  // Null where the table is empty.
  const geometry::Cubic* In(const geometry::CubicTable& table) {
    const std::vector<geometry::Cubic>& records = table.records();
    if (records.empty()) return nullptr;
    if (!InForce(records, found_)) found_ = static_cast<std::size_t>(&table.At(s_m_) - records.data());
    return &records[found_];
  }

 private:
  bool InForce(const std::vector<geometry::Cubic>& records, std::size_t index) const {
    return index < records.size() && (index == 0 || records[index].from <= s_m_) &&
           (index + 1 == records.size() || s_m_ < records[index + 1].from);
  }

  static thread_local std::size_t found_;  // where to look first; says nothing of the result
  const double s_m_;
};
thread_local std::size_t RecordFinder::found_ = 0;

// A lane's width at s, or where it has a border instead that.
const geometry::CubicTable& EdgeOf(const Lane& lane) { return lane.bordered() ? lane.border : lane.width; }

geometry::CubicPoint OuterEdge(const Lane& lane, double sign, const geometry::CubicPoint& inner, double s_m,
                               RecordFinder& finder) {
  const geometry::Cubic* record = finder.In(EdgeOf(lane));
  if (record == nullptr) return OuterEdgeBy(lane.bordered(), {}, sign, inner);
  return OuterEdgeBy(lane.bordered(), {record->Value(s_m), record->Slope(s_m), 0.0}, sign, inner);
}

}  // namespace

std::string_view LaneTypeName(LaneType type) {
  for (const auto& [value, name] : kNames) {
    if (value == type) return name;
  }
  return "none";
}

std::optional<LaneType> LaneTypeByName(std::string_view name) {
  for (const auto& [value, known] : kNames) {
    if (known == name) return value;
  }
  return std::nullopt;
}

std::vector<std::string> LaneTypeNames() {
  std::vector<std::string> names;
  for (const auto& [value, name] : kNames) names.emplace_back(name);
  return names;
}

bool IsDrivable(LaneType type) {
  switch (type) {
    case LaneType::kDriving:
    case LaneType::kBidirectional:
    case LaneType::kEntry:
    case LaneType::kExit:
    case LaneType::kOnRamp:
    case LaneType::kOffRamp:
    case LaneType::kConnectingRamp:
    case LaneType::kSlipLane:
    case LaneType::kShared:
    case LaneType::kBus:
    case LaneType::kTaxi:
    case LaneType::kHov:
    case LaneType::kMwyEntry:
    case LaneType::kMwyExit:
      return true;
    default:
      return false;
  }
}

bool OpenToCars(const Lane& lane) {
  return std::none_of(lane.access.begin(), lane.access.end(), [](const LaneAccess& access) {
    const bool names_cars =
        std::any_of(access.restrictions.begin(), access.restrictions.end(), [](const std::string& participant) {
          return participant == "passengerCar" || participant == "autonomousTraffic";
        });
    return (access.rule == "deny" && names_cars) ||
           (access.rule == "allow" && !access.restrictions.empty() && !names_cars);
  });
}

const Lane* LaneSection::Find(int id) const {
  if (id == 0) return &centre;
  const std::vector<Lane>& side = id > 0 ? left : right;
  const auto index = static_cast<std::size_t>(std::abs(static_cast<long>(id))) - 1;
  return index < side.size() ? &side[index] : nullptr;
}

std::optional<LaneSpan> LaneSection::Span(int id, const geometry::CubicPoint& centre_t, double at_s_m) const {
  if (id == 0 || Find(id) == nullptr) return std::nullopt;
  const double sign = id > 0 ? 1.0 : -1.0;
  geometry::CubicPoint inner = centre_t;
  RecordFinder finder(at_s_m);
  for (const Lane& lane : id > 0 ? left : right) {
    const geometry::CubicPoint outer = OuterEdge(lane, sign, inner, at_s_m, finder);
    if (lane.id == id) return LaneSpan{&lane, inner.value, outer.value, inner.slope, outer.slope};
    inner = outer;
  }
  return std::nullopt;
}

LaneSpan LaneSection::At(double t_m, const geometry::CubicPoint& centre_t, double at_s_m, double& outside_m) const {
  const double sign = t_m >= centre_t.value ? 1.0 : -1.0;
  geometry::CubicPoint inner = centre_t;
  LaneSpan span;
  RecordFinder finder(at_s_m);
  for (const Lane& lane : sign > 0.0 ? left : right) {
    const geometry::CubicPoint outer = OuterEdge(lane, sign, inner, at_s_m, finder);
    span = {&lane, inner.value, outer.value, inner.slope, outer.slope};
    // A lane without width holds nothing; t on the centre belongs to the first that has one.
    if (sign * (outer.value - t_m) >= 0.0 && outer.value != inner.value) {
      outside_m = 0.0;
      return span;
    }
    inner = outer;
  }
  outside_m = std::max(0.0, sign * (t_m - inner.value));
  if (outside_m == 0.0 && span.lane == nullptr && sign > 0.0 && !right.empty())
    return At(std::nextafter(t_m, t_m - 1.0), centre_t, at_s_m, outside_m);
  return span;
}

void LaneSection::Bounds(const geometry::CubicTable& centre_t, double low_s_m, double high_s_m, double& right_t_m,
                         double& left_t_m) const {
  double low, high;
  centre_t.Bounds(low_s_m, high_s_m, low, high);
  right_t_m = low;
  left_t_m = high;
  for (const std::vector<Lane>* side : {&left, &right}) {
    const bool is_left = side == &left;
    double edge = is_left ? high : low;
    RecordFinder finder(low_s_m);
    for (const Lane& lane : *side) {
      double smallest, largest;
      if (low_s_m == high_s_m) {
        const geometry::Cubic* record = finder.In(EdgeOf(lane));
        smallest = largest = record == nullptr ? 0.0 : record->Value(low_s_m);
      } else {
        EdgeOf(lane).Bounds(low_s_m, high_s_m, smallest, largest);
      }
      if (lane.bordered())
        edge = is_left ? std::max(edge, largest) : std::min(edge, smallest);
      else
        edge += (is_left ? 1.0 : -1.0) * std::max(0.0, largest);
    }
    (is_left ? left_t_m : right_t_m) = edge;
  }
}

}  // namespace rodeira::network
