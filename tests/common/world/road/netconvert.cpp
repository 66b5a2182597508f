// SPDX-License-Identifier: Apache-2.0
// What SUMO's netconvert makes of an exported world, against the network it was made of.
#include "tests/common/world/road/netconvert.hpp"
#include "tests/long_form.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <set>
#include <sstream>
#include <tuple>
#include <utility>

#include "common/core/base/files.hpp"

namespace rodeira::road {
namespace {

using network::LaneKey;
using network::Network;

// How long a line of "x,y[,z]" is in the plane.
double LengthOf(const std::string& shape) {
  std::istringstream words(shape);
  double length_m = 0.0;
  Eigen::Vector2d before, p;
  int count = 0;
  for (std::string word; words >> word; before = p, ++count) {
    std::sscanf(word.c_str(), "%lf,%lf", &p.x(), &p.y());
    if (count > 0) length_m += (p - before).norm();
  }
  return length_m;
}

// An attribute of the element that begins at `at`; empty where it has none.
std::string Attribute(const std::string& text, std::size_t at, const std::string& name) {
  const std::size_t begin = text.find(" " + name + "=\"", at), end = text.find('>', at);
  if (begin == std::string::npos || begin > end) return "";
  return text.substr(begin + name.size() + 3, text.find('"', begin + name.size() + 3) - begin - name.size() - 3);
}

// The first and the last point of a shape.
std::pair<Eigen::Vector2d, Eigen::Vector2d> EndsOf(const std::string& shape) {
  const auto point = [](const std::string& word) {
    Eigen::Vector2d p = Eigen::Vector2d::Zero();
    std::sscanf(word.c_str(), "%lf,%lf", &p.x(), &p.y());
    return p;
  };
  return {point(shape.substr(0, shape.find(' '))), point(shape.substr(shape.rfind(' ') + 1))};
}

// Of an edge, or of all that a road closed in itself is split into (ID#0, ID#1 …), with the decimetre that SUMO leaves
// between two such parts. A straight one has no shape of its own: it goes from node to node.
double LengthOfEdge(const std::string& edges, const std::string& nodes, const std::string& id) {
  const auto place = [&](const std::string& node) {
    const std::size_t at = nodes.find("<node id=\"" + node + "\"");
    return at == std::string::npos ? std::string() : Attribute(nodes, at, "x") + "," + Attribute(nodes, at, "y");
  };
  double length_m = 0.0;
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> parts;
  for (std::size_t at = edges.find("<edge id=\""); at != std::string::npos; at = edges.find("<edge id=\"", at + 1)) {
    const std::string own = Attribute(edges, at, "id");
    if (own != id && !own.starts_with(id + "#")) continue;
    std::string shape = Attribute(edges, at, "shape");
    if (shape.empty()) shape = place(Attribute(edges, at, "from")) + " " + place(Attribute(edges, at, "to"));
    length_m += LengthOf(shape);
    parts.push_back(EndsOf(shape));
  }
  for (std::size_t i = 0; parts.size() > 1 && i < parts.size(); ++i)
    length_m += (parts[(i + 1) % parts.size()].first - parts[i].second).norm();
  return length_m;
}

// What netconvert complains of, but for what every road closed in itself gets: it has no edge from a node to the same.
std::string Complaints(const std::string& log) {
  std::string said;
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);) {
    const bool closed =
        line.starts_with("Warning: Edge '") && line.ends_with("has to be split as it connects same junctions.");
    if ((line.find("Warning") != std::string::npos || line.find("Error") != std::string::npos) && !closed)
      said += line + "\n";
  }
  return said;
}

// A lane as SUMO names it: its edge, and how many lanes of it lie farther right.
struct SumoLane {
  std::string edge;
  std::size_t index = 0;
  auto operator<=>(const SumoLane&) const = default;
};

SumoLane SumoNameOf(const Network& network, const std::vector<std::string>& ids, const LaneKey& key) {
  const network::LaneSection& section = network.Section(key);
  SumoLane lane{std::string(key.lane > 0 ? "" : "-") + ids[key.road], 0};
  for (const network::Lane& other : key.lane > 0 ? section.left : section.right)
    lane.index += network::IsDrivable(other.type) && std::abs(other.id) > std::abs(key.lane) ? 1 : 0;
  return lane;
}

std::string AttributeOf(const std::string& element, const std::string& name) {
  const std::size_t at = element.find(" " + name + "=\"");
  if (at == std::string::npos) return "";
  const std::size_t begin = at + name.size() + 3;
  return element.substr(begin, element.find('"', begin) - begin);
}

// An edge's road and side: a road that is closed in itself is cut by SUMO into ID#0, ID#1 ….
std::string Uncut(const std::string& edge) { return edge.substr(0, edge.find('#')); }

}  // namespace

