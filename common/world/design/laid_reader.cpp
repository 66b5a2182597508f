// SPDX-License-Identifier: Apache-2.0
#include "common/world/design/laid_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "common/world/design/section_reader.hpp"
#include "common/world/design/station.hpp"
#include "common/world/design/tables.hpp"

namespace rodeira::design {
namespace {

using config::DeclaredList;
using config::DeclaredMap;
using config::Map;
using network::LaidPiece;

constexpr double kLaidRounding_m = 1e-6;

// The outermost edges of the lanes that are driven on, at s.
std::pair<double, double> Driven(const network::RoadSpec& spec, double s_m) {
  double right = std::numeric_limits<double>::infinity(), left = -right;
  for (const auto* side : {&spec.sections[0].right, &spec.sections[0].left}) {
    for (const network::Lane& lane : *side) {
      if (!network::IsDrivable(lane.type)) continue;
      for (const int id : {lane.id, lane.id > 0 ? lane.id - 1 : lane.id + 1}) {
        const double t = EdgeOf(spec, id).Value(s_m);
        right = std::min(right, t), left = std::max(left, t);
      }
    }
  }
  return right < left ? std::pair(right, left) : std::pair(0.0, 0.0);
}

// From one station to another and from one t to another; across all lanes that are driven on unless said.
LaidPiece ReadPiece(const DeclaredMap& keys, double length_m, const network::RoadSpec& spec) {
  const Map& item = keys.map();
  LaidPiece piece;
  piece.from_s_m = Station(keys, "from_s_m", length_m);
  piece.to_s_m = Station(keys, "to_s_m", length_m);
  if (!(piece.to_s_m > piece.from_s_m))
    item.Problem("to_s_m", "config.wrong_order", "'to_s_m' must lie behind 'from_s_m'");
  const auto [right, left] = Driven(spec, piece.from_s_m);
  piece.right_t_m = keys.Number("from_t_m", right);
  piece.left_t_m = keys.Number("to_t_m", left);
  if (!(piece.left_t_m > piece.right_t_m))
    item.Problem("to_t_m", "config.wrong_order", "'to_t_m' must be above 'from_t_m': t grows to the left");
  const int outer_right = -static_cast<int>(spec.sections[0].right.size()),
            outer_left = static_cast<int>(spec.sections[0].left.size());
  for (const double part : {0.0, 0.5, 1.0}) {
    const double s = piece.from_s_m + part * (piece.to_s_m - piece.from_s_m);
    const double low = EdgeOf(spec, outer_right).Value(s), high = EdgeOf(spec, outer_left).Value(s);
    if (piece.right_t_m >= low - kLaidRounding_m && piece.left_t_m <= high + kLaidRounding_m) continue;
    item.Problem(piece.right_t_m < low - kLaidRounding_m ? "from_t_m" : "to_t_m", "config.out_of_range",
                 fmt::format("at s = {:.1f} m the road reaches from t = {:.2f} to {:.2f} m only", s, low, high));
    break;
  }
  return piece;
}

// OpenDRIVE's object of a piece: flat, with a corner at each of its four.
void AddObject(const char* subtype, const LaidPiece& piece, network::RoadSpec& spec) {
  network::Object object;
  object.id = fmt::format("{}-object{}", spec.id, spec.objects.size());
  object.type = "roadSurface";
  object.subtype = object.name = subtype;
  object.orientation = "none";
  object.s_m = 0.5 * (piece.from_s_m + piece.to_s_m);
  object.t_m = 0.5 * (piece.right_t_m + piece.left_t_m);
  object.length_m = piece.to_s_m - piece.from_s_m;
  object.width_m = piece.left_t_m - piece.right_t_m;
  spec.objects.push_back(std::move(object));
}

network::Patch ReadPatch(const DeclaredMap& item, const Context& context, double length_m, network::RoadSpec& spec) {
  network::Patch patch;
  patch.piece = ReadPiece(item, length_m, spec);
  const bool has_material = item.map().Has("material"), has_friction = item.map().Has("friction");
  if (!has_material && !has_friction)
    item.map().Problem("", "a patch is of another 'material', or has another 'friction', or both");
  if (has_material) {
    const Material& material = context.MaterialOf(item, "material", "asphalt");
    patch.surface = ground::SurfaceName(material.surface);
    patch.friction = material.friction;
  }
  if (has_friction) patch.friction = item.RequiredNumber("friction");
  AddObject("patch", patch.piece, spec);
  spec.objects.back().material = {patch.surface, patch.friction, ""};
  return patch;
}

// A height over s from points: straight between them, or level at each of them and by 3 u^2 - 2 u^3 between.
geometry::CubicTable ThroughKnots(const std::vector<Knot>& knots, bool straight) {
  if (!straight) return Eased(knots);
  std::vector<geometry::Cubic> records;
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    records.push_back({knots[i].s_m, knots[i].value,
                       (knots[i + 1].value - knots[i].value) / (knots[i + 1].s_m - knots[i].s_m), 0.0, 0.0});
  }
  return geometry::CubicTable(std::move(records));
}

geometry::CubicTable ReadHeights(const DeclaredMap& keys, const LaidPiece& piece) {
  const Map& item = keys.map();
  const double from = piece.from_s_m, length = piece.to_s_m - from;
  if (item.Has("heights") == item.Has("height_m")) {
    item.Problem(item.Has("heights") ? "heights" : "", "config.conflicting_keys",
                 "a bump has either one 'height_m' or a list of 'heights'");
    return Constant(0.0);
  }
  if (item.Has("height_m")) {
    const double height = keys.RequiredNumber("height_m");
    const bool round = keys.MapWith("shape").Choice("shape", {"round", "smooth"}, "round") == "round";
    if (!round) return Eased({{from, 0.0}, {from + 0.5 * length, height}, {from + length, 0.0}});
    return geometry::CubicTable(
        {{from, 0.0, 4.0 * height / length, -4.0 * height / (length * length), 0.0}});  // the parabola
  }
  std::vector<Knot> knots = ReadKnots(keys, "heights", "z_m");
  const bool straight = keys.MapWith("shape").Choice("shape", {"straight", "smooth"}, "straight") == "straight";
  const bool whole =
      knots.size() > 1 && knots.front().s_m == 0.0 && std::fabs(knots.back().s_m - length) < kLaidRounding_m;
  if (!whole || knots.front().value != 0.0 || knots.back().value != 0.0) {
    item.Problem(
        "heights",
        fmt::format("'heights' must begin at s_m 0 and end at s_m {:g}, as the bump does, with z_m 0 at both", length));
    return Constant(0.0);
  }
  for (Knot& knot : knots) knot.s_m += from;
  return ThroughKnots(knots, straight);
}

network::Bump ReadBump(const DeclaredMap& item, double length_m, network::RoadSpec& spec) {
  network::Bump bump;
  bump.piece = ReadPiece(item, length_m, spec);
  bump.side_m = item.Number("side_m");
  if (2.0 * bump.side_m > bump.piece.left_t_m - bump.piece.right_t_m)
    item.map().Problem("side_m", "config.wrong_order", "the bump is narrower than twice its 'side_m'");
  bump.height = bump.piece.to_s_m > bump.piece.from_s_m ? ReadHeights(item, bump.piece) : Constant(0.0);
  AddObject("speedBump", bump.piece, spec);
  return bump;
}

}  // namespace

network::Laid ReadLaid(const DeclaredMap& road, const Context& context, double length_m, network::RoadSpec& spec) {
  network::Laid laid;
  const DeclaredList patches = road.Items("patches");
  for (std::size_t i = 0; i < patches.size(); ++i)
    laid.patches.push_back(ReadPatch(patches.At(i), context, length_m, spec));
  const DeclaredList bumps = road.Items("bumps");
  for (std::size_t i = 0; i < bumps.size(); ++i) laid.bumps.push_back(ReadBump(bumps.At(i), length_m, spec));
  return laid;
}

}  // namespace rodeira::design
