// SPDX-License-Identifier: Apache-2.0
#include "common/world/sumo/lane_joints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/world/sumo/road_edges.hpp"
#include "common/world/sumo/signals.hpp"

namespace rodeira::sumo {
namespace {

constexpr double kMeets_m = 0.05;
constexpr double kLengthPerMetre = 6.0, kShortest_m = 5.0;

// A width, or an offset, that goes from one value to another with no slope at either end.
std::string Ease(double from_m, double to_m, double length_m, const char* station, double s_m) {
  const double d = to_m - from_m;
  return fmt::format("{}=\"{:.9g}\" a=\"{:.9g}\" b=\"0\" c=\"{:.9g}\" d=\"{:.9g}\"", station, s_m, from_m,
                     3.0 * d / (length_m * length_m), -2.0 * d / (length_m * length_m * length_m));
}

struct Taper {
  double width_m = 0.0, length_m = 0.0;
};

using LaneKey = std::pair<std::string, int>;  // the id of a road outside of junctions, and of a lane

struct Road {
  pugi::xml_node node;
  std::string id;
  std::map<int, pugi::xml_node> lanes;
  std::map<int, double> width_m;  // as netconvert draws them

  explicit Road(const pugi::xml_node& road) : node(road), id(road.attribute("id").value()) {
    for (const pugi::xml_node& lane : RightLanes(road)) {
      lanes[lane.attribute("id").as_int()] = lane;
      width_m[lane.attribute("id").as_int()] = WidthOf(lane);
    }
  }
  double length_m() const { return LengthOf(node); }
  // From the reference line to a lane's left edge.
  double LeftOf(int lane) const {
    double left_m = 0.0;
    for (const auto& [id_of, width] : width_m) left_m += id_of > lane ? width : 0.0;
    return left_m;
  }
};

struct Way {
  const Road *way, *from, *to;
  struct Pair {
    int from, on, to;
  };
  std::vector<Pair> lanes;  // from the left

  // How far lanes lie aside where the leftmost ones meet.
  double Aside() const {
    double most_m = 0.0;
    for (const Pair& pair : lanes) {
      const double left_m = from->LeftOf(pair.from) - from->LeftOf(lanes.front().from) - to->LeftOf(pair.to) +
                            to->LeftOf(lanes.front().to);
      const double right_m = left_m + from->width_m.at(pair.from) - to->width_m.at(pair.to);
      most_m = std::max({most_m, std::fabs(left_m), std::fabs(right_m)});
    }
    return most_m;
  }
};

class Fitting {
 public:
  explicit Fitting(const pugi::xml_node& drive) {
    for (const pugi::xml_node& road : drive.children("road")) roads_.emplace(road.attribute("id").value(), Road(road));
    for (const pugi::xml_node& road : drive.children("road")) AddWay(road);
  }

  std::size_t Fit() {
    std::size_t fitted = 0;
    for (const Way& way : ways_) {
      const double aside_m = way.Aside();
      if (aside_m > kMeets_m && Choose(way, std::max(kShortest_m, kLengthPerMetre * aside_m))) ++fitted;
    }
    if (fitted == 0) return 0;
    for (const auto& [id, road] : roads_) {
      for (const auto& [lane, node] : road.lanes) WriteTapers(road, lane);
    }
    for (const Way& way : ways_) WriteWay(way);
    return fitted;
  }

 private:
  void AddWay(const pugi::xml_node& node) {
    if (std::string_view(node.attribute("junction").value()) == "-1") return;
    const pugi::xml_node link = node.child("link");
    const auto from = roads_.find(link.child("predecessor").attribute("elementId").value());
    const auto to = roads_.find(link.child("successor").attribute("elementId").value());
    if (from == roads_.end() || to == roads_.end()) return;
    Way way{&roads_.at(node.attribute("id").value()), &from->second, &to->second, {}};
    for (auto lane = way.way->lanes.rbegin(); lane != way.way->lanes.rend(); ++lane) {
      const pugi::xml_node links = lane->second.child("link");
      const int before = links.child("predecessor").attribute("id").as_int();
      const int after = links.child("successor").attribute("id").as_int();
      if (!way.from->lanes.contains(before) || !way.to->lanes.contains(after)) return;
      way.lanes.push_back({before, lane->first, after});
    }
    if (!way.lanes.empty()) ways_.push_back(std::move(way));
  }

