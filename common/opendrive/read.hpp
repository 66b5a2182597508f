#pragma once

#include <vector>

#include "common/network/network.hpp"
#include "common/opendrive/source.hpp"

// How the elements of an OpenDRIVE file become the parts of a network. Each says what is wrong to the node's source.
namespace rodeira::opendrive {

// Where something stands in the file, for checks that come later.
struct RoadLines {
  std::size_t road = 0;
  std::vector<std::size_t> elements;  // by plan view element
  std::vector<std::size_t> sections;  // by lane section
};

struct RoadReading {
  network::RoadSpec spec;
  std::vector<geometry::PlanElement> elements;
  RoadLines lines;
};

RoadReading ReadRoad(const Node& road);
std::vector<geometry::PlanElement> ReadPlanView(const Node& road, RoadLines& lines);
void ReadProfiles(const Node& road, network::RoadSpec& spec);
void ReadLateral(const Node& road, network::LateralProfile& lateral);
void ReadLanes(const Node& road, network::RoadSpec& spec, RoadLines& lines);
network::RoadMark ReadMark(const Node& mark, double section_s_m);
void ReadSignals(const Node& road, network::RoadSpec& spec);
void ReadObjects(const Node& road, network::RoadSpec& spec);
network::Junction ReadJunction(const Node& junction);
network::Controller ReadController(const Node& controller);
// Controllers that a junction names and that say no times take turns, in the junction's order: 20 s of green, 3 s of amber,
// 2 s of red for all. Those of lights for people on foot alone stay dark.
void TakeTurns(network::NetworkSpec& spec);
// In m/s from the attributes 'max' or 'speed' and 'unit'; infinite: no limit; nothing: not said.
std::optional<double> ReadSpeed(const Node& speed, const char* attribute);

}  // namespace rodeira::opendrive
