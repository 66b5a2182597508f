// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/network_hash.hpp"

#include "common/core/base/bytes.hpp"

namespace rodeira::road {
namespace {

class CanonicalNetworkWriter {
 public:
  void Put(double value) { out_.Put(value + 0.0); }  // -0 is 0
  void Put(int value) { out_.Put(static_cast<std::int64_t>(value)); }
  void Put(bool value) { Put(value ? 1 : 0); }
  void Put(std::size_t value) { out_.Put(static_cast<std::uint64_t>(value)); }
  void Put(const std::string& value) { out_.PutString(value); }
  void Put(const std::optional<double>& value) {
    Put(value.has_value());
    Put(value.value_or(0.0));
  }
  void Put(const geometry::CubicTable& table) {
    Put(table.records().size());
    for (const geometry::Cubic& cubic : table.records()) PutAll(cubic.from, cubic.a, cubic.b, cubic.c, cubic.d);
  }
  void Put(const Eigen::Vector2d& p) { PutAll(p.x(), p.y()); }
  template <class... Values>
  void PutAll(const Values&... values) {
    (Put(values), ...);
  }
  base::Digest Digest() const { return base::Hash(out_.bytes()); }

 private:
  base::ByteWriter out_;
};

void PutLane(CanonicalNetworkWriter& out, const network::Lane& lane) {
  out.PutAll(lane.id, static_cast<int>(lane.type), lane.level, lane.direction, lane.width, lane.border);
  out.PutAll(lane.heights.size(), lane.speeds.size(), lane.materials.size());
  for (const auto& height : lane.heights) out.PutAll(height.s_m, height.inner_m, height.outer_m);
  for (const auto& speed : lane.speeds) out.PutAll(speed.s_m, speed.speed_mps);
  for (const auto& material : lane.materials) out.PutAll(material.s_m, material.surface, material.friction);
  for (const auto* links : {&lane.predecessors, &lane.successors}) {
    out.Put(links->size());
    for (const int id : *links) out.Put(id);
  }
}

void PutLateral(CanonicalNetworkWriter& out, const network::LateralProfile& lateral) {
  out.PutAll(lateral.crossfall_left, lateral.crossfall_right, lateral.shapes.size());
  for (const auto& shape : lateral.shapes) out.PutAll(shape.s_m, shape.height);
  out.Put(lateral.surface.t_offset);
  for (const auto* side : {&lateral.surface.left, &lateral.surface.right}) {
    out.Put(side->size());
    for (const auto& strip : *side) {
      out.PutAll(strip.relative, strip.has_width, strip.width);
      for (const auto& coefficient : strip.coefficients) out.Put(coefficient);
    }
  }
}

void PutFurniture(CanonicalNetworkWriter& out, const network::RoadSpec& spec) {
  out.PutAll(spec.lines.size(), spec.signals.size(), spec.objects.size(), spec.structures.size(), spec.crg.size(),
             spec.unevenness.size());
  for (const auto& line : spec.lines)
    out.PutAll(line.from_s_m, line.to_s_m, line.t, line.width_m, line.stroke_m, line.gap_m, line.colour);
  for (const auto& sign : spec.signals) {
    out.PutAll(sign.s_m, sign.t_m, sign.z_offset_m, sign.orientation, sign.type, sign.subtype, sign.value,
               sign.h_offset_rad);
  }
  for (const auto& object : spec.objects) {
    out.PutAll(object.s_m, object.t_m, object.z_offset_m, object.type, object.subtype, object.hdg_rad, object.length_m,
               object.width_m, object.height_m, object.repeats.size());
    for (const auto& repeat : object.repeats)
      out.PutAll(repeat.s_m, repeat.length_m, repeat.distance_m, repeat.t_start_m, repeat.t_end_m);
  }
  for (const auto& structure : spec.structures) out.PutAll(structure.bridge, structure.s_m, structure.length_m);
  for (const auto& crg : spec.crg) {
    out.PutAll(crg.s_start_m, crg.s_end_m, crg.s_offset_m, crg.t_offset_m, crg.z_offset_m, crg.z_scale,
               crg.h_offset_rad, crg.orientation, crg.mode, crg.purpose);
  }
  for (const auto& made : spec.unevenness) {
    out.PutAll(made.s_start_m, made.s_end_m, made.s_offset_m, made.density_m3, static_cast<std::size_t>(made.seed));
  }
}

void PutNetworkRoad(CanonicalNetworkWriter& out, const network::Road& road) {
  const network::RoadSpec& spec = road.spec();
  out.PutAll(spec.left_hand, !spec.junction.empty(), road.length_m(), road.axis().elements().size());
  for (const auto& element : road.axis().elements()) {
    out.PutAll(element.s_m, element.length_m, element.start_W, element.heading_rad, static_cast<int>(element.kind),
               element.curvature_start_1pm, element.curvature_end_1pm, element.p_end);
    for (std::size_t i = 0; i < 4; ++i) out.PutAll(element.u[i], element.v[i]);
  }
  out.Put(spec.types.size());
  for (const auto& type : spec.types) out.PutAll(type.s_m, type.speed_mps);
  out.PutAll(spec.elevation, spec.superelevation, spec.lane_offset, spec.sections.size());
  PutLateral(out, spec.lateral);
  for (const auto& section : spec.sections) {
    out.PutAll(section.s_m, section.left.size(), section.right.size());
    for (const auto* side : {&section.left, &section.right}) {
      for (const network::Lane& lane : *side) PutLane(out, lane);
    }
  }
  PutFurniture(out, spec);
  out.Put(spec.earthwork.has_value());
  if (spec.earthwork)
    out.PutAll(spec.earthwork->blend_m, spec.earthwork->cut, spec.earthwork->fill, spec.earthwork->reach_m);
}

}  // namespace

base::Digest HashOf(const network::Network& network) {
  CanonicalNetworkWriter out;
  out.Put(network.roads().size());
  for (const network::Road& road : network.roads()) PutNetworkRoad(out, road);
  out.Put(network.junctions().size());
  for (const network::Junction& junction : network.junctions()) {
    out.PutAll(junction.connections.size(), junction.priorities.size(), junction.outline_W.size(),
               junction.paved_W.size());
    for (const auto* corners : {&junction.outline_W, &junction.paved_W}) {
      for (const Eigen::Vector2d& corner : *corners) out.Put(corner);
    }
  }
  return out.Digest();
}

}  // namespace rodeira::road
