// SPDX-License-Identifier: Apache-2.0
// Pictures on the ground as a person sees them, from memory and from files: single pixels from straight above.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>

#include "common/core/base/files.hpp"
#include "nodes/view/visual_database/database.hpp"
#include "nodes/view/visual_database/find_built.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/nodes/view/pictures.hpp"

namespace rodeira::nodes {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 640, kHeight = 480;

// A BMP of 2 x 2 pixels, the lower row first: red, blue, then green, yellow above.
std::string FourColours() {
  std::string bytes = "BM";
  const auto put = [&](std::uint32_t value, int size) {
    for (int i = 0; i < size; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xff);
  };
  put(14 + 40 + 16, 4), put(0, 4), put(14 + 40, 4);
  put(40, 4), put(2, 4), put(2, 4), put(1, 2), put(24, 2), put(0, 4), put(16, 4), put(0, 4), put(0, 4), put(0, 4),
      put(0, 4);
  for (const std::uint32_t rgb : {0xfa0000u, 0x0000fau}) put(rgb, 3);
  put(0, 2);
  for (const std::uint32_t rgb : {0x00fa00u, 0xfafa00u}) put(rgb, 3);
  put(0, 2);
  return bytes;
}

class GroundPicture : public testing::Test {
 protected:
  void SetUp() override { folder_.Write("four.bmp", FourColours()); }

  std::shared_ptr<const road::World> Plane(const std::string& ground,
                                           const std::string& section = "template: rural") const {
    const auto world = road::World::Parse(
        fmt::format("rodeira: world/2\nname: pictures\nground: {{kind: plane, surface: grass{}}}\nmaterials: {{four: "
                    "{{surface: asphalt, texture: four.bmp, texture_m: 8}}}}\nroads:\n"
                    "  - id: a\n    start: {{x_m: 0, y_m: 0, heading_deg: 0}}\n    axis: [line: {{length_m: 80}}]\n    "
                    "z_m: 0\n    section: {{{}}}\n    lines: []\n",
                    ground, section),
        folder_.path() / "made.yaml");
    EXPECT_TRUE(world.ok()) << world.error().Text();
    return world.ok() ? world.value() : nullptr;
  }

  // What is seen from above at places around (40, 0), where the car stands.
  std::vector<Probe> See(const road::World& world, const std::vector<Eigen::Vector2d>& places,
                         const fs::path& built = {}) const {
    Picture picture;
    picture.show_instruments = false;
    picture.camera = scene::CameraKind::kTop;
    picture.moment.cars.push_back(CarAt({40.0, 0.0, 0.0}, 0.0));
    const auto image = RenderStill(world, picture, kWidth, kHeight, built);
    EXPECT_TRUE(image.ok()) << image.error().Text();
    const scene::Camera camera =
        scene::MakeCamera(picture.camera, *scene::BodyAt(picture.moment, 0), picture.aim, world);
    std::vector<Probe> probes;
    for (const Eigen::Vector2d& p : places) probes.push_back(ProbeAt(image.value(), camera, {p.x(), p.y(), 0.0}));
    return probes;
  }

