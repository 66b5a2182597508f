// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/tiles/stretch_digest.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <string>

#include "common/core/base/bytes.hpp"
#include "common/view/scene/breaklines/laid_lines.hpp"
#include "common/world/network/junction_ground.hpp"
#include "common/world/network/network.hpp"

namespace rodeira::scene {
namespace {

using network::LaneMaterial;
using network::RoadSpec;

// What lies between two stations, in bytes.
class Stretch {
 public:
  Stretch(double from_s_m, double to_s_m) : from_(from_s_m), to_(to_s_m) {}

  void Put(double value) { out_.Put(value + 0.0); }  // -0 is 0
  void Put(int value) { out_.Put(static_cast<std::int64_t>(value)); }
  void Put(bool value) { out_.Put(static_cast<std::uint8_t>(value)); }
  void Put(std::size_t value) { out_.Put(static_cast<std::uint64_t>(value)); }
  void Put(const std::string& value) { out_.PutString(value); }
  void Put(const Eigen::Vector2d& p) { PutAll(p.x(), p.y()); }
  void Put(const std::optional<double>& value) { PutAll(value.has_value(), value.value_or(0.0)); }
  template <class... Values>
  void PutAll(const Values&... values) {
    (Put(values), ...);
  }

  bool Overlaps(double from_s_m, double to_s_m) const { return from_s_m <= to_ && to_s_m >= from_; }
  // The items of which each is in force from its own station on, and the first before it; of those that are in between
  // others also the next ones.
  template <class Items, class StationOf>
  auto InForce(const Items& items, const StationOf& station_of, bool with_next = false) const {
    std::size_t first = 0, last = 0;
    for (std::size_t i = 0; i < items.size(); ++i) {
      if (station_of(items[i]) <= from_) first = i;
      if (station_of(items[i]) <= to_ || i == 0) last = i + 1;
    }
    if (with_next) last = std::min(last + 1, items.size());
    return std::span(items).subspan(first, last - first);
  }

  void Put(const geometry::CubicTable& table) {
    const auto records = InForce(table.records(), [](const geometry::Cubic& cubic) { return cubic.from; });
    Put(records.size());
    for (const geometry::Cubic& cubic : records) PutAll(cubic.from, cubic.a, cubic.b, cubic.c, cubic.d);
  }
  // Over something else than stations.
  void PutWhole(const geometry::CubicTable& table) {
    Put(table.records().size());
    for (const geometry::Cubic& cubic : table.records()) PutAll(cubic.from, cubic.a, cubic.b, cubic.c, cubic.d);
  }

  base::Digest Digest() const { return base::Hash(out_.bytes()); }

