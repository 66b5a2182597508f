// SPDX-License-Identifier: Apache-2.0
#include "common/world/opendrive/twin_roads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace rodeira::opendrive {
namespace {

using network::End;
using network::Network;
using network::Road;

constexpr double kApart_m = 1.0;        // a link tells two roads apart that differ by more in how far away they are
constexpr double kFar_m = 30.0;         // a link that meets no road within this distance tells nothing
constexpr std::size_t kMaxTwins = 200;  // of more roads with one id the first alone is kept
constexpr double kNever = std::numeric_limits<double>::infinity();

Eigen::Vector2d PlaceOf(const Road& road, End end) {
  return road.axis().Evaluate(end == End::kStart ? 0.0 : road.length_m()).p_W;
}
double ToEitherEnd(const Road& road, const Eigen::Vector2d& p_W) {
  return std::min((PlaceOf(road, End::kStart) - p_W).norm(), (PlaceOf(road, End::kEnd) - p_W).norm());
}
bool Coincide(const Road& a, const Road& b) {
  return std::max(ToEitherEnd(a, PlaceOf(b, End::kStart)), ToEitherEnd(a, PlaceOf(b, End::kEnd))) < kApart_m &&
         std::max(ToEitherEnd(b, PlaceOf(a, End::kStart)), ToEitherEnd(b, PlaceOf(a, End::kEnd))) < kApart_m;
}

// The roads of one id, and what becomes of each.
struct Twins {
  std::vector<std::uint32_t> roads;      // ascending
  std::vector<bool> is_left_out;         // by the same order
  std::vector<std::vector<Edit>> edits;  // that give its links the new id
  std::vector<std::string> ids;          // from now on
  explicit Twins(std::vector<std::uint32_t> of)
      : roads(std::move(of)), is_left_out(roads.size()), edits(roads.size()), ids(roads.size()) {}
};

class TwinChecker {
 public:
  TwinChecker(const Network& network, std::span<const RoadLines> lines, Findings& findings)
      : network_(network), lines_(lines), findings_(findings) {
    for (std::uint32_t i = 0; i < network.roads().size(); ++i) by_id_[network.roads()[i].id()].push_back(i);
    for (const auto& [id, roads] : by_id_) {
      if (roads.size() > 1 && roads.size() <= kMaxTwins) twins_.emplace(id, roads);
      if (roads.size() > kMaxTwins) LeaveOut(roads);
    }
  }

  void Check() {
    if (twins_.empty()) return;
    for (auto& [id, twins] : twins_) GiveIds(id, twins);
    RoadLinks();
    Connections();
    for (auto& [id, twins] : twins_) Tell(twins);
  }

 private:
  Node RoadNode(std::uint32_t road) const { return {findings_.source, lines_[road].node}; }

  void LeaveOut(const std::vector<std::uint32_t>& roads) {
    Twins twins(roads);
    twins.is_left_out.assign(roads.size(), true);
    Tell(twins);
  }

  void GiveIds(const std::string& id, Twins& twins) {
    for (std::size_t i = 1; i < twins.roads.size(); ++i) {
      const Road& road = network_.roads()[twins.roads[i]];
      twins.is_left_out[i] = std::any_of(twins.roads.begin(), twins.roads.begin() + static_cast<std::ptrdiff_t>(i),
                                         [&](std::uint32_t k) { return Coincide(network_.roads()[k], road); });
      twins.ids[i] = NewId(id);
    }
  }

  // A number where the roads have numbers, as other programs want it.
  std::string NewId(const std::string& id) {
    const auto is_number = [](const std::string& text) {
      return !text.empty() && text.size() < 10 && text.find_first_not_of("0123456789") == std::string::npos;
    };
    std::string base = id;
    for (char& c : base) {
      if (std::string_view("&<>\"'").find(c) != std::string_view::npos) c = '_';
    }
    unsigned long next = 2;
    if (is_number(id)) {
      for (const auto& [other, roads] : by_id_) {
        if (is_number(other)) next = std::max(next, std::stoul(other) + 1);
      }
    }
    for (;; ++next) {
      std::string made = is_number(id) ? std::to_string(next) : fmt::format("{}_{}", base, next);
      if (!by_id_.contains(made) && given_.insert(made).second) return made;
    }
  }

  // An attribute that names roads of one id, each so far from where it is meant.
  void Refer(const Node& node, const char* attribute, Twins& twins, const std::vector<double>& far_m) {
    const auto nearest = static_cast<std::size_t>(std::min_element(far_m.begin(), far_m.end()) - far_m.begin());
    if (!(far_m[nearest] < kFar_m)) return;
    const auto is_as_near = [&](std::size_t i) { return far_m[i] < far_m[nearest] + kApart_m; };
    std::size_t meant = 0;
    while (!is_as_near(meant)) ++meant;
    for (std::size_t i = meant + 1; i < far_m.size(); ++i) {
      if (is_as_near(i)) twins.is_left_out[i] = true;
    }
    if (meant > 0 && node) twins.edits[meant].push_back(node.Set(attribute, twins.ids[meant]));
  }

