// SPDX-License-Identifier: Apache-2.0
// World files of version 2, mutated by bytes and by structure (tests/property/fuzz.hpp): what is taken is a world that
// answers finite numbers, the same ones by index and without it; what is refused is a sentence.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "common/core/base/files.hpp"
#include "common/world/network/placing.hpp"
#include "common/world/road/network_world.hpp"
#include "common/world/road/world.hpp"
#include "common/world/road/world_report.hpp"
#include "common/world/surface/crg_file.hpp"
#include "tests/common/world/opendrive/sample.hpp"
#include "tests/common/world/surface/made_crg.hpp"
#include "tests/property/fuzz.hpp"
#include "tests/property/mutate_structure.hpp"
#include "tests/tree.hpp"

namespace rodeira::property {
namespace {

const std::filesystem::path kExample = std::filesystem::path(SourceDir()) / "configs/worlds/example";

// Small, with most of what a file may say; the files beside the example are beside this one too.
constexpr const char* kHills = R"(rodeira: world/2
name: small
rule: right
friction: {asphalt: 0.9}
materials: {worn: {surface: asphalt, friction: 0.85, texture: worn.png}}
terrain:
  generate: {seed: 9, columns: 12, rows: 10, spacing_m: 40, west_m: -220, south_m: -180,
    relief: [{wavelength_m: 200, amplitude_m: 5}]}
start: {road: main, lane: -1, s_m: 20}
templates: {lane: {lanes: [{id: -1, width_m: 3}], verge: {width_m: 1}}}
roads:
  - id: main
    start: {x_m: -150, y_m: 0, heading_deg: 5}
    axis:
      - line: {length_m: 160}
      - clothoid: {a_m: 60, radius_end_m: -120}
      - arc: {length_m: 40, radius_m: -120}
    vertical: [{s_m: 0, z_m: 2}, {s_m: 100, z_m: 4, parabola_m: 60}, {s_m: 200, z_m: 3}]
    superelevation: [{s_m: 150, slope: 0}, {s_m: 190, slope: 0.04}]
    speed_limits: [{s_m: 0, speed_kmh: 90}, {s_m: 120, speed_kmh: 70}]
    section:
      template: rural
      lanes:
        - {id: -2, type: sidewalk, width_m: 1.5, kerb_m: 0.12}
        - {id: -1, widths: [{s_m: 0, width_m: 3.5}, {s_m: 90, width_m: 4}], material: worn, fall: 0.03}
        - {id: 1, width_m: 3.5, direction: against, speed_limit_kmh: 80}
      crossfalls: [{s_m: 100, left: 0.025, right: 0.025}, {s_m: 150, left: 0, right: 0}]
      offsets: [{s_m: 0, t_m: 0}, {s_m: 150, t_m: 0.25}]
      slopes: {cut: 1.5, fill: 2, reach_m: 30}
    lines:
      - {lane: 0, kind: mixed, left: dashed, right: continuous, to_s_m: 120}
      - {ts: [{s_m: 100, t_m: 3.4}, {s_m: 160, t_m: 3}], kind: dashed_warn, colour: yellow}
    signs: [{type: speed_limit, value: 70, s_m: 100}, {type: chevron, t_m: 6, from_s_m: 170, every_m: 10}]
    objects: [{type: tree, t_m: 14, from_s_m: 50, every_m: 15, to_s_m: 150}, {type: guard_rail, side: left,
      from_s_m: 160}]
    bridges: [{from_s_m: 170, to_s_m: 180}]
    patches: [{from_s_m: 20, to_s_m: 40, to_t_m: 1, friction: 0.2}, {from_s_m: 30, to_s_m: 50, material: worn}]
    bumps: [{from_s_m: 30, to_s_m: 34, height_m: 0.1}, {from_s_m: 42, to_s_m: 48,
      heights: [{s_m: 0, z_m: 0}, {s_m: 3, z_m: 0.1}, {s_m: 6, z_m: 0}]}]
    surfaces: [{iso_8608: B, seed: 7, from_s_m: 10, to_s_m: 30}, {crg: bumps.crg, from_s_m: 120, to_s_m: 140}]
  - id: street
    place: {road: main, s_m: 80, turn_deg: 80, own_s_m: 0}
    axis: [line: {length_m: 90}]
    section: {template: lane}
junctions:
  - {id: corner, roads: [{road: main, s_m: 80}, {road: street, end: start}], radius_m: 6, fit_m: 40}
weather: {hour: 18, clouds: 0.5, wetness: 0.2, visibility_m: 3000}
objects:
  - {type: house, x_m: 20, y_m: 60, heading_deg: 30, model: bumps.crg}
  - {type: tree, along: [[-100, 60], [0, 80], [60, 70]], every_m: 9, rotation_deg: 4}
)";

constexpr const char* kBare = R"(rodeira: world/2
name: bare
terrain:
  generate: {seed: 9, columns: 12, rows: 10, spacing_m: 40, west_m: -220, south_m: -180,
    relief: [{wavelength_m: 200, amplitude_m: 5}]}
objects:
  - {type: lamp, x_m: 20, y_m: 60, z_m: 0.5, height_m: 6}
  - {type: wall, along: [[-100, 60], [0, 80], [60, 70]], height_m: 2}
  - {type: bush, along: [[0, 0], [9, 9]], every_m: 3, radius_m: 1}
)";

