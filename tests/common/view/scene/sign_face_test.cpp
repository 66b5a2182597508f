// SPDX-License-Identifier: Apache-2.0
// Signs' faces: areas in closed form, symmetries, colours where the Vienna Convention has them.
#include "common/view/scene/road_furniture/sign_face.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "common/view/scene/raster/lettering.hpp"
#include "common/world/design/furniture_reader.hpp"
#include "common/world/network/sign_catalogues.hpp"
#include "common/world/network/sign_kinds.hpp"

namespace rodeira::scene {
namespace {

using P = Eigen::Vector2d;

const Colour kInk = Colour::Of(0x000000), kPaper = Colour::Of(0xffffff);

// How much of a picture of black on white is black, in the canvas's units squared.
double Inked(const Canvas& canvas) {
  const Raster raster = canvas.Paint();
  double sum = 0.0;
  for (const Colour& pixel : raster.pixels) sum += 1.0 - pixel.green / 255.0;
  return sum * 4.0 / (static_cast<double>(raster.height_px) * raster.height_px);
}

TEST(Canvas, ShapesCoverTheirAreas) {
  Canvas disc(128, 128, kPaper);
  disc.Disc({0.1, -0.2}, 0.6, kInk);
  EXPECT_NEAR(Inked(disc), 16.0 * std::sin(2.0 * 3.14159265358979 / 32.0) * 0.36, 0.002);  // 32 corners
  Canvas square(192, 128, kPaper);
  square.Fill(std::vector<P>{{-1.4, -0.5}, {1.3, -0.5}, {1.3, 0.4}, {0.0, 0.0}, {-1.4, 0.4}}, kInk);
  EXPECT_NEAR(Inked(square), 2.7 * 0.9 - 0.5 * 2.7 * 0.4, 0.003);
  Canvas line(128, 128, kPaper);
  line.Stroke(std::vector<P>{{-0.5, -0.37}, {0.6, 0.41}}, 0.2, kInk);
  EXPECT_NEAR(Inked(line), 0.2 * std::hypot(1.1, 0.78) + 3.12145 * 0.01, 0.002);
  Canvas outside(64, 64, kPaper);
  outside.Fill(std::vector<P>{{-9.0, -9.0}, {9.0, -9.0}, {9.0, 9.0}, {-9.0, 9.0}}, kInk);
  EXPECT_NEAR(Inked(outside), 4.0, 1e-12);
}

TEST(Lettering, IsCentredHasItsHeightAndIsNarrowedToFit) {
  const auto bounds = [](std::string_view text, double most) {
    Canvas canvas(192, 128, kPaper);
    Letter(canvas, text, {0.1, 0.0}, 0.8, most, kInk);
    const Raster raster = canvas.Paint();
    double left = 9.0, right = -9.0, low = 9.0, high = -9.0;
    for (int y = 0; y < raster.height_px; ++y) {
      for (int x = 0; x < raster.width_px; ++x) {
        if (raster.At(x, y).red > 127) continue;
        const double px = (x + 0.5) / 64.0 - 1.5, py = (y + 0.5) / 64.0 - 1.0;
        left = std::min(left, px), right = std::max(right, px), low = std::min(low, py), high = std::max(high, py);
      }
    }
    return std::array<double, 4>{left, right, low, high};
  };
  const auto wide = bounds("H8H", 9.0);
  EXPECT_NEAR(wide[0] + wide[1], 0.2, 0.04);
  EXPECT_NEAR(wide[3] - wide[2], 0.8, 0.04);
  const auto narrow = bounds("H8H8HH8H", 1.2);
  EXPECT_LE(narrow[1] - narrow[0], 1.22);
  EXPECT_GE(narrow[1] - narrow[0], 1.1);
  // Capitals whichever way they are written; accents and cedillas add to them.
  const auto ink = [](std::string_view text) {
    Canvas canvas(192, 128, kPaper);
    Letter(canvas, text, {0.0, 0.0}, 0.6, 9.0, kInk);
    return Inked(canvas);
  };
  EXPECT_EQ(ink("bou"), ink("BOU"));
  EXPECT_EQ(ink("ç"), ink("Ç"));
  for (const auto& [plain, accented] : {std::pair("C", "Ç"), std::pair("A", "ã"), std::pair("E", "É"),
                                        std::pair("O", "ô"), std::pair("N", "ñ"), std::pair("U", "ü")}) {
    EXPECT_GT(ink(accented), ink(plain) + 0.005) << accented;
  }
}

TEST(SignFace, EverySignOfWorldFilesHasAPictureOfItsOwn) {
  ASSERT_FALSE(design::SignKinds().empty() || FaceKinds().empty());
  for (const design::SignKind& kind : design::SignKinds()) {
    network::Signal signal = design::MakeSign(kind, kind.with_value ? std::optional(80.0) : std::nullopt);
    signal.text = "Freixo";
    const std::string face = FaceOf(signal, true);
    EXPECT_EQ(face.substr(0, std::string(kind.name).size()), kind.name);
    EXPECT_NE(face, "plate");
  }
  std::set<std::vector<std::uint8_t>> pictures;
  for (const std::string& kind : FaceKinds()) {
    std::vector<std::uint8_t> bytes;
    for (const Colour& pixel : DrawFace(kind.ends_with("speed_limit") ? kind + " 30" : kind).pixels)
      bytes.insert(bytes.end(), {pixel.red, pixel.green, pixel.blue});
    EXPECT_TRUE(pictures.insert(bytes).second) << kind << " looks like another one";
  }
}

TEST(SignFace, NumbersOfTheCatalogueAndWhatIsNotInIt) {
  network::Signal signal;
  signal.country = "OpenDRIVE";
  signal.type = "274", signal.subtype = "57";
  EXPECT_EQ(FaceOf(signal, false), "speed_limit 70");
  signal.value = 90.0;
  EXPECT_EQ(FaceOf(signal, false), "speed_limit 90");
  signal.value = 25.0, signal.unit = "m/s";
  EXPECT_EQ(FaceOf(signal, false), "speed_limit 90");
  signal.type = "294";
  EXPECT_EQ(FaceOf(signal, false), "");  // a stop line is paint
  signal.type = "123";
  EXPECT_EQ(FaceOf(signal, false), "plate");
  signal.country = "se", signal.type = "274";
  EXPECT_EQ(FaceOf(signal, false), "plate");  // another catalogue's numbers mean other things
  signal.country = "de", signal.type = "625";
  EXPECT_EQ(FaceOf(signal, true), "chevron_left");
  EXPECT_EQ(FaceOf(signal, false), "chevron_right");
}

// By the catalogues: StVO, annexes 2 and 3; MUTCD 2009, chapters 2B to 2D; TSRGD 2016; GB 5768.2-2009. RoadRunner's
// names are those of its own export.
TEST(SignFace, OtherCataloguesHaveTheirShapeAndColour) {
  const auto face = [](const char* country, const char* type, const char* subtype = "-1", const char* name = "") {
    network::Signal signal;
    signal.country = country, signal.type = type, signal.subtype = subtype, signal.name = name;
    return FaceOf(signal, false);
  };
  // Catalogue of signs (VzKat): -10 is to the left, -20 to the right.
  EXPECT_EQ(face("DE", "222", "10"), "keep_left");
  for (const char* right : {"20", "-1"}) EXPECT_EQ(face("DE", "222", right), "keep_right");
  for (const char* blue : {"332", "333", "406", "430", "440", "449"}) EXPECT_EQ(face("DE", blue), "guide_blue") << blue;
  // StVO of 1970, § 42 (8): 435 and 436 are 434 in other shapes.
  for (const char* yellow : {"434", "435", "436"}) EXPECT_EQ(face("DE", yellow), "guide_yellow") << yellow;
  EXPECT_EQ(face("OpenDRIVE", "450", "50"), "exit_beacon");
  EXPECT_EQ(face("OpenDRIVE", "451", "-1"), "exit_beacon_two");
  EXPECT_EQ(face("OpenDRIVE", "452", "-1"), "exit_beacon_one");
  EXPECT_EQ(face("DE", "605", "10"), "beacon");
  EXPECT_EQ(face("DE", "103"), "bend_right");
  EXPECT_EQ(face("US", "R1-1"), "stop");
  EXPECT_EQ(face("usa", "R1", "2"), "give_way");
  EXPECT_EQ(face("US", "R10-11b"), "board");
  EXPECT_EQ(face("US", "R1-10"), "board");
  EXPECT_EQ(face("US", "W1-2"), "warning_diamond");
  EXPECT_EQ(face("US", "D1-1"), "guide_green");
  EXPECT_EQ(face("GB", "601.1"), "stop");
  EXPECT_EQ(face("uk", "602"), "give_way");
  EXPECT_EQ(face("GB", "512"), "danger");
  EXPECT_EQ(face("GB", "629"), "restriction");
  EXPECT_EQ(face("gb", "610"), "keep_left");  // drawn so; traffic keeps left
  for (const char* stop : {"r1-1", "R1-1", "r1-1A"}) EXPECT_EQ(face("us", stop), "stop") << stop;
  EXPECT_EQ(face("us", "w20", "1"), "warning_orange");
  EXPECT_EQ(face("US", "R5-1a"), "board_red");
  EXPECT_EQ(face("CN", "指示7"), "keep_right");
  EXPECT_EQ(face("CN", "指路42"), "guide_green");
  EXPECT_EQ(face("CN", "路4"), "guide_blue");
  EXPECT_EQ(face("CN", "禁1"), "stop");
  EXPECT_EQ(face("CN", "禁12"), "prohibition");
  EXPECT_EQ(face("CN", "警13"), "warning_yellow");
  EXPECT_EQ(face("CN", "指4"), "mandatory");
  EXPECT_EQ(face("", "-1", "-1", "Sign_SpeedLimit_25"), "speed_limit_us 25");
  EXPECT_EQ(face("", "-1", "-1", "Sign_Stop"), "stop");
  EXPECT_EQ(face("", "-1", "-1", "Signal_3Light_Post01"), "plate");
  EXPECT_EQ(face("", "-1", "-1", "Sign_Elephants"), "plate");
  EXPECT_EQ(face("FR", "R1-1"), "plate");
  network::Signal limit;
  limit.country = "US", limit.type = "R2-1", limit.value = 55.0, limit.unit = "mph";
  EXPECT_EQ(FaceOf(limit, false), "speed_limit_us 55");
  // Yellow diamonds and triangles, blue discs and boards, green guides.
  const auto middle = [](const char* kind) { return DrawFace(kind).At(64, 64); };
  for (const char* yellow : {"warning_diamond", "guide_yellow"}) {
    EXPECT_GT(middle(yellow).red, 220) << yellow;
    EXPECT_LT(middle(yellow).blue, 60) << yellow;
  }
  for (const char* blue : {"mandatory", "guide_blue"}) EXPECT_GT(middle(blue).blue, 120) << blue;
  EXPECT_GT(middle("guide_green").green, middle("guide_green").red + 60);
  EXPECT_EQ(PlateOutline("warning_diamond").size(), 4u);
  EXPECT_EQ(PlateOutline("speed_limit_us 25").size(), 4u);
  EXPECT_EQ(PlateOutline("keep_right").size(), 20u);
}

// Shape and colour of each row, by the figures of MUTCD 2009, TSRGD 2016 and GB 5768.2-2009. A row without a line here
// fails.
struct Figures {
  const char* country;
  std::size_t corners;  // of the plate
  const char* colour;   // of which there is most, black and white apart
  const char* codes;
};
constexpr Figures kFigures[] = {
    {"US", 8, "red", "R1-1"},
    {"US", 9, "red", "R1-2"},
    {"US", 4, "", "R2-1 R4-7 R4-8 R6-1 R S5- M"},
    {"US", 4, "red", "R3-1 R3-2 R3-4 R3-18 R3-27 R5-1A R5-1 R5-2 R5-6 R8-3 R9-3"},
    {"US", 4, "brown", "RS D7-"},
    {"US", 4, "yellow", "W1-6 W1-7 W1-8 W13-1 W16- W"},
    {"US", 20, "yellow", "W10-1"},
    {"US", 3, "yellow", "W14-3"},
    {"US", 4, "orange", "W20- W21- W22- W23- W24- G20- M4-8 M4-9 M4-10"},
    {"US", 5, "lime", "S1-1"},
    {"US", 4, "lime", "S3- S4-5 S4-"},
    {"US", 4, "blue", "D5- D9- D12-"},
    {"US", 4, "green", "D E G I"},
    {"GB", 4, "", "502 503 511 515 525 526 527 546 547 572 573 615.1"},
    {"GB", 9, "red", "5 602 7001"},
    {"GB", 8, "red", "601.1"},
    {"GB", 20, "blue", "606 609 610 611.1 611 672"},
    {"GB", 20, "red", "612 613 614 615 616 617 619 622 625 627 629 632 636 642 670"},
    {"GB", 20, "", "671"},
    {"GB", 4, "blue", "652 660 661 801 811 816 29"},
    {"GB", 4, "green", "20"},
    {"CN", 8, "red", "禁1"},
    {"CN", 9, "red", "禁2"},
    {"CN", 20, "red", "禁3 禁4 禁5 禁29 禁31 禁32 禁34 禁35 禁36 禁37 禁38 禁40 禁42 禁"},
    {"CN", 20, "", "禁30 禁39"},
    {"CN", 20, "blue", "示7 示8 示11 示"},
    {"CN", 4, "", "禁43 禁44 禁45 禁46 禁47 禁48"},
    {"CN", 4, "yellow", "警39 警45"},
    {"CN", 9, "yellow", "警"},
    {"CN", 4, "blue",
     "示12 示13 示17 示18 示19 示20 示21 示22 示23 示24 示25 "
     "示26 示28 示30 示32 示33 示34 示35 示36 路36 路37 路4 路5 "
     "路6 路7 路"},
    {"CN", 4, "green", "路4 路5 路6 路7"},
};

std::string MostColour(const std::string& face) {
  const std::map<std::string, Colour> names = {
      {"red", Colour::Of(0xc2151d)},    {"blue", Colour::Of(0x17509b)}, {"yellow", Colour::Of(0xf6b915)},
      {"orange", Colour::Of(0xf07c14)}, {"lime", Colour::Of(0xc5e72e)}, {"green", Colour::Of(0x006b54)},
      {"brown", Colour::Of(0x693f23)},
  };
  std::map<std::string, int> pixels;
  for (const Colour& pixel : DrawFace(face).pixels) {
    for (const auto& [name, colour] : names) {
      if (std::abs(pixel.red - colour.red) + std::abs(pixel.green - colour.green) + std::abs(pixel.blue - colour.blue) <
          9)
        ++pixels[name];
    }
  }
  const auto most =
      std::max_element(pixels.begin(), pixels.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == pixels.end() || most->second < 500 ? "" : most->first;
}

TEST(SignFace, EveryRowOfOtherCataloguesHasItsShapeAndColour) {
  const auto rows = network::CataloguesAbroad();
  ASSERT_GT(rows.size(), 120u);
  std::map<std::string, int> seen;  // 路4 is there twice: by itself and as what others begin with
  for (const network::CatalogueRow& row : rows) {
    const std::string country(row.country), code(row.code);
    const int turn = seen[country + code]++;
    const Figures* figures = nullptr;
    int found = 0;
    for (const Figures& line : kFigures) {
      if (country == line.country &&
          (" " + std::string(line.codes) + " ").find(" " + code + " ") != std::string::npos && found++ == turn)
        figures = &line;
    }
    ASSERT_NE(figures, nullptr) << country << " " << code << " has no line";
    network::Signal signal;
    signal.country = country, signal.type = turn == 0 ? code : code + "1", signal.subtype = "-1", signal.value = 40.0;
    EXPECT_EQ(network::SignKindOf(signal), row.kind) << country << " " << code << ": another row goes before it";
    const std::string face = FaceOf(signal, true);
    EXPECT_NE(face, "plate") << code;
    EXPECT_EQ(PlateOutline(face).size(), figures->corners) << country << " " << code << " " << face;
    EXPECT_EQ(MostColour(face), figures->colour) << country << " " << code << " " << face;
  }
}

TEST(SignFace, LeftAndRightMirrorOneAnother) {
  for (const auto& [left, right] :
       {std::pair("chevron_left", "chevron_right"), std::pair("bend_left", "bend_right"),
        std::pair("chevron_yellow_left", "chevron_yellow_right"), std::pair("keep_left", "keep_right"),
        std::pair("keep_left_us", "keep_right_us"), std::pair("bends_left_first", "bends_right_first")}) {
    const Raster a = DrawFace(left), b = DrawFace(right);
    int apart = 0;
    for (int y = 0; y < a.height_px; ++y) {
      for (int x = 0; x < a.width_px; ++x) apart += std::abs(a.At(x, y).green - b.At(a.width_px - 1 - x, y).green) > 32;
    }
    EXPECT_LE(apart, 4) << left;
    EXPECT_FALSE(a.pixels == b.pixels);
  }
  // A chevron's point is on the side to which it points: white at the tip in the middle's height, red at its corners.
  EXPECT_GT(DrawFace("chevron_right").At(110, 64).green, 200);
  EXPECT_LT(DrawFace("chevron_right").At(3, 64).green, 100);
}

// StVO, annex 3: 300, 200 and 100 m before an exit.
TEST(SignFace, ABeaconOfAnExitHasAStripeEach100Metres) {
  for (const auto& [face, stripes] :
       {std::pair("exit_beacon", 3), std::pair("exit_beacon_two", 2), std::pair("exit_beacon_one", 1)}) {
    const Raster raster = DrawFace(face);
    int begun = 0;
    for (int y = 8; y + 8 < raster.height_px; ++y)  // within the border
      begun += raster.At(64, y).red > 128 && raster.At(64, y - 1).red <= 128;
    EXPECT_EQ(begun, stripes) << face;
  }
}

TEST(SignFace, ColoursOfTheConvention) {
  const auto is_red = [](Colour c) { return c.red > 150 && c.green < 60 && c.blue < 60; };
  const auto is_white = [](Colour c) { return c.red > 220 && c.green > 220 && c.blue > 220; };
  const auto is_blue = [](Colour c) { return c.blue > 120 && c.red < 60; };
  const auto at = [](const char* face, double x, double y) {
    return DrawFace(face).At(static_cast<int>(64.0 * (x + 1.0)), static_cast<int>(64.0 * (y + 1.0)));
  };
  EXPECT_TRUE(is_red(at("speed_limit 50", 0.0, 0.88)));  // C, 14: a red ring, its ground white
  EXPECT_TRUE(is_white(at("speed_limit 50", 0.0, 0.62)));
  EXPECT_TRUE(is_white(at("no_entry", 0.0, 0.0)));  // C, 1: a white bar
  EXPECT_TRUE(is_red(at("no_entry", 0.0, 0.5)));
  EXPECT_TRUE(is_white(at("give_way", 0.0, 0.3)));  // B, 1: point downward
  EXPECT_TRUE(is_red(at("give_way", 0.0, 0.93)));
  EXPECT_TRUE(is_red(at("stop", 0.0, 0.7)));          // B, 2a: STOP on red
  EXPECT_GT(at("priority_road", 0.3, 0.2).red, 220);  // B, 3: yellow inside
  EXPECT_LT(at("priority_road", 0.3, 0.2).blue, 60);
  EXPECT_TRUE(is_blue(at("roundabout", 0.0, 0.0)));
  for (const char* stop : {"no_stopping", "no_waiting"}) EXPECT_TRUE(is_blue(at(stop, 0.45, 0.0))) << stop;
  EXPECT_TRUE(is_blue(at("motorway", -0.8, 0.8)));
}

TEST(SignFace, PlatesAreConvexAndCounterClockwise) {
  ASSERT_FALSE(FaceKinds().empty());
  for (const std::string& kind : FaceKinds()) {
    const auto outline = PlateOutline(kind);
    ASSERT_GE(outline.size(), 3u);
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const P a = outline[i], b = outline[(i + 1) % outline.size()], c = outline[(i + 2) % outline.size()];
      EXPECT_GT((b - a).x() * (c - b).y() - (b - a).y() * (c - b).x(), 0.0) << kind;
      EXPECT_GE(std::min(a.x(), a.y()), -1e-12) << kind;
      EXPECT_LE(std::max(a.x(), a.y()), 1.0 + 1e-12) << kind;
    }
  }
}

}  // namespace
}  // namespace rodeira::scene
