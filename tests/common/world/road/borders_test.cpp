// SPDX-License-Identifier: Apache-2.0
// Lanes with borders: against the same road written with widths from polynomials that are worked out here, and SUMO's
// netconvert.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <pugixml.hpp>
#include <set>
#include <sstream>

#include "common/core/base/files.hpp"
#include "common/core/base/random.hpp"
#include "common/world/road/world.hpp"
#include "tests/common/world/opendrive/sample.hpp"
#include "tests/names.hpp"

namespace rodeira::road {
namespace {

using opendrive::Document;
using opendrive::RoadText;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct Record {
  double from, a, b, c, d;
};
using Records = std::vector<Record>;

Record InForce(const Records& records, double s) {
  Record found = records.front();
  for (const Record& record : records) {
    if (record.from <= s) found = record;
  }
  return found;
}

// The same polynomial, counted from another place: Taylor's formula.
Record CountedFrom(const Record& record, double s) {
  const double u = s - record.from;
  return {s, record.a + record.b * u + record.c * u * u + record.d * u * u * u,
          record.b + 2.0 * record.c * u + 3.0 * record.d * u * u, record.c + 3.0 * record.d * u, record.d};
}

std::string Text(const char* element, const Records& records) {
  std::string text;
  for (const Record& r : records)
    text +=
        fmt::format("<{} sOffset=\"{}\" a=\"{}\" b=\"{}\" c=\"{}\" d=\"{}\"/>", element, r.from, r.a, r.b, r.c, r.d);
  return text;
}

// The lanes of one side from inside outward, by borders and by widths. `centre`: where the centre lane lies, the same
// everywhere.
struct Side {
  std::vector<Records> borders;