constexpr const char* kPlane = R"(rodeira: world/2
name: plane
ground: {kind: plane, z_m: 1, slope_x: 0.01}
rule: left
roads:
  - id: a
    points: {file: track.csv, smooth: true}
    section: {template: bypass, crossfall: {kind: left, fall: 0.03}}
  - id: b
    z_m: 24
    points: {list: [[180, -215], [240, -215], [330, -208]], smooth: false, within_m: 0.1}
    section: {template: motorway, offset_m: 0.2}
    signs: [{type: town, text: "A", s_m: 60}]
  - id: c
    start: {x_m: -350, y_m: -320}
    axis: [line: {length_m: 80}]
    section: {template: rural}
    successor: {road: d, end: start}
  - id: d
    start: {x_m: -270, y_m: -320}
    axis: [line: {length_m: 60}, arc: {turn_deg: 20, radius_m: 50}]
    section: {template: rural}
    predecessor: {road: c, end: end}
)";

constexpr const char* kIncluding = R"(rodeira: world/2
name: two files
ground: {kind: plane}
include: [village.yaml]
roads:
  - id: main
    start: {x_m: -160, y_m: 3, heading_deg: 2}
    axis: [line: {length_m: 250}]
    section: {template: rural}
)";

// Everything of a world that stands at a point, and at the places that its own network names.
void AskWorld(const road::World& world) {
  std::vector<ground::GroundQuery> queries;
  const auto ask = [&](double x, double y) { queries.push_back({x, y, 3.0}); };
  for (const double x : {-140.0, -71.0, -40.25, 37.5, 1e6, -1e300}) {
    for (const double y : {0.0, 6.5, 40.0}) ask(x, y);
  }
  const network::Network* roads = world.network();
  if (roads != nullptr) {
    for (const network::Road& one : roads->roads()) {
      for (const double share : {0.0, 0.31, 1.0}) {
        const network::SurfaceSample at = one.Surface(share * one.length_m(), 0.7);
        EXPECT_TRUE(at.p_W.allFinite());
        ask(at.p_W.x(), at.p_W.y());
      }
    }
  }
  if (const network::Props* props = world.props()) {
    for (const auto& thing : props->placements) {
      EXPECT_TRUE(thing.at_W.allFinite() && std::isfinite(thing.heading_rad) && thing.object < props->objects.size());
      ask(thing.at_W.x(), thing.at_W.y());
    }
    for (const auto& run : props->runs) EXPECT_GE(run.points_W.size(), 2u);
  }
  const auto ground = world.MakeGround();
  std::vector<ground::GroundPoint> points(queries.size());
  ground->Query(queries, points);
  for (const auto& point : points) {
    EXPECT_TRUE(!point.inside ||
                (std::isfinite(point.z_m) && std::isfinite(point.normal_W.x()) && point.friction > 0.0))
        << point.z_m;
  }
  EXPECT_FALSE(road::DescribePoint(world, queries[0].x_m, queries[0].y_m).empty());
  if (roads == nullptr) return;
  for (const auto& query : queries) {
    const auto place = roads->Locate(query.x_m, query.y_m, 0.5), slow = roads->LocateSlowly(query.x_m, query.y_m, 0.5);
    ASSERT_EQ(place.has_value(), slow.has_value());
    if (place) {
      EXPECT_LE(place->distance_m, slow->distance_m);
    }
  }
  for (const network::LaneKey& key : roads->Lanes())
    EXPECT_TRUE(roads->Centre(key, roads->Section(key).s_m).allFinite());
  const network::Furniture furniture = network::PlaceFurniture(*roads);
  for (const auto& thing : furniture.things) EXPECT_TRUE(thing.foot_W.allFinite());
}