  cli::TemporaryFolder folder_;
};

bool IsGreen(const Probe& p) { return p.green > 1.8 * p.red && p.green > 1.8 * p.blue && p.green > 60.0; }

// The middles of the four fields of a picture with its corner there, and so wide.
std::vector<Eigen::Vector2d> Fields(double west, double south, double size) {
  const double a = 0.25 * size, b = 0.75 * size;
  return {{west + a, south + a}, {west + b, south + a}, {west + a, south + b}, {west + b, south + b}};
}

// The same of one on the right lane of a road to the east, y = 0 its middle: it is driven to the east, which is up.
std::vector<Eigen::Vector2d> AlongLane(double west, double size) {
  const double a = 0.25 * size, b = 0.75 * size;
  return {{west + a, -a}, {west + a, -b}, {west + b, -a}, {west + b, -b}};
}

void ExpectFour(const std::vector<Probe>& p, std::size_t first = 0) {
  EXPECT_TRUE(p[first].IsRed()) << p[first];
  EXPECT_TRUE(p[first + 1].IsBlue()) << p[first + 1];
  EXPECT_TRUE(IsGreen(p[first + 2])) << p[first + 2];
  EXPECT_TRUE(p[first + 3].IsYellow()) << p[first + 3];
}

TEST_F(GroundPicture, ADrapedOneLiesInItsRectangleAndTheGroundBeyond) {
  RODEIRA_NEEDS_PICTURES();
  const auto world =
      Plane(", texture: {file: four.bmp, kind: draped, west_m: 28, south_m: 8, east_m: 52, north_m: 32}");
  ASSERT_NE(world, nullptr);
  auto places = Fields(28.0, 8.0, 24.0);
  places.push_back({22.0, 15.0});
  places.push_back({40.0, -15.0});
  places.push_back({30.0, 2.0});
  const auto p = See(*world, places);
  ExpectFour(p);
  EXPECT_TRUE(p[4].IsGrown()) << p[4];
  EXPECT_TRUE(p[5].IsGrown()) << p[5];
  EXPECT_TRUE(p[6].IsAsphalt()) << p[6];  // the road lies on it
}

TEST_F(GroundPicture, AGeotypicalOneRepeatsAndALaneHasItsOwn) {
  RODEIRA_NEEDS_PICTURES();
  // Lanes of 8 m, of which the right one, from y = -8 to 0, has the picture of 8 m.
  const auto world = Plane(", texture: {file: four.bmp, repeat_m: 10}",
                           "lanes: [{id: -1, width_m: 8, material: four}, {id: 1, width_m: 6}], crossfall: {kind: "
                           "crown, fall: 0}, verge: {width_m: 1}");
  ASSERT_NE(world, nullptr);
  auto places = Fields(30.0, 10.0, 10.0);
  for (const Eigen::Vector2d& p : Fields(50.0, -20.0, 10.0)) places.push_back(p);
  for (const Eigen::Vector2d& p : AlongLane(48.0, 8.0)) places.push_back(p);
  places.push_back({48.0, 3.0});
  const auto p = See(*world, places);
  ExpectFour(p);
  ExpectFour(p, 4);
  ExpectFour(p, 8);
  EXPECT_TRUE(p[12].IsAsphalt()) << p[12];
}

TEST_F(GroundPicture, BuiltFilesShowTheSameAndNameThePicture) {
  RODEIRA_NEEDS_PICTURES();
  const auto world = Plane(", texture: {file: four.bmp, kind: draped, west_m: 28, south_m: 8, east_m: 52, north_m: 32}",
                           "lanes: [{id: -1, width_m: 8, material: four}], verge: {width_m: 1}");
  ASSERT_NE(world, nullptr);
  DatabaseOptions options;
  options.folder = folder_.path() / "made";
  const auto report = WriteDatabase(*world, options);
  ASSERT_TRUE(report.ok()) << report.error().Text();
  std::size_t pictures = 0;
  for (const auto& entry : fs::directory_iterator(options.folder / "pictures")) {
    ++pictures;
    EXPECT_EQ(base::ReadText(entry.path()).value(), FourColours());
    EXPECT_NE(
        base::ReadText(options.folder / "visual.txt").value().find("pictures/" + entry.path().filename().string()),
        std::string::npos);
  }
  EXPECT_EQ(pictures, 1u);  // one file, laid in two ways
  EXPECT_EQ(FindBuilt(folder_.path() / "made.yaml", *world).folder, options.folder);
  auto places = Fields(28.0, 8.0, 24.0);
  for (const Eigen::Vector2d& p : AlongLane(48.0, 8.0)) places.push_back(p);
  const auto memory = See(*world, places), built = See(*world, places, options.folder);
  ExpectFour(built);
  ExpectFour(built, 4);
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_EQ(memory[i].red, built[i].red);
    EXPECT_EQ(memory[i].green, built[i].green);
    EXPECT_EQ(memory[i].blue, built[i].blue);
  }
  EXPECT_EQ(WriteDatabase(*world, options).value().built, 0u);
  // Another picture under the same name: the old files are not shown.
  std::string other = FourColours();
  other[54] = '\x40';
  folder_.Write("four.bmp", other);
  EXPECT_TRUE(FindBuilt(folder_.path() / "made.yaml", *world).folder.empty());
}

TEST_F(GroundPicture, WithoutTheFileTheViewGoesOnAndSaysSo) {
  RODEIRA_NEEDS_PICTURES();
  const auto world =
      Plane(", texture: {file: fuor.bmp, kind: draped, west_m: 28, south_m: 8, east_m: 52, north_m: 32}");
  ASSERT_NE(world, nullptr);
  testing::internal::CaptureStderr();
  const auto p = See(*world, Fields(28.0, 8.0, 24.0));
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_TRUE(said.starts_with("rodeira: warning: the ground is drawn without its picture: there is no texture file '"))
      << said;
  EXPECT_TRUE(said.ends_with("fuor.bmp'; did you mean 'four.bmp'?\n")) << said;
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1);
  for (const Probe& probe : p) EXPECT_TRUE(probe.IsGrown()) << probe;
  // To build files of it is refused.
  DatabaseOptions options;
  options.folder = folder_.path() / "none";
  const auto report = WriteDatabase(*world, options);
  ASSERT_FALSE(report.ok());
  EXPECT_EQ(report.error().exit_status(), 2);
}

}  // namespace
}  // namespace rodeira::nodes
