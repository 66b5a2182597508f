// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <pugixml.hpp>
#include <sstream>
#include <string>

#include "common/world/opendrive/import.hpp"
#include "common/world/traffic_map/lane_map.hpp"
#include "common/world/traffic_map/open_drive.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"

// The project's maps as OpenDRIVE, with what a test puts into them, and as they would lie in a country of left-hand
// traffic.
namespace rodeira::lanes {

// With the map's companion (lights, signs), or without.
inline std::string MapText(const std::string& name, bool companion = true,
                           traffic_map::Junctions junctions = traffic_map::Junctions::kCommon) {
  const auto path = std::filesystem::path(SourceDir()) / "configs/maps" / (name + ".motors");
  const auto map = companion ? traffic_map::LoadLaneMap(path).value()
                             : traffic_map::MakeLaneMap(traffic_map::LoadMap(path).value(), {}, name).value();
  return traffic_map::ToOpenDrive(map, name, junctions).value().xml;
}

class Drawn {
 public:
  explicit Drawn(const std::string& text) { EXPECT_TRUE(document_.load_string(text.c_str())); }

  // A signal for the traffic of a road's lane, where the road ends: a German number, or behind '=' what a sign of
  // another country means (<semantics>).
  Drawn& Sign(const std::string& road_id, const std::string& type) {
    pugi::xml_node road = document_.child("OpenDRIVE").find_child_by_attribute("road", "id", road_id.c_str());
    EXPECT_TRUE(road) << road_id;
    pugi::xml_node signals = road.child("signals") ? road.child("signals") : road.append_child("signals");
    pugi::xml_node signal = signals.append_child("signal");
    for (const auto& [key, value] : {std::pair{"s", road.attribute("length").value()},
                                     {"t", "-3"},
                                     {"dynamic", "no"},
                                     {"orientation", "+"},
                                     {"zOffset", "2"},
                                     {"country", type[0] == '=' ? "US" : "DE"},
                                     {"type", type[0] == '=' ? "R1" : type.c_str()},
                                     {"subtype", "-1"}}) {
      signal.append_attribute(key).set_value(value);
    }
    signal.append_attribute("id").set_value(("sign " + road_id).c_str());
    if (type[0] == '=')
      signal.append_child("semantics").append_child("priority").append_attribute("type").set_value(type.c_str() + 1);
    return *this;
  }
  // What a junction says of two of its connecting roads.
  Drawn& Priority(const std::string& high, const std::string& low) {
    for (pugi::xml_node junction : document_.child("OpenDRIVE").children("junction")) {
      if (!junction.find_child_by_attribute("connection", "connectingRoad", high.c_str())) continue;
      pugi::xml_node priority = junction.append_child("priority");
      priority.append_attribute("high").set_value(high.c_str());
      priority.append_attribute("low").set_value(low.c_str());
      return *this;
    }
    ADD_FAILURE() << "no junction has " << high;
    return *this;
  }
  // North becomes south, and with it left becomes right: lanes, signs and all, in left-hand traffic.
  Drawn& Mirror() {
    for (pugi::xml_node road : document_.child("OpenDRIVE").children("road")) {
      road.remove_attribute("rule");
      road.append_attribute("rule").set_value("LHT");
      Below(road);
    }
    for (pugi::xml_node junction : document_.child("OpenDRIVE").children("junction")) Below(junction);
    return *this;
  }
  std::shared_ptr<const network::Network> Read() const {
    std::ostringstream text;
    document_.save(text);
    const auto import = opendrive::Read(text.str(), "drawn.xodr");
    EXPECT_TRUE(import.ok()) << import.error().Text();
    for (const auto& error : import.value().errors) ADD_FAILURE() << error.Text();
    return import.value().network;
  }

 private:
  static void Negate(pugi::xml_node node, std::initializer_list<const char*> names) {
    for (const char* name : names) {
      pugi::xml_attribute attribute = node.attribute(name);
      const std::string value = attribute.value();
      if (!value.empty()) attribute.set_value(value.front() == '-' ? value.substr(1).c_str() : ("-" + value).c_str());
    }
  }
  static void Below(pugi::xml_node node) {
    for (pugi::xml_node child = node.first_child(); child;) {
      const pugi::xml_node next = child.next_sibling();
      const std::string name = child.name(), above = node.name();
      if (name == "geometry") Negate(child, {"y", "hdg"});
      if (name == "paramPoly3") Negate(child, {"aV", "bV", "cV", "dV"});
      if (name == "laneOffset" || name == "superelevation") Negate(child, {"a", "b", "c", "d"});
      if (name == "lane" && child.attribute("id").as_int() != 0) Negate(child, {"id"});
      if ((name == "predecessor" || name == "successor") && node.parent().name() == std::string("lane"))
        Negate(child, {"id"});
      if (name == "laneLink") Negate(child, {"from", "to"});
      if (name == "signal") Negate(child, {"t"});
      if (name == "validity") Negate(child, {"fromLane", "toLane"});
      Below(child);
      if (above == "laneSection" && name == "right") child.set_name("left"), node.prepend_move(child);
      child = next;
    }
  }

  pugi::xml_document document_;
};

}  // namespace rodeira::lanes