std::optional<base::Error> ReadWorld(const std::string& text) {
  const auto world = road::World::Parse(text, kExample / "fuzz.yaml");
  if (!world) return world.error();
  AskWorld(*world.value());
  return std::nullopt;
}

TEST(WorldFiles, ChangedByBytes) { Fuzz("world of version 2", {kHills, kPlane, kIncluding, kBare}, ReadWorld); }

// OpenDRIVE files as worlds: with measured surfaces (attached, attached0, genuine, global, and friction alone), signs
// and objects; what is taken is the world that is driven on.
TEST(WorldFiles, OpenDriveOnDisk) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("rodeira-world-property-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  surface::MadeCrg made;
  made.rows = 201;
  made.z = [](double u, double v) { return 0.01 * std::sin(u) + 0.002 * v; };
  ASSERT_TRUE(base::WriteWhole(folder / "made.crg", std::string_view(made.Text())).ok());
  made.road_keys = "REFERENCE_LINE_START_X = 20\nREFERENCE_LINE_START_Y = 2\nREFERENCE_LINE_START_PHI = 0.1\n";
  ASSERT_TRUE(base::WriteWhole(folder / "placed.crg", std::string_view(made.Text())).ok());
  const auto measured = [](const std::string& surfaces) {
    opendrive::RoadText road;
    road.geometry =
        R"(<geometry s="0" x="0" y="0" hdg="0.1" length="40"><line/></geometry>
            <geometry s="40" x="39.8001666" y="3.9933367" hdg="0.1" length="60"><arc curvature="0.01"/></geometry>)";
    road.elevation =
        R"(<elevation s="0" a="1" b="0.02" c="0" d="0"/><elevation s="50" a="2" b="0.02" c="-0.0001" d="0"/>)";
    road.more = "<surface>" + surfaces +
                R"(</surface><objects><object id="o" s="10" t="8" type="tree" height="6" radius="1"/>
            <object id="b" s="30" t="6" type="barrier" length="1" width="0.2" height="1">
        <repeat s="30" length="40" distance="0" tStart="6" tEnd="7" heightStart="1" heightEnd="1" zOffsetStart="0"
          zOffsetEnd="0"/></object></objects>
        <signals><signal id="s" s="90" t="-5" dynamic="no" orientation="+" type="274" subtype="-1" value="50"/>
          </signals>)";
    return opendrive::Document(road.Text());
  };
  const std::vector<std::string> good = {
      measured(
          R"(<CRG file="made.crg" sStart="5" sEnd="6.5" mode="attached" zScale="0.5" sOffset="0.1"/>
              <CRG file="made.crg" sStart="20" sEnd="21.5" mode="attached0" orientation="opposite"/>)"),
      measured(
          R"(<CRG file="made.crg" sStart="60" sEnd="61.5" mode="genuine" tOffset="0.2" hOffset="0.01" zOffset="1"/>)"),
      measured(
          R"(<CRG file="placed.crg" sStart="18" sEnd="60" mode="global" zOffset="1.4"/>
              <CRG file="placed.crg" sStart="60" sEnd="90" mode="global" orientation="opposite" purpose="friction"
              zOffset="0.5"/>)"),
      measured(R"(<CRG file="made.crg" sStart="5" sEnd="6.5" mode="attached" purpose="friction" zOffset="0.5"/>)")};
  {
    // The good one of them that lies where it says itself, lies under its road.
    ASSERT_TRUE(base::WriteWhole(folder / "fuzz.xodr", std::string_view(good[2])).ok());
    const auto world = road::World::Load(folder / "fuzz.xodr");
    ASSERT_TRUE(world.ok()) << world.error().Text();
    const double u = 10.0, v = 0.5, x = 20.0 + u * std::cos(0.1) - v * std::sin(0.1),
                 y = 2.0 + u * std::sin(0.1) + v * std::cos(0.1);
    EXPECT_NEAR(world.value()->At(x, y).z_m, 1.4 + 0.01 * std::sin(u) + 0.002 * v, 1e-4);
  }
  Fuzz("xodr as a world", good, [&](const std::string& text) -> std::optional<base::Error> {
    if (const auto written = base::WriteWhole(folder / "fuzz.xodr", std::string_view(text)); !written.ok())
      ADD_FAILURE() << written.error().Text();
    const auto world = road::World::Load(folder / "fuzz.xodr");
    if (!world) return world.error();
    AskWorld(*world.value());
    return std::nullopt;
  });
  std::filesystem::remove_all(folder);
}

