// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <utility>

#include "common/world/opendrive/read.hpp"

namespace rodeira::opendrive {
namespace {

// In the middle of a road (a virtual junction's main one) the link says how this road's s runs beside that one's: with
// "+" it begins where a lane section ends, or ends where one begins.
void ReadMiddle(const Node& link, bool at_start, network::RoadLink& read) {
  read.s_m = link.Number("elementS");
  const std::string way = link.Text("elementDir", "+");
  if (way != "+" && way != "-")
    link.Wrong("road.linkage.element_dir", fmt::format("elementDir is '{}'; + or - was expected", way));
  read.contact = (way == "-") == at_start ? network::End::kStart : network::End::kEnd;
}

std::optional<network::RoadLink> ReadLink(const Node& link, bool at_start) {
  if (!link) return std::nullopt;
  network::RoadLink read;
  const std::string type = link.Text("elementType", "road");
  read.junction = type == "junction";
  if (type != "junction" && type != "road") {
    link.Wrong("road.linkage.element_type", fmt::format("elementType is '{}'; road or junction was expected", type));
  }
  read.id = link.Text("elementId");
  if (read.junction) return read;
  if (link.Has("elementS"))
    ReadMiddle(link, at_start, read);
  else
    read.contact = ReadContact(link, "contactPoint");
  return read;
}

}  // namespace

network::End ReadContact(const Node& node, const char* attribute) {
  const std::string contact = node.Text(attribute, "start");
  if (contact != "start" && contact != "end") {
    node.Wrong("road.linkage.contact_point", fmt::format("{} is '{}'; start or end was expected", attribute, contact));
  }
  return contact == "end" ? network::End::kEnd : network::End::kStart;
}

namespace {

Repair LengthByElements(const Node& road) {
  double length_m = 0.0;
  for (const Node& element : road.Child("planView").Children("geometry"))
    length_m += element.xml().attribute("length").as_double();
  if (!(length_m > 0.0)) return TakeOut(road);
  return {RepairKind::kLengthSet, "it is as long as its elements", {road.Set("length", fmt::format("{}", length_m))}};
}

}  // namespace

RoadReading ReadRoad(const Node& road) {
  RoadReading reading;
  network::RoadSpec& spec = reading.spec;
  Within within(road.source());
  spec.id = road.Text("id");
  road.source().where.road = spec.id;
  spec.name = road.Text("name", "");
  spec.junction = road.Text("junction", "-1");
  if (spec.junction == "-1") spec.junction.clear();
  const std::string rule = road.Text("rule", "RHT");
  if (rule != "RHT" && rule != "LHT")
    road.Wrong("road.rule", fmt::format("rule is '{}'; RHT or LHT was expected", rule),
               {RepairKind::kValueReplaced, "it is read as RHT", {road.Set("rule", "RHT")}});
  spec.left_hand = rule == "LHT";
  const std::size_t before = road.source().errors.size();
  spec.length_m = road.Number("length");
  if (road.source().errors.size() == before && !(spec.length_m > 0.0))
    road.Wrong("road.length", fmt::format("the road is {} m long", spec.length_m), LengthByElements(road));
  spec.predecessor = ReadLink(road.Child("link").Child("predecessor"), true);
  spec.successor = ReadLink(road.Child("link").Child("successor"), false);
  for (const Node& type : road.Children("type")) {
    const Node speed = type.Child("speed");
    spec.types.push_back({type.Number("s"), type.Text("type", "unknown"), type.Text("country", ""),
                          speed ? ReadSpeed(speed, "max") : std::nullopt});
  }
  reading.lines.road = road.line();
  reading.lines.node = road.xml();
  reading.elements = ReadPlanView(road, reading.lines);
  ReadProfiles(road, spec);
  ReadLanes(road, spec, reading.lines);
  ReadSignals(road, spec);
  ReadObjects(road, spec);
  ReadSurface(road, spec);
  return reading;
}

}  // namespace rodeira::opendrive