// SUMO draws an edge along the line that lanes are counted from; here before it cuts that by the shapes of its own
// junctions. `it.xodr` in the folder is the network; SUMO says ids as the file does.
void ExpectEveryEdge(const std::filesystem::path& folder, const Network& network, const std::vector<std::string>& ids,
                     int at_least) {
  double all_m = 0.0;
  for (const network::Road& road : network.roads()) all_m += road.length_m();
  // SUMO's time grows faster than the chords of a road.
  const std::string chord_m = all_m > 20'000.0 ? BriefOrLong<std::string>("1", "0.2") : "0.2";
  const std::string command =
      "cd " + folder.string() +
      " && { [ -n \"$SUMO_HOME\" ] || [ ! -d /usr/share/sumo ] || export SUMO_HOME=/usr/share/sumo; } && netconvert "
      "--opendrive-files it.xodr "
      "--opendrive.curve-resolution " +
      chord_m + " --precision 6 --plain-output-prefix it --output-file it.net.xml > log 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0) << base::ReadText(folder / "log").value();
  EXPECT_EQ(Complaints(base::ReadText(folder / "log").value()), "");
  const std::string edges = base::ReadText(folder / "it.edg.xml").value(),
                    nodes = base::ReadText(folder / "it.nod.xml").value();
  int found = 0;
  for (std::size_t index = 0; index < network.roads().size(); ++index) {
    const network::Road& road = network.roads()[index];
    if (!road.spec().junction.empty()) continue;
    double length_m = 0.0;
    constexpr int kSteps = 4000;
    Eigen::Vector2d before;
    for (int i = 0; i <= kSteps; ++i) {
      const double s = road.length_m() * i / kSteps;
      const Eigen::Vector2d p = road.Surface(s, road.CentreAt(s).value).p_W.head<2>();
      if (i > 0) length_m += (p - before).norm();
      before = p;
    }
    for (const bool left : {false, true}) {
      const network::LaneSection& section = road.spec().sections[0];
      const auto& side = left ? section.left : section.right;
      if (std::none_of(side.begin(), side.end(),
                       [](const network::Lane& lane) { return network::IsDrivable(lane.type); }))
        continue;
      EXPECT_NEAR(LengthOfEdge(edges, nodes, std::string(left ? "" : "-") + ids[index]), length_m,
                  2e-4 * length_m + 0.03)
          << road.id();
      ++found;
    }
  }
  EXPECT_GE(found, at_least);
}

// Each edge of what ExpectEveryEdge wrote has the lanes of its side and no others, as wide as they are.
void ExpectEveryLane(const std::filesystem::path& folder, const Network& network, const std::vector<std::string>& ids) {
  std::map<SumoLane, double> theirs;
  std::istringstream lines(base::ReadText(folder / "it.net.xml").value());
  for (std::string line; std::getline(lines, line);) {
    const std::string id = AttributeOf(line, "id");
    const std::size_t low = id.rfind('_');
    if (line.find("<lane ") == std::string::npos || id.starts_with(":") || low == std::string::npos) continue;
    const std::string width = AttributeOf(line, "width");
    theirs[{Uncut(id.substr(0, low)), std::stoul(id.substr(low + 1))}] =
        width.empty() ? 3.2 : std::stod(width);  // SUMO's usual one is not written
  }
  std::size_t compared = 0;
  for (const LaneKey& key : network.Lanes()) {
    if (!network.roads()[key.road].spec().junction.empty() || key.section != 0 ||
        !network::IsDrivable(network.Find(key)->type))
      continue;
    const SumoLane name = SumoNameOf(network, ids, key);
    ASSERT_TRUE(theirs.contains(name)) << name.edge << " " << name.index;
    const double width = network.Span(key, 0.0)->width_m();
    const bool constant =
        std::fabs(network.Span(key, 0.5 * network.roads()[key.road].length_m())->width_m() - width) < 1e-9 &&
        std::fabs(network.Span(key, network.roads()[key.road].length_m())->width_m() - width) < 1e-9;
    if (constant) {
      EXPECT_NEAR(theirs[name], width, 0.005) << name.edge << " " << name.index;
    }
    ++compared;
  }
  EXPECT_EQ(compared, theirs.size());
}

// What leads where: through junctions and from road to road. SUMO adds that one may turn round at the end of an edge.
void ExpectEveryWay(const std::filesystem::path& folder, const Network& network, const std::vector<std::string>& ids) {
  using Way = std::pair<SumoLane, SumoLane>;
  std::set<Way> ours, theirs;
  const auto along = [](const LaneKey& key) { return key.lane < 0; };
  for (const LaneKey& key : network.Lanes()) {
    if (!network::IsDrivable(network.Find(key)->type)) continue;
    const auto from = along(key) ? network.AtStart(key) : network.AtEnd(key),
               to = along(key) ? network.AtEnd(key) : network.AtStart(key);
    const bool way = !network.roads()[key.road].spec().junction.empty();
    for (const network::LaneEnd& next : to) {
      const bool next_way = !network.roads()[next.lane.road].spec().junction.empty();
      if (next_way || next.lane.road == key.road) continue;
      if (!way) ours.insert({SumoNameOf(network, ids, key), SumoNameOf(network, ids, next.lane)});
      for (const network::LaneEnd& before : from) {
        if (way) ours.insert({SumoNameOf(network, ids, before.lane), SumoNameOf(network, ids, next.lane)});
      }
    }
  }
  std::istringstream lines(base::ReadText(folder / "it.con.xml").value());
  for (std::string line; std::getline(lines, line);) {
    if (line.find("<connection ") == std::string::npos) continue;
    const std::string from = Uncut(AttributeOf(line, "from")), to = Uncut(AttributeOf(line, "to"));
    if (from == to || "-" + from == to || from == "-" + to) continue;
    theirs.insert({{from, std::stoul(AttributeOf(line, "fromLane"))}, {to, std::stoul(AttributeOf(line, "toLane"))}});
  }
  const auto text = [](const std::set<Way>& ways) {
    std::vector<std::string> said;
    for (const auto& [from, to] : ways)
      said.push_back(fmt::format("{} {} to {} {}", from.edge, from.index, to.edge, to.index));
    return said;
  };
  EXPECT_THAT(text(theirs), testing::ElementsAreArray(text(ours)));
}

std::vector<std::string> IdsOf(const Network& network) {
  std::vector<std::string> ids;
  for (const network::Road& road : network.roads()) ids.push_back(road.id());
  return ids;
}

bool HasNetconvert() { return std::system("command -v netconvert > /dev/null 2>&1") == 0; }

}  // namespace rodeira::road