// OpenCRG files, mutated, as they lie on a road: each mode, either way round, and as friction. What is taken answers
// finite numbers.
TEST(WorldFiles, MeasuredSurfacesOnARoad) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("rodeira-laid-property-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  opendrive::RoadText road;
  road.geometry = R"(<geometry s="0" x="0" y="0" hdg="0.1" length="100"><arc curvature="0.002"/></geometry>)";
  road.elevation = R"(<elevation s="0" a="1" b="0.02" c="0" d="0"/>)";
  std::string surfaces;
  double s = 2.0;
  for (const char* mode : {"attached", "attached0", "genuine", "global"}) {
    for (const char* orientation : {"same", "opposite"}) {
      // What lies where it says itself is asked all along the road.
      const bool global = std::string_view(mode) == "global";
      surfaces += fmt::format(
          "<CRG file=\"fuzz.crg\" sStart=\"{}\" sEnd=\"{}\" mode=\"{}\" orientation=\"{}\" zOffset=\"0.1\"/>",
          global ? 1.0 : s, global ? 99.0 : s + 8.0, mode, orientation);
      s += 10.0;
    }
  }
  surfaces += R"(<CRG file="fuzz.crg" sStart="1" sEnd="99" mode="global" purpose="friction" zOffset="0.6"/>)";
  road.more = "<surface>" + surfaces + "</surface>";
  ASSERT_TRUE(base::WriteWhole(folder / "fuzz.xodr", std::string_view(opendrive::Document(road.Text()))).ok());
  std::vector<std::string> good;
  for (const char* format : {"LRFI", "LDFI", "KRBI", "KDBI"}) {
    surface::MadeCrg made;
    made.format = format;
    made.rows = 17;
    made.heading = [](double u) { return 0.1 + 0.002 * u; };
    made.z = [](double u, double v) { return u > 6.0 && v > 1.5 ? std::nan("") : 0.01 * u + 0.002 * v; };
    made.road_keys = "REFERENCE_LINE_START_X = 70\nREFERENCE_LINE_START_Y = 10\nREFERENCE_LINE_START_PHI = 0.1\n";
    made.sections =
        "$ROAD_CRG_OPTS\nBORDER_MODE_U = 3\nBORDER_MODE_V = 4\nREFLINE_CONTINUATION = "
        "1\n$\n$ROAD_CRG_MODS\nSCALE_LENGTH = 1.1\nGRID_NAN_MODE = 2\nREFPOINT_U_FRACTION = 0.5\nREFPOINT_X = 72\n$\n";
    good.push_back(made.Text());
    made.sections.clear();
    good.push_back(made.Text());
  }
  Fuzz("OpenCRG on a road", good, [&](const std::string& text) -> std::optional<base::Error> {
    if (const auto written = base::WriteWhole(folder / "fuzz.crg", std::string_view(text)); !written.ok())
      ADD_FAILURE() << written.error().Text();
    const auto world = road::World::Load(folder / "fuzz.xodr");
    if (!world) return world.error();
    const network::Road& on = world.value()->network()->roads()[0];
    for (double at = 0.5; at < 100.0; at += 3.3) {
      for (const double t : {-3.1, -0.4, 1.9}) {
        const Eigen::Vector3d p = on.Surface(at, t).p_W;
        const road::SurfacePoint ground = world.value()->At(p.x(), p.y());
        EXPECT_TRUE(std::isfinite(ground.z_m) && std::isfinite(ground.slope_x) && std::isfinite(ground.slope_y) &&
                    ground.friction >= 0.0 && ground.friction <= 2.0)
            << at << " " << t;
      }
    }
    // What is damaged has been left out of the world.
    const auto file = surface::LoadCrg(folder / "fuzz.crg");
    return file ? std::nullopt : std::optional(file.error());
  });
  std::filesystem::remove_all(folder);
}

TEST(WorldFiles, ChangedByStructure) {
  Fuzz("world of version 2, structure", {kHills, kPlane, kIncluding, kBare}, ReadWorld, MutateStructure);
}

}  // namespace
}  // namespace rodeira::property
