// SPDX-License-Identifier: Apache-2.0
#include "common/world/network/sign_limits.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "common/world/network/placing.hpp"
#include "common/world/network/sign_kinds.hpp"

namespace rodeira::network {
namespace {

constexpr double kKmh_mps = 1.0 / 3.6, kMph_mps = 1609.344 / 3600.0;
constexpr double kMaxSign_mps = 400.0 * kKmh_mps;

using Speed = std::optional<double>;

bool CountsMiles(const Signal& signal, std::string_view kind) {
  if (!signal.unit.empty()) return signal.unit == "mph";
  std::string country = signal.country;
  for (char& c : country) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return kind == "speed_limit_us" || country == "gb" || country == "gbr" || country == "uk" ||
         country == "united kingdom";
}

// A sign that limits the speed of a road, at its station.
struct Mark {
  double s_m = 0.0;
  std::string_view orientation;
  const std::vector<LaneValidity>* validity = nullptr;
  SignLimit limit;
};

class Spreading {
 public:
  explicit Spreading(const Network& network) : network_(network) { FindMarks(); }

  std::vector<std::vector<SignSpeed>> Run() {
    if (std::all_of(marks_.begin(), marks_.end(), [](const auto& marks) { return marks.empty(); })) return {};
    in_.resize(network_.LaneNumbers());
    std::set<LaneKey> waiting;
    for (const LaneKey& key : network_.Lanes()) {
      if (Carries(key) && !MarksOf(key).empty()) waiting.insert(key);
    }
    // A limit at a lane's beginning is only ever lowered, so this ends.
    while (!waiting.empty()) {
      const LaneKey key = *waiting.begin();
      waiting.erase(waiting.begin());
      for (const LaneKey& other : DependOn(key)) {
        const Speed speed = Incoming(other);
        if (speed == in_[network_.Number(other)]) continue;
        in_[network_.Number(other)] = speed;
        waiting.insert(other);
      }
    }
    std::vector<std::vector<SignSpeed>> speeds(network_.LaneNumbers());
    for (const LaneKey& key : network_.Lanes()) {
      if (Carries(key)) speeds[network_.Number(key)] = Records(key);
    }
    return speeds;
  }

 private:
  void FindMarks() {
    std::map<std::string_view, SignLimit> by_id;
    marks_.resize(network_.roads().size());
    for (std::size_t i = 0; i < marks_.size(); ++i) {
      for (const Signal& signal : network_.roads()[i].spec().signals) {
        const auto limit = SignLimitOf(signal);
        if (!limit) continue;
        by_id.insert_or_assign(signal.id, *limit);
        marks_[i].push_back({signal.s_m, signal.orientation, &signal.validity, *limit});
      }
    }
    if (by_id.empty()) return;
    for (std::size_t i = 0; i < marks_.size(); ++i) {
      for (const SignalReference& reference : network_.roads()[i].spec().signal_references) {
        const auto found = by_id.find(reference.id);
        if (found != by_id.end())
          marks_[i].push_back({reference.s_m, reference.orientation, &reference.validity, found->second});
      }
      std::stable_sort(marks_[i].begin(), marks_[i].end(), [](const Mark& a, const Mark& b) { return a.s_m < b.s_m; });
    }
  }

  bool Carries(const LaneKey& key) const {
    const Lane* lane = network_.Find(key);
    return lane != nullptr && key.lane != 0 && IsDrivable(lane->type);
  }
  bool Along(const LaneKey& key) const { return network_.Find(key)->direction >= 0; }

  // Of a lane, in the order in which its traffic passes them.
  std::vector<const Mark*> MarksOf(const LaneKey& key) const {
    const LaneSection& section = network_.Section(key);
    const bool last = key.section + 1 == network_.roads()[key.road].spec().sections.size();
    std::vector<const Mark*> own;
    for (const Mark& mark : marks_[key.road]) {
      const bool here = mark.s_m >= section.s_m && (mark.s_m < section.end_s_m || last);
      if (here && HoldsFor(key.lane, Along(key), mark.orientation, *mark.validity)) own.push_back(&mark);
    }
    if (!Along(key)) std::reverse(own.begin(), own.end());
    return own;
  }

  Speed Outgoing(const LaneKey& key) const {
    const auto marks = MarksOf(key);
    return marks.empty() ? in_[network_.Number(key)] : marks.back()->limit.speed_mps;
  }