  std::string Lanes(bool by_border, int sign, double centre = 0.0) const {
    std::string text;
    for (std::size_t k = 0; k < borders.size(); ++k) {
      Records widths;
      std::set<double> begins;
      const Records inner = k == 0 ? Records{{0.0, centre, 0.0, 0.0, 0.0}} : borders[k - 1];
      for (const Record& r : borders[k]) begins.insert(r.from);
      for (const Record& r : inner) begins.insert(r.from);
      for (const double s : begins) {
        const Record out = CountedFrom(InForce(borders[k], s), s), in = CountedFrom(InForce(inner, s), s);
        widths.push_back(
            {s, sign * (out.a - in.a), sign * (out.b - in.b), sign * (out.c - in.c), sign * (out.d - in.d)});
      }
      text +=
          fmt::format("<lane id=\"{}\" type=\"{}\">{}</lane>\n", sign * static_cast<int>(k + 1),
                      k == 0 ? "driving" : "shoulder", by_border ? Text("border", borders[k]) : Text("width", widths));
    }
    return text;
  }
};

// Every lane's edge changes by other polynomials, at other places.
const Side kLeft{{{{0.0, 3.2, 0.01, 0.0, 0.0}, {37.0, 3.57, 0.0, 1e-3, -1e-5}}, {{0.0, 5.0, 0.0, 2e-4, 1e-6}}}};
const Side kRight{{{{0.0, -3.5, 0.0, 0.0, 0.0}, {20.0, -3.5, -0.02, 1e-4, 0.0}, {60.0, -4.14, 0.005, 0.0, 1e-6}},
                   {{0.0, -6.0, 0.0, 0.0, 0.0}, {45.0, -6.0, -0.01, 0.0, 0.0}},
                   {{0.0, -8.0, -0.004, 0.0, -1e-6}}}};

// A clothoid that climbs and leans, with a crown.
RoadText Bend(bool by_border) {
  RoadText road;
  road.geometry =
      R"(<geometry s="0" x="12" y="-7" hdg="0.4" length="100"><spiral curvStart="0.002" curvEnd="0.015"/></geometry>)";
  road.elevation = R"(<elevation s="0" a="3" b="0.04" c="-3e-4" d="0"/>)";
  road.lateral =
      R"(<superelevation s="0" a="0.01" b="5e-4" c="0" d="0"/><shape s="0" t="-12" a="-0.2" b="0.02" c="0" d="0"/>
          <shape s="0" t="0" a="0.04" b="-0.02" c="0" d="0"/>)";
  road.left = kLeft.Lanes(by_border, 1);
  road.right = kRight.Lanes(by_border, -1);
  return road;
}

class Borders : public testing::Test {
 protected:
  Borders() { std::filesystem::create_directories(folder_); }
  ~Borders() override { std::filesystem::remove_all(folder_); }
  std::shared_ptr<const World> MustLoad(const std::string& text, const char* name) const {
    EXPECT_TRUE(base::WriteWhole(folder_ / name, std::string_view(text)).ok());
    auto world = World::Load(folder_ / name);
    EXPECT_TRUE(world.ok()) << world.error().Text();
    return world.ok() ? world.value() : nullptr;
  }
  // The same lanes at every station, the same place, height, normal and ground on and beside the road.
  void ExpectTheSame(const World& a, const World& b) const {
    const network::Network &one = *a.network(), &other = *b.network();
    for (const network::LaneKey& key : one.Lanes()) {
      for (double s = 0.0; s <= 100.0; s += 0.37) {
        const auto x = one.Span(key, s), y = other.Span(key, s);
        ASSERT_TRUE(x && y);
        EXPECT_NEAR(x->inner_t_m, y->inner_t_m, 1e-9) << key.lane << " " << s;
        EXPECT_NEAR(x->outer_t_m, y->outer_t_m, 1e-9) << key.lane << " " << s;
        EXPECT_NEAR(x->inner_slope, y->inner_slope, 1e-9);
        EXPECT_NEAR(x->outer_slope, y->outer_slope, 1e-9);
      }
    }
    const auto [low, high] = one.Bounds();
    int on = 0;
    for (std::uint64_t i = 0; i < 20000; ++i) {
      const double x = base::RandomUniform({i, 1}, low.x() - 5.0, high.x() + 5.0),
                   y = base::RandomUniform({i, 2}, low.y() - 5.0, high.y() + 5.0);
      const auto p = one.Locate(x, y), q = other.Locate(x, y);
      ASSERT_EQ(p.has_value(), q.has_value());
      if (!p) continue;
      EXPECT_EQ(p->lane, q->lane) << x << " " << y;
      EXPECT_NEAR(p->s_m, q->s_m, 1e-9);
      EXPECT_NEAR(p->t_m, q->t_m, 1e-9);
      EXPECT_NEAR(p->distance_m, q->distance_m, 1e-9);
      const SurfacePoint ground = a.At(x, y), same = b.At(x, y);
      EXPECT_NEAR(ground.z_m, same.z_m, 1e-9);
      EXPECT_NEAR(ground.slope_x, same.slope_x, 1e-9);
      EXPECT_NEAR(ground.slope_y, same.slope_y, 1e-9);
      EXPECT_EQ(ground.surface, same.surface);
      EXPECT_EQ(ground.friction, same.friction);
      on += p->distance_m == 0.0 ? 1 : 0;
    }
    EXPECT_GT(on, 1000);
  }
  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("rodeira-borders-" + std::to_string(::getpid()));
};

TEST_F(Borders, AreTheSameRoadAsItsWidths) {
  const auto by_border = MustLoad(Document(Bend(true).Text()), "borders.xodr"),
             by_width = MustLoad(Document(Bend(false).Text()), "widths.xodr");
  ASSERT_TRUE(by_border && by_width);
  EXPECT_NEAR(by_border->network()->Span({0, 0, 2}, 50.0)->outer_t_m, 5.0 + 2e-4 * 2500.0 + 1e-6 * 125000.0, 1e-12);
  ExpectTheSame(*by_border, *by_width);
}

// A border is t: where the centre lane lies is nothing to it (ASAM: t_border(ds)); a file that has both is told.
TEST_F(Borders, AreNotMovedByALaneOffset) {
  const Side left{{{{0.0, 5.0, 0.0, 0.0, 0.0}}, {{0.0, 7.0, 0.01, 0.0, 0.0}}}},
      right{{{{0.0, -1.0, 0.0, 0.0, 0.0}}, {{0.0, -4.0, 0.0, 0.0, 0.0}}}};
  const auto text = [&](bool by_border) {
    RoadText road;
    road.offset = R"(<laneOffset s="0" a="1.5" b="0" c="0" d="0"/>)";
    road.left = left.Lanes(by_border, 1, 1.5), road.right = right.Lanes(by_border, -1, 1.5);
    return Document(road.Text());
  };
  const auto by_border = MustLoad(text(true), "borders.xodr"), by_width = MustLoad(text(false), "widths.xodr");
  ASSERT_TRUE(by_border && by_width);
  ExpectTheSame(*by_border, *by_width);
  const auto import = opendrive::MustImport(text(true));
  ASSERT_EQ(import.warnings.size(), 1u);
  EXPECT_EQ(import.warnings[0].Text(),
            "road.lane.border.exclusive_offset_border: road 1, s 0: lane 1 has a <border>, and the road a "
            "<laneOffset>: it moves the centre lane, and no border");
}

// netconvert of SUMO 1.15 does not know borders; of the same road by widths it finds the lanes that we find by borders.
TEST_F(Borders, LieWhereNetconvertFindsTheirWidths) {
  if (std::system("command -v netconvert > /dev/null 2>&1") != 0) GTEST_SKIP() << "SUMO's netconvert is not installed";
  const Side left{{{{0.0, 3.25, 0.0, 0.0, 0.0}}}}, right{{{{0.0, -3.5, 0.0, 0.0, 0.0}}, {{0.0, -7.25, 0.0, 0.0, 0.0}}}};
  const auto text = [&](bool by_border) {
    RoadText road;
    road.geometry = R"(<geometry s="0" x="0" y="0" hdg="0" length="100"><arc curvature="0.01"/></geometry>)";
    road.left = left.Lanes(by_border, 1), road.right = right.Lanes(by_border, -1);
    std::size_t at;
    while ((at = road.right.find("shoulder")) != std::string::npos) road.right.replace(at, 8, "driving");
    return Document(road.Text());
  };
  const auto world = MustLoad(text(true), "borders.xodr");
  ASSERT_TRUE(base::WriteWhole(folder_ / "it.xodr", std::string_view(text(false))).ok());
  const std::string command =
      "cd " + folder_.string() +
      " && { [ -n \"$SUMO_HOME\" ] || [ ! -d /usr/share/sumo ] || export SUMO_HOME=/usr/share/sumo; } && netconvert "
      "--opendrive-files it.xodr --output-file it.net.xml > log 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0) << base::ReadText(folder_ / "log").value();
  pugi::xml_document document;
  ASSERT_TRUE(document.load_file((folder_ / "it.net.xml").c_str()));
  // Its edges: -1 along s, with lane 0 as the outermost, and 1 against s.
  const std::map<std::string, int> lanes = {{"-1_0", -2}, {"-1_1", -1}, {"1_0", 1}};
  std::size_t found = 0;
  for (const pugi::xml_node& edge : document.child("net").children("edge")) {
    for (const pugi::xml_node& lane : edge.children("lane")) {
      const auto ours = lanes.find(lane.attribute("id").value());
      if (ours == lanes.end()) continue;
      ++found;
      EXPECT_NEAR(lane.attribute("width").as_double(), world->network()->Span({0, 0, ours->second}, 50.0)->width_m(),
                  0.005 + 1e-9)
          << ours->first;  // it writes centimetres
      // The middle of the lane, every few metres, in centimetres.
      std::istringstream shape(lane.attribute("shape").value());
      int points = 0;
      char comma = 0;
      for (double x = 0.0, y = 0.0; shape >> x >> comma >> y; ++points) {
        const auto place = world->network()->Locate(x, y);
        ASSERT_TRUE(place.has_value());
        EXPECT_EQ(place->lane.lane, ours->second) << x << " " << y;
        EXPECT_NEAR(place->t_m, world->network()->Span(place->lane, place->s_m)->centre_t_m(),
                    0.005 * std::sqrt(2.0) + 2e-3)
            << x << " " << y;  // rounded, and on chords of 2 m
      }
      EXPECT_GE(points, 40) << ours->first;
    }
  }
  EXPECT_EQ(found, lanes.size());
}

TEST(BordersToldOf, ABorderWithinTheLaneInsideIsNamedWithRoadLaneAndPlace) {
  const auto text = [](const std::string& outer) {
    RoadText road;
    road.right =
        Side{{{{0.0, -3.5, 0.0, 0.0, 0.0}}}}.Lanes(true, -1) + "<lane id=\"-2\" type=\"shoulder\">" + outer + "</lane>";
    return Document(road.Text());
  };
  const auto errors = [&](const std::string& outer,
                          const opendrive::Tolerance& tolerance = opendrive::Tolerance::Unrepaired()) {
    std::vector<std::string> said;
    const auto read = opendrive::Read(text(outer), "f.xodr", tolerance);
    for (const auto& error : read.value().errors) said.push_back(error.Text());
    return said;
  };
  // Its top, -3.2, lies at s = 40.
  const std::string parabola = R"(<border sOffset="0" a="-6.4" b="0.16" c="-0.002" d="0"/>)";
  EXPECT_THAT(errors(parabola),
              ElementsAre("road.lane.border.overlap_with_inner_lanes: road 1, lane -2, s 40: the lane's border lies "
                          "0.3 m within the edge of the lane inside of it; at most 0.05 m was expected"));
  // By 2 cm: told, and refused strictly.
  const std::string little = R"(<border sOffset="0" a="-6.68" b="0.16" c="-0.002" d="0"/>)";
  EXPECT_THAT(errors(little), IsEmpty());
  EXPECT_THAT(errors(little, opendrive::Tolerance::Strict()),
              ElementsAre(Names("road 1, lane -2, s 40: … 0.02 m within")));
  const auto import = opendrive::MustImport(text(little));
  ASSERT_EQ(import.warnings.size(), 1u);
  EXPECT_EQ(import.warnings[0].Text(),
            "road.lane.border.overlap_with_inner_lanes: road 1, lane -2, s 40: the lane's border lies 0.02 m within "
            "the edge of the lane inside of it; the lane is read as 0 m wide there");
  EXPECT_EQ(import.network->Span({0, 0, -2}, 40.0)->width_m(), 0.0);
  EXPECT_NEAR(import.network->Span({0, 0, -2}, 0.0)->width_m(), 3.18, 1e-12);
  // Only from the second record on, and at the section's very end.
  EXPECT_THAT(
      errors(R"(<border sOffset="0" a="-5" b="0" c="0" d="0"/><border sOffset="60" a="-5" b="0.05" c="0" d="0"/>)"),
      ElementsAre(Names("lane -2, s 100: … 0.5 m within")));
}

TEST(BordersToldOf, WidthsCountWhereALaneHasBoth) {
  RoadText road;
  road.right =
      R"(<lane id="-1" type="driving"><width sOffset="0" a="3" b="0" c="0" d="0"/>
          <border sOffset="0" a="-3.5" b="0" c="0" d="0"/></lane><lane id="-2" type="shoulder">
          <border sOffset="0" a="-5" b="0" c="0" d="0"/></lane>)";
  const auto import = opendrive::MustImport(Document(road.Text()));
  std::vector<std::string> said;
  for (const auto& warning : import.warnings) said.push_back(warning.Text());
  EXPECT_THAT(said,
              testing::UnorderedElementsAre("road.lane.border.exclusive_width_border: road 1, lane -1, s 0: the lane "
                                            "has both <width> and <border>: its widths count",
                                            "road.lane.border.exclusive_width_border: road 1, s 0: on the right lane "
                                            "-1 has a <width> and lane -2 a <border>: each is read by what it has"));
  EXPECT_EQ(import.network->Span({0, 0, -1}, 50.0)->outer_t_m, -3.0);
  EXPECT_EQ(import.network->Span({0, 0, -2}, 50.0)->outer_t_m, -5.0);
}

TEST(BordersToldOf, APositiveBorderOnTheRightIsTurned) {
  RoadText road;
  road.right =
      R"(<lane id="-1" type="driving"><border sOffset="0" a="0" b="0.035" c="0" d="0"/>
          <border sOffset="50" a="1.75" b="0" c="0" d="0"/></lane>)";
  const auto import = opendrive::MustImport(Document(road.Text()));
  ASSERT_EQ(import.warnings.size(), 1u);
  EXPECT_EQ(import.warnings[0].Text(),
            "road.lane.border: road 1, lane -1, s 0: the border of a lane on the right lies to the left of the "
            "reference line: it is read with its sign turned");
  EXPECT_NEAR(import.network->Span({0, 0, -1}, 20.0)->outer_t_m, -0.7, 1e-12);
  EXPECT_NEAR(import.network->Span({0, 0, -1}, 70.0)->outer_t_m, -1.75, 1e-12);
}

}  // namespace
}  // namespace rodeira::road
