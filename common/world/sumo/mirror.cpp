// SPDX-License-Identifier: Apache-2.0
#include "common/world/sumo/mirror.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rodeira::sumo {
namespace {

// The same number with the other sign, digit by digit.
std::string Negated(std::string_view number) {
  if (number.starts_with('-')) return std::string(number.substr(1));
  if (number.find_first_of("123456789") == std::string_view::npos) return std::string(number);
  return "-" + std::string(number);
}

void Negate(pugi::xml_node node, const char* name) {
  if (pugi::xml_attribute attribute = node.attribute(name)) attribute = Negated(attribute.value()).c_str();
}

// "x,y x,y" or with heights.
std::string MirroredShape(std::string_view shape) {
  std::string mirrored;
  while (!shape.empty()) {
    const std::string_view point = shape.substr(0, shape.find(' '));
    shape.remove_prefix(std::min(point.size() + 1, shape.size()));
    const std::size_t y = point.find(',');
    if (y == std::string_view::npos) continue;
    const std::string_view behind = point.substr(y + 1);
    const std::string_view number = behind.substr(0, behind.find(','));
    if (!mirrored.empty()) mirrored += ' ';
    mirrored += std::string(point.substr(0, y + 1)) + Negated(number) + std::string(behind.substr(number.size()));
  }
  return mirrored;
}

void MirrorNode(pugi::xml_node node) {
  for (const char* name : {"shape", "customShape", "outlineShape"}) {
    if (pugi::xml_attribute shape = node.attribute(name);
        shape && std::string_view(shape.value()).find(',') != std::string_view::npos)
      shape = MirroredShape(shape.value()).c_str();
  }
  const std::string_view kind = node.name();
  if (kind == "junction") Negate(node, "y");
  if (kind == "connection") {
    pugi::xml_attribute direction = node.attribute("dir");
    const std::string_view before = direction.value();
    constexpr std::pair<std::string_view, const char*> kTurned[] = {{"l", "r"}, {"r", "l"}, {"L", "R"},
                                                                    {"R", "L"}, {"T", "t"}, {"t", "T"}};
    for (const auto& [from, to] : kTurned) {
      if (before != from) continue;
      direction = to;
      break;
    }
  }
  for (pugi::xml_node child : node.children()) MirrorNode(child);
}

void MirrorRoad(pugi::xml_node road) {
  if (!road.attribute("rule")) road.append_attribute("rule");
  road.attribute("rule") = "LHT";
  for (pugi::xml_node geometry : road.child("planView").children("geometry")) {
    for (const char* name : {"y", "hdg"}) Negate(geometry, name);
    for (const char* name : {"aV", "bV", "cV", "dV"}) Negate(geometry.child("paramPoly3"), name);
    for (const char* name : {"a", "b", "c", "d"}) Negate(geometry.child("poly3"), name);
    Negate(geometry.child("arc"), "curvature");
    for (const char* name : {"curvStart", "curvEnd"}) Negate(geometry.child("spiral"), name);
  }
  for (const char* name : {"a", "b", "c", "d"}) {
    for (pugi::xml_node record : road.child("lateralProfile").children("superelevation")) Negate(record, name);
    for (pugi::xml_node record : road.child("lanes").children("laneOffset")) Negate(record, name);
  }
  for (pugi::xml_node section : road.child("lanes").children("laneSection")) {
    pugi::xml_node right = section.child("right");
    if (!right) continue;
    pugi::xml_node left = section.prepend_child("left");
    std::vector<pugi::xml_node> lanes;
    for (const pugi::xml_node& lane : right.children("lane")) lanes.push_back(lane);
    for (auto lane = lanes.rbegin(); lane != lanes.rend(); ++lane) {  // from left to right
      pugi::xml_node moved = left.append_copy(*lane);
      Negate(moved, "id");
      for (pugi::xml_node link : moved.child("link").children()) Negate(link, "id");
    }
    section.remove_child(right);
  }
  for (pugi::xml_node signal : road.child("signals").children()) {
    for (const char* name : {"t", "hOffset", "roll"}) Negate(signal, name);
    for (pugi::xml_node validity : signal.children("validity")) {
      for (const char* name : {"fromLane", "toLane"}) Negate(validity, name);
    }
  }
}

}  // namespace

bool MirrorLeftHandNet(const std::filesystem::path& net) {
  pugi::xml_document document;
  if (!document.load_file(net.c_str())) return false;
  pugi::xml_node root = document.child("net");
  if (!root.attribute("lefthand").as_bool()) return false;
  root.remove_attribute("lefthand");
  if (pugi::xml_attribute offset = root.child("location").attribute("netOffset"))
    offset = MirroredShape(offset.value()).c_str();
  MirrorNode(root);
  return document.save_file(net.c_str());
}

void MirrorToLeftHand(pugi::xml_node drive) {
  Negate(drive.child("header").child("offset"), "y");
  for (const char* name : {"north", "south"}) Negate(drive.child("header"), name);
  if (pugi::xml_node header = drive.child("header"); header.attribute("north") && header.attribute("south")) {
    const std::string north = header.attribute("north").value();
    header.attribute("north") = header.attribute("south").value();
    header.attribute("south") = north.c_str();
  }
  for (pugi::xml_node road : drive.children("road")) MirrorRoad(road);
  for (pugi::xml_node junction : drive.children("junction")) {
    for (pugi::xml_node connection : junction.children("connection")) {
      for (pugi::xml_node link : connection.children("laneLink")) {
        for (const char* name : {"from", "to"}) Negate(link, name);
      }
    }
  }
}

}  // namespace rodeira::sumo