  // Where a lane begins without another one before it: the lane beside, towards the centre first.
  std::optional<LaneKey> BesideAtBegin(const LaneKey& key) const {
    if (!network_.Predecessors(key).empty()) return std::nullopt;
    const int inward = key.lane > 0 ? -1 : 1;
    for (const int step : {inward, -inward}) {
      LaneKey beside{key.road, key.section, key.lane + step};
      for (; Carries(beside) && Along(beside) == Along(key); beside.lane += step) {
        if (!network_.Predecessors(beside).empty()) return beside;
      }
    }
    return std::nullopt;
  }

  Speed Incoming(const LaneKey& key) const {
    if (const auto beside = BesideAtBegin(key)) return in_[network_.Number(*beside)];
    if (!network_.roads()[key.road].spec().junction.empty() && !FromSameRoad(key)) return std::nullopt;
    Speed lowest;
    for (const LaneEnd& end : network_.Predecessors(key)) {
      if (!Carries(end.lane)) continue;
      const Speed speed = Outgoing(end.lane);
      if (speed && (!lowest || *speed < *lowest)) lowest = speed;
    }
    return lowest;
  }
  bool FromSameRoad(const LaneKey& key) const {
    const auto before = network_.Predecessors(key);
    return std::all_of(before.begin(), before.end(), [&](const LaneEnd& end) { return end.lane.road == key.road; });
  }

  // The lanes with a limit at their beginning that follows from a lane.
  std::vector<LaneKey> DependOn(const LaneKey& key) const {
    std::vector<LaneKey> lanes;
    for (const LaneEnd& end : network_.Successors(key)) {
      if (Carries(end.lane)) lanes.push_back(end.lane);
    }
    const LaneSection& section = network_.Section(key);
    const int low = -static_cast<int>(section.right.size()), high = static_cast<int>(section.left.size());
    for (int id = low; id <= high; ++id) {
      const LaneKey beside{key.road, key.section, id};
      if (id != key.lane && Carries(beside) && BesideAtBegin(beside) == key) lanes.push_back(beside);
    }
    return lanes;
  }

  std::vector<SignSpeed> Records(const LaneKey& key) const {
    const Speed in = in_[network_.Number(key)];
    const auto marks = MarksOf(key);
    if (!in && marks.empty()) return {};
    const double begin_m = network_.Section(key).s_m;
    std::vector<SignSpeed> records;
    if (Along(key)) {
      records.push_back({begin_m, in});
      for (const Mark* mark : marks) records.push_back({mark->s_m, mark->limit.speed_mps});
      return records;
    }
    records.push_back({begin_m, marks.empty() ? in : marks.back()->limit.speed_mps});
    for (std::size_t i = marks.size(); i-- > 0;)
      records.push_back({marks[i]->s_m, i == 0 ? in : marks[i - 1]->limit.speed_mps});
    return records;
  }

  const Network& network_;
  std::vector<std::vector<Mark>> marks_;  // by road, ascending
  std::vector<Speed> in_;                 // where a lane's traffic comes onto it, by the lane's number
};

}  // namespace

std::optional<SignLimit> SignLimitOf(const Signal& signal) {
  const auto kind = SignKindOf(signal);
  if (!kind) return std::nullopt;
  if (*kind == "end_of_speed_limit" || *kind == "end_of_restrictions") return SignLimit{};
  if (*kind != "speed_limit" && *kind != "speed_limit_us") return std::nullopt;
  const std::string number = SignNumberOf(signal);
  if (number.empty()) return std::nullopt;
  const bool has_value = signal.value && std::isfinite(*signal.value) && *signal.value > 0.0;
  const double value = has_value ? *signal.value : std::stod(number);
  const double unit_mps = has_value && signal.unit == "m/s" ? 1.0 : CountsMiles(signal, *kind) ? kMph_mps : kKmh_mps;
  const double speed_mps = value * unit_mps;
  if (!(speed_mps > 0.0 && speed_mps <= kMaxSign_mps)) return std::nullopt;
  return SignLimit{speed_mps};
}

std::vector<std::vector<SignSpeed>> SignSpeeds(const Network& network) { return Spreading(network).Run(); }

}  // namespace rodeira::network
