#include <fmt/format.h>

#include <utility>

#include "common/opendrive/read.hpp"

namespace rodeira::opendrive {
namespace {

std::optional<network::RoadLink> ReadLink(const Node& link) {
  if (!link || link.Has("elementS")) return std::nullopt;  // the middle of a road (a virtual junction's main one) is no end to go on from
  network::RoadLink read;
  const std::string type = link.Text("elementType", "road");
  read.junction = type == "junction";
  if (type != "junction" && type != "road") {
    link.Wrong("road.linkage.element_type", fmt::format("elementType is '{}'; road or junction was expected", type));
  }
  read.id = link.Text("elementId");
  if (!read.junction) read.contact = ReadContact(link, "contactPoint");
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
  if (rule != "RHT" && rule != "LHT") road.Wrong("road.rule", fmt::format("rule is '{}'; RHT or LHT was expected", rule));
  spec.left_hand = rule == "LHT";
  spec.length_m = road.Number("length");
  if (!(spec.length_m > 0.0)) road.Wrong("road.length", fmt::format("the road is {} m long", spec.length_m));
  spec.predecessor = ReadLink(road.Child("link").Child("predecessor"));
  spec.successor = ReadLink(road.Child("link").Child("successor"));
  for (const Node& type : road.Children("type")) {
    const Node speed = type.Child("speed");
    spec.types.push_back({type.Number("s"), type.Text("type", "unknown"), type.Text("country", ""),
                          speed ? ReadSpeed(speed, "max") : std::nullopt});
  }
  reading.lines.road = road.line();
  reading.elements = ReadPlanView(road, reading.lines);
  ReadProfiles(road, spec);
  ReadLanes(road, spec, reading.lines);
  ReadSignals(road, spec);
  ReadObjects(road, spec);
  ReadSurface(road, spec);
  return reading;
}

}  // namespace rodeira::opendrive