 private:
  double from_, to_;
  base::ByteWriter out_;
};

void PutAxis(Stretch& out, const network::Road& road) {
  for (const geometry::PlanElement& element : road.axis().elements()) {
    if (!out.Overlaps(element.s_m, element.s_m + element.length_m)) continue;
    out.PutAll(element.s_m, element.length_m, element.start_W, element.heading_rad, static_cast<int>(element.kind),
               element.curvature_start_1pm, element.curvature_end_1pm, element.p_end);
    for (std::size_t i = 0; i < 4; ++i) out.PutAll(element.u[i], element.v[i]);
  }
}

void PutLateral(Stretch& out, const network::LateralProfile& lateral) {
  out.PutAll(lateral.crossfall_left, lateral.crossfall_right);
  for (const network::Shape& shape : out.InForce(
           lateral.shapes, [](const network::Shape& at) { return at.s_m; }, true)) {
    out.Put(shape.s_m);
    out.PutWhole(shape.height);
  }
  out.Put(lateral.surface.t_offset);
  for (const auto* side : {&lateral.surface.left, &lateral.surface.right}) {
    out.Put(side->size());
    for (const network::SurfaceStrip& strip : *side) {
      out.PutAll(strip.relative, strip.has_width, strip.width);
      for (const geometry::CubicTable& coefficient : strip.coefficients) out.Put(coefficient);
    }
  }
}

void PutLane(Stretch& out, const network::Lane& lane) {
  out.PutAll(lane.id, static_cast<int>(lane.type), lane.level, lane.width, lane.border);
  for (const network::LaneHeight& height : out.InForce(
           lane.heights, [](const network::LaneHeight& at) { return at.s_m; }, true))
    out.PutAll(height.s_m, height.inner_m, height.outer_m);
}

void PutSections(Stretch& out, const network::Road& road) {
  for (const network::LaneSection& section : road.spec().sections) {
    if (!out.Overlaps(section.s_m, section.end_s_m)) continue;
    for (const double end_s_m : {section.s_m, section.end_s_m}) {
      if (out.Overlaps(end_s_m, end_s_m)) out.Put(end_s_m);
    }
    for (const auto* side : {&section.left, &section.right}) {
      out.Put(side->size());
      for (const network::Lane& lane : *side) PutLane(out, lane);
    }
  }
}

void PutEarthworks(Stretch& out, const RoadSpec& spec) {
  for (const network::Structure& structure : spec.structures) {
    if (out.Overlaps(structure.s_m, structure.s_m + structure.length_m))
      out.PutAll(structure.bridge, structure.s_m, structure.length_m);
  }
  out.Put(spec.earthwork.has_value());
  if (spec.earthwork)
    out.PutAll(spec.earthwork->blend_m, spec.earthwork->cut, spec.earthwork->fill, spec.earthwork->reach_m);
}

// Whether something goes on at an end. Roads of an OpenDRIVE file are one ground where they have to do with one
// junction: there names count.
void PutEnd(Stretch& out, const road::World& world, const std::optional<network::RoadLink>& link) {
  out.PutAll(link.has_value(), link && link->junction);
  if (link && world.open_drive()) out.PutAll(link->id, static_cast<int>(link->contact));
  if (link && link->s_m) out.Put(*link->s_m);
}

}  // namespace

base::Digest StretchDigest(const road::World& world, std::uint32_t road_index, double from_s_m, double to_s_m) {
  const network::Road& road = world.network()->roads()[road_index];
  const RoadSpec& spec = road.spec();
  Stretch out(from_s_m, to_s_m);
  out.PutAll(!spec.junction.empty(), road.rolled(), road.flat());
  if (world.open_drive()) out.Put(spec.junction);
  if (from_s_m <= 0.0) PutEnd(out, world, spec.predecessor);
  if (to_s_m >= road.length_m()) {
    out.Put(road.length_m());
    PutEnd(out, world, spec.successor);
  }
  PutAxis(out, road);
  out.PutAll(spec.elevation, spec.superelevation, spec.lane_offset);
  PutLateral(out, spec.lateral);
  PutSections(out, road);
  PutEarthworks(out, spec);
  if (spec.ground != nullptr) out.Put(static_cast<std::size_t>(spec.ground->Digest()));
  return out.Digest();
}

base::Digest LookDigest(const road::World& world, std::uint32_t road, double from_s_m, double to_s_m,
                        PictureDigests& pictures) {
  const RoadSpec& spec = world.network()->roads()[road].spec();
  Stretch out(from_s_m, to_s_m);
  for (const network::LaneSection& section : spec.sections) {
    if (!out.Overlaps(section.s_m, section.end_s_m)) continue;
    for (const auto* side : {&section.left, &section.right}) {
      for (const network::Lane& lane : *side) {
        const auto materials = out.InForce(lane.materials, [](const LaneMaterial& at) { return at.s_m; });
        out.PutAll(lane.id, materials.size());
        for (const LaneMaterial& material : materials) {
          out.PutAll(material.s_m, material.surface, material.friction);
          if (const auto picture = PictureOf(material)) out.Put(static_cast<std::size_t>(pictures.Of(*picture)));
        }
      }
    }
  }
  for (const network::Object& object : spec.objects) {
    if (!IsLaid(object) || !out.Overlaps(object.s_m - 0.5 * object.length_m, object.s_m + 0.5 * object.length_m))
      continue;
    out.PutAll(object.type, object.subtype, object.s_m, object.t_m, object.length_m, object.width_m);
  }
  out.Put(static_cast<std::size_t>(world.DetailDigest(road, from_s_m, to_s_m)));
  return out.Digest();
}

}  // namespace rodeira::scene