  void RoadLinks() {
    for (std::uint32_t i = 0; i < network_.roads().size(); ++i) {
      const Road& road = network_.roads()[i];
      for (const End end : {End::kStart, End::kEnd}) {
        const auto& link = end == End::kStart ? road.spec().predecessor : road.spec().successor;
        const auto found = link && !link->junction ? twins_.find(link->id) : twins_.end();
        if (found == twins_.end()) continue;
        std::vector<double> far_m;
        for (const std::uint32_t k : found->second.roads) {
          const Road& other = network_.roads()[k];
          const bool is_itself = k == i && link->contact == end && !link->s_m;
          const Eigen::Vector2d met = link->s_m
                                          ? other.axis().Evaluate(std::clamp(*link->s_m, 0.0, other.length_m())).p_W
                                          : PlaceOf(other, link->contact);
          far_m.push_back(is_itself ? kNever : (met - PlaceOf(road, end)).norm());
        }
        Refer(RoadNode(i).Child("link").Child(end == End::kStart ? "predecessor" : "successor"), "elementId",
              found->second, far_m);
      }
    }
  }

  void Connections() {
    const std::vector<Node> junctions = findings_.source->root().Children("junction");
    for (std::size_t j = 0; j < junctions.size() && j < network_.junctions().size(); ++j) {
      const network::Junction& junction = network_.junctions()[j];
      const std::vector<Node> nodes = junctions[j].Children("connection");
      for (std::size_t i = 0; i < nodes.size() && i < junction.connections.size(); ++i)
        Connection(nodes[i], junction, junction.connections[i]);
    }
  }

  void Connection(const Node& node, const network::Junction& junction, const network::JunctionConnection& connection) {
    const bool is_direct = node.Has("linkedRoad");
    const auto incoming = by_id_.find(connection.incoming_road), connecting = by_id_.find(connection.connecting_road);
    if (incoming == by_id_.end() || connecting == by_id_.end()) return;
    // Of the roads that are named so the ways of this junction.
    std::vector<std::uint32_t> ways;
    for (const std::uint32_t k : connecting->second) {
      if (is_direct || network_.roads()[k].spec().junction == junction.id) ways.push_back(k);
    }
    if (ways.empty()) ways = connecting->second;
    const auto between = [&](std::uint32_t way, std::uint32_t road) {
      return way == road ? kNever
                         : ToEitherEnd(network_.roads()[road], PlaceOf(network_.roads()[way], connection.contact));
    };
    if (const auto found = twins_.find(connection.incoming_road); found != twins_.end()) {
      std::vector<double> far_m;
      for (const std::uint32_t k : found->second.roads) {
        far_m.push_back(kNever);
        for (const std::uint32_t way : ways) far_m.back() = std::min(far_m.back(), between(way, k));
      }
      Refer(node, "incomingRoad", found->second, far_m);
    }
    if (const auto found = twins_.find(connection.connecting_road); found != twins_.end()) {
      std::vector<double> far_m;
      for (const std::uint32_t k : found->second.roads) {
        far_m.push_back(kNever);
        if (std::find(ways.begin(), ways.end(), k) == ways.end()) continue;
        for (const std::uint32_t road : incoming->second) far_m.back() = std::min(far_m.back(), between(k, road));
      }
      Refer(node, is_direct ? "linkedRoad" : "connectingRoad", found->second, far_m);
    }
  }

  void Tell(Twins& twins) {
    for (std::size_t i = 1; i < twins.roads.size(); ++i) {
      const std::uint32_t road = twins.roads[i];
      Finding finding{"ids.id_unique_in_class",
                      fmt::format("this id stands at {} roads", twins.roads.size()),
                      lines_[road].road,
                      network_.roads()[road].id(),
                      std::nullopt,
                      std::nullopt};
      if (twins.is_left_out[i]) {
        finding.repair = {RepairKind::kRoadLeftOut,
                          "this one is left out: no link tells it from the first",
                          {RoadNode(road).Remove()}};
      } else {
        finding.repair = {
            RepairKind::kRoadRenamed,
            fmt::format("this one has the id {}, also in {} links that meet it", twins.ids[i], twins.edits[i].size()),
            std::move(twins.edits[i])};
        finding.repair.edits.push_back(RoadNode(road).Set("id", twins.ids[i]));
      }
      findings_.errors.push_back(std::move(finding));
    }
  }

  const Network& network_;
  std::span<const RoadLines> lines_;
  Findings& findings_;
  std::map<std::string, std::vector<std::uint32_t>> by_id_;
  std::map<std::string, Twins> twins_;
  std::set<std::string> given_;
};

}  // namespace

void CheckTwinRoads(const Network& network, std::span<const RoadLines> lines, Findings& findings) {
  TwinChecker(network, lines, findings).Check();
}

}  // namespace rodeira::opendrive
