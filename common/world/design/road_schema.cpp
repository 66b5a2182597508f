// SPDX-License-Identifier: Apache-2.0
#include "common/world/design/road_schema.hpp"

#include <string>
#include <utility>

#include "common/world/design/common_keys.hpp"
#include "common/world/design/furniture_schema.hpp"
#include "common/world/design/laid_schema.hpp"
#include "common/world/design/section_schema.hpp"

namespace rodeira::design {
namespace {

using config::ComputedNumberKey;
using config::Counted;
using config::Key;
using config::ListKey;
using config::MappingKey;
using config::NumberKey;
using config::Range;
using config::Required;
using config::RequiredNumberKey;
using config::RequiredTextKey;
using config::Summarised;
using config::WithDefaultNote;
using config::WithSample;
using config::WordKey;

constexpr Range kStatedLength_m{0.01, 100'000.0}, kRadius_m{-1e7, 1e7};

Key LengthKey(const char* instead) {
  return ComputedNumberKey("length_m", kStatedLength_m, std::string("or ") + instead, "Length.");
}

const std::vector<Key>& AxisKeys() {
  static const std::vector<Key> keys{
      MappingKey("line", {RequiredNumberKey("length_m", kStatedLength_m, "Length.")}, "Straight line."),
      MappingKey(
          "arc",
          {WithSample("100", RequiredNumberKey("radius_m", kRadius_m, "Radius, positive to the left; 5 m or more.")),
           LengthKey("`turn_deg`"),
           ComputedNumberKey("turn_deg", {0.001, 3600.0}, "or `length_m`", "Angle of the arc.")},
          "Arc."),
      MappingKey("clothoid",
                 {ComputedNumberKey("radius_start_m", kRadius_m, "straight", "Radius at its beginning, as of an arc."),
                  ComputedNumberKey("radius_end_m", kRadius_m, "straight", "Radius at its end, as of an arc."),
                  LengthKey("`a_m`"),
                  ComputedNumberKey("a_m", {0.1, 1e5}, "or `length_m`", "A: length = A² × change of curvature.")},
                 "Clothoid."),
      MappingKey("from",
                 {RequiredNumberKey("x_m", kPlace_m, "Own beginning, to the east."),
                  RequiredNumberKey("y_m", kPlace_m, "Own beginning, to the north."),
                  RequiredNumberKey("heading_deg", kTurn_deg, "Own heading, from east to north.")},
                 "Own place of an element.")};
  return keys;
}

Key PointsOfAxisKey() {
  return MappingKey(
      "points",
      {config::ComputedTextKey("file", "or `list`", "track.csv", "CSV of points."),
       config::WithDefaultNote(
           "or `file`", WithSample("[[0, 0], [100, 0]]",
                                   ListKey("list", config::OtherKey("", "[x, y] or [x, y, z]", "[0, 0], [100, 0]", ""),
                                           "Points, two or more."))),
       config::FlagKey("smooth", true, "A cubic spline; else straight pieces with rounded corners."),
       NumberKey("within_m", {0.001, 10.0}, 0.05, "How near the rounded corners pass the points.")},
      "Instead of `axis`.");
}

Key LinkKey(const char* name, const char* sample, const char* end, const char* meaning) {
  return MappingKey(name,
                    {RequiredTextKey("road", sample, "Road that goes on there."),
                     WordKey("end", {"start", "end"}, end, "End of that road.")},
                    meaning);
}

std::vector<Key> PlanKeys() {
  return {MappingKey("start",
                     {NumberKey("x_m", kPlace_m, 0.0, "Beginning, to the east."),
                      NumberKey("y_m", kPlace_m, 0.0, "Beginning, to the north."),
                      NumberKey("heading_deg", kTurn_deg, 0.0, "Heading, from east to north.")},
                     "Beginning of the road."),
          MappingKey("place",
                     {RequiredTextKey("road", "other", "Earlier road."),
                      RequiredNumberKey("s_m", {0.0, 1e7}, "Station of that road."),
                      RequiredNumberKey("turn_deg", kTurn_deg, "Angle between the roads, to the left."),
                      NumberKey("own_s_m", Range::NotNegative(), 0.0, "Station of this road.")},
                     "Instead of `start`."),
          WithDefaultNote("or `points`",
                          WithSample("[{line: {length_m: 100}}]",
                                     Counted(1, kAnyNumber, ListKey("axis", AxisKeys(), "Elements of the axis.")))),
          PointsOfAxisKey()};
}

std::vector<Key> ProfileKeys() {
  return {
      Counted(1, kAnyNumber,
              ListKey("vertical",
                      {RequiredNumberKey("s_m", kPlace_m, "Station where two grades meet, ascending."),
                       RequiredNumberKey("z_m", kHeight_m, "Height there."),
                       NumberKey("parabola_m", Range::NotNegative(), 0.0, "Length of the parabola that rounds it.")},
                      "Grades; one point is a level road.")),
      ComputedNumberKey("z_m", kHeight_m, "0, or of `place`", "One height, instead of `vertical`."),
      PointsKey("superelevation", "slope", {-0.2, 0.2}, "Tangent of the roll; positive if the left side is higher."),
      config::OptionalNumberKey("speed_limit_kmh", kSpeed_kmh, "Speed limit of the road."),
      PointsKey("speed_limits", "speed_kmh", kSpeed_kmh, "Speed limit from there on.")};
}

std::vector<Key> MakeRoadKeys() {
  std::vector<Key> keys{
      RequiredTextKey("id", "made", "Id, without '/'."),
      config::ComputedTextKey("name", "the id", "Mill road", "Name, for the reader."),
      WordKey("kind", {"rural", "town", "motorway", "lowSpeed", "pedestrian", "bicycle", "unknown"}, "rural",
              "Kind of road."),
      WithDefaultNote("that of the file", config::OptionalWordKey("rule", {"right", "left"}, "Side of traffic."))};
  const auto add = [&](std::vector<Key> more) {
    for (Key& key : more) keys.push_back(std::move(key));
  };
  add(PlanKeys());
  add(ProfileKeys());
  add({Required(Summarised("as `world.section`", MappingKey("section", SectionKeys(), "Cross-section."))),
       ListKey("lines", Summarised("as of `world.section`", MappingKey("", LineKeys(), "Instead of the section's.")),
               "Painted lines."),
       ListKey("markings", MarkingItem(), "Markings across the road."), ListKey("signs", SignKeys(), "Signs."),
       ListKey("objects", ObjectKeys(), "Objects."), ListKey("bridges", StructureKeys(), "Bridges."),
       ListKey("tunnels", Summarised("as of `bridges`", MappingKey("", StructureKeys(), "Tunnels.")), "Tunnels."),
       ListKey("surfaces", SurfaceKeys(), "Rough or measured surfaces."),
       ListKey("patches", PatchKeys(), "Patches; the last one counts."),
       ListKey("bumps", BumpKeys(), "Bumps, which add up."),
       LinkKey("predecessor", "before", "end", "Road that this one begins at."),
       LinkKey("successor", "after", "start", "Road that this one ends at.")});
  return keys;
}

}  // namespace

const std::vector<Key>& RoadKeys() {
  static const std::vector<Key> keys = MakeRoadKeys();
  return keys;
}

const std::vector<Key>& ElementKeys(std::string_view kind) { return config::FindKey(AxisKeys(), kind)->of; }

}  // namespace rodeira::design