  // Which of both roads changes its widths. An end of a lane is changed once.
  bool Choose(const Way& way, double length_m) {
    const auto none = [](const std::map<LaneKey, Taper>& tapers, const Road& road, auto lane_of, const Way& of) {
      return std::none_of(of.lanes.begin(), of.lanes.end(), [&](const Way::Pair& pair) {
        return tapers.contains({road.id, lane_of(pair)});
      });
    };
    const auto from_of = [](const Way::Pair& pair) { return pair.from; };
    const auto to_of = [](const Way::Pair& pair) { return pair.to; };
    const double before_m = way.from->length_m(), behind_m = way.to->length_m();
    const bool behind = none(at_begin_, *way.to, to_of, way), before = none(at_end_, *way.from, from_of, way);
    if (behind && (behind_m >= length_m || behind_m >= before_m || !before)) {
      for (const Way::Pair& pair : way.lanes)
        at_begin_[{way.to->id, pair.to}] = {way.from->width_m.at(pair.from), std::min(length_m, behind_m)};
      return true;
    }
    if (!before) return false;
    for (const Way::Pair& pair : way.lanes)
      at_end_[{way.from->id, pair.from}] = {way.to->width_m.at(pair.to), std::min(length_m, before_m)};
    return true;
  }

  double WidthAt(const std::map<LaneKey, Taper>& tapers, const Road& road, int lane) const {
    const auto taper = tapers.find({road.id, lane});
    return taper == tapers.end() ? road.width_m.at(lane) : taper->second.width_m;
  }
  // How far the left edge of a lane is moved to the left at an end of its road.
  double Moved(const std::map<LaneKey, Taper>& tapers, const Road& road, int lane) const {
    double moved_m = 0.0;
    for (const auto& [id, width_m] : road.width_m) moved_m += id > lane ? width_m - WidthAt(tapers, road, id) : 0.0;
    return moved_m;
  }

  static void PutWidths(pugi::xml_node lane, const std::vector<std::string>& records) {
    pugi::xml_node at = lane.child("width");
    for (const std::string& record : records) {
      pugi::xml_document piece;
      piece.load_string(("<width " + record + "/>").c_str());
      lane.insert_copy_before(piece.first_child(), at);
    }
    lane.remove_child(at);
  }

  void WriteTapers(const Road& road, int lane) const {
    const auto begin = at_begin_.find({road.id, lane}), end = at_end_.find({road.id, lane});
    if (begin == at_begin_.end() && end == at_end_.end()) return;
    const double width_m = road.width_m.at(lane), length_m = road.length_m();
    std::vector<std::string> records;
    // Where both ends change and the road is too short for both, each has its share.
    double head_m = begin == at_begin_.end() ? 0.0 : begin->second.length_m;
    double tail_m = end == at_end_.end() ? 0.0 : end->second.length_m;
    if (const double sum_m = head_m + tail_m; sum_m > length_m) head_m *= length_m / sum_m, tail_m *= length_m / sum_m;
    if (head_m > 0.0) records.push_back(Ease(begin->second.width_m, width_m, head_m, "sOffset", 0.0));
    if (head_m == 0.0 || length_m - tail_m - head_m > kMeets_m)
      records.push_back(Ease(width_m, width_m, 1.0, "sOffset", head_m));
    if (tail_m > 0.0) {
      if (length_m - tail_m == 0.0) records.clear();
      records.push_back(Ease(width_m, end->second.width_m, tail_m, "sOffset", length_m - tail_m));
    }
    PutWidths(road.lanes.at(lane), records);
  }

  void WriteWay(const Way& way) const {
    const double length_m = way.way->length_m();
    for (const Way::Pair& pair : way.lanes) {
      const double from_m = WidthAt(at_end_, *way.from, pair.from), to_m = WidthAt(at_begin_, *way.to, pair.to);
      const double drawn_m = way.way->width_m.at(pair.on);
      if (std::fabs(from_m - drawn_m) < 1e-9 && std::fabs(to_m - drawn_m) < 1e-9) continue;
      PutWidths(way.way->lanes.at(pair.on), {Ease(from_m, to_m, length_m, "sOffset", 0.0)});
    }
    const double from_m = Moved(at_end_, *way.from, way.lanes.front().from);
    const double to_m = Moved(at_begin_, *way.to, way.lanes.front().to);
    if (std::fabs(from_m) < 1e-9 && std::fabs(to_m) < 1e-9) return;
    pugi::xml_document piece;
    piece.load_string(("<laneOffset " + Ease(from_m, to_m, length_m, "s", 0.0) + "/>").c_str());
    way.way->node.child("lanes").prepend_copy(piece.first_child());
  }

  std::map<std::string, Road> roads_;
  std::vector<Way> ways_;
  std::map<LaneKey, Taper> at_begin_, at_end_;
};

}  // namespace

std::size_t FitWidths(pugi::xml_node drive) { return Fitting(drive).Fit(); }

}  // namespace rodeira::sumo
