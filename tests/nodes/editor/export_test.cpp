// SPDX-License-Identifier: Apache-2.0
// A map that was drawn becomes a world, which the program checks and drives on.
#include <fmt/format.h>
#include <sys/wait.h>

#include <cstdlib>
#include <sstream>

#include "common/world/road/world.hpp"
#include "tests/nodes/editor/editor_app_fixture.hpp"
#include "tests/tree.hpp"

namespace rodeira::nodes {
namespace {

// Of `rodeira WORDS`, run in `folder`; what it says goes into the file said.txt there.
int StatusOf(const std::filesystem::path& folder, const std::string& words) {
  const int status = std::system(fmt::format("cd '{}' && timeout 300 '{}/bin/rodeira' {} > said.txt 2>&1 < /dev/null",
                                             folder.string(), BinaryDir(), words)
                                     .c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// Of a table: the second line, or the last one.
std::string LineOf(const std::string& table, int number) {
  const std::size_t end = table.find_last_not_of('\n') + 1;
  const std::size_t begin = number > 0 ? table.find('\n') + 1 : table.rfind('\n', end - 1) + 1;
  return table.substr(begin, table.find('\n', begin) - begin);
}
Eigen::Vector2d PlaceIn(const std::string& table, const std::string& line) {
  const auto cell = [&](const std::string& column) {
    std::istringstream heads(table.substr(0, table.find('\n'))), cells(line);
    for (std::string head, value; std::getline(heads, head, ',') && std::getline(cells, value, ',');) {
      if (head == column) return std::stod(value);
    }
    ADD_FAILURE() << "no column " << column;
    return 0.0;
  };
  return {cell("position_w_m.x"), cell("position_w_m.y")};
}

class AnExport : public EditorAppTest {
 protected:
  std::string Told() const { return base::ReadText(At("said.txt")).value(); }
};

TEST_F(AnExport, IsAWorldThatIsCheckedAndDrivenOn) {
  Press(SDL_SCANCODE_2);  // a roundabout
  ClickOn(0.0, 0.0);
  ASSERT_EQ(Said(), "roundabout made");
  Press(SDL_SCANCODE_E, KMOD_CTRL);
  ASSERT_TRUE(work().files.open());
  Write(At("κυκλικός κόμβος").string());
  Press(SDL_SCANCODE_RETURN);
  ASSERT_TRUE(work().session.said().good) << Said();
  EXPECT_NE(Said().find("exported κυκλικός κόμβος.yaml and κυκλικός κόμβος.xodr: "), std::string::npos) << Said();
  const auto world = road::World::Load(At("κυκλικός κόμβος.yaml"));
  ASSERT_TRUE(world.ok()) << world.error().Text();
  EXPECT_EQ(world.value()->name(), "κυκλικός κόμβος");
  const auto roads = road::World::Load(At("κυκλικός κόμβος.xodr"));
  ASSERT_TRUE(roads.ok()) << roads.error().Text();
  EXPECT_EQ(world.value()->content_hash(), roads.value()->content_hash()) << "the same world as its roads alone";
  EXPECT_EQ(StatusOf(folder_->path(), "world check 'κυκλικός κόμβος.yaml'"), 0) << Told();
  // The autopilot drives a car on it, among traffic; the recording says the same again.
  ASSERT_TRUE(
      base::WriteWhole(At("drive.yaml"),
                       fmt::format("rodeira: launch/1\n"
                                   "world: \"κυκλικός κόμβος.yaml\"\n"
                                   "seed: 1\n"
                                   "duration_s: 6\n"
                                   "nodes:\n"
                                   "  road: {{kind: road}}\n"
                                   "  driver: {{kind: input, config: {{source: autopilot, driver: "
                                   "{0}/configs/drivers/default.yaml, vehicle: {0}/configs/vehicles/default.yaml}}}}\n"
                                   "  ego: {{kind: vehicle, config: {{vehicle: {0}/configs/vehicles/default.yaml}}}}\n"
                                   "  traffic: {{kind: traffic, config: {{vehicles: 8}}}}\n"
                                   "  recorder: {{kind: recorder}}\n",
                                   SourceDir()))
          .ok());
  ASSERT_EQ(StatusOf(folder_->path(), "run drive.yaml --in-process --headless --pace max --quiet --record drive.mcap"),
            0)
      << Told();
  EXPECT_EQ(StatusOf(folder_->path(), "replay drive.mcap --verify --quiet"), 0) << Told();
  ASSERT_EQ(StatusOf(folder_->path(), "export drive.mcap --csv csv --quiet"), 0) << Told();
  const std::string states = base::ReadText(At("csv/vehicle_state.csv")).value();
  EXPECT_GT((PlaceIn(states, LineOf(states, 1)) - PlaceIn(states, LineOf(states, -1))).norm(), 10.0)
      << "it has not driven";
}

TEST_F(AnExport, OfTheRoadsAlone) {
  OpenTheGoodMap();
  Press(SDL_SCANCODE_E, KMOD_CTRL);
  Write(At("alone.xodr").string());
  Press(SDL_SCANCODE_RETURN);
  EXPECT_EQ(Said(), "exported alone.xodr: 5 roads, 1 junctions");  // three lanes, and two ways through where they part
  EXPECT_TRUE(std::filesystem::exists(At("alone.xodr")));
  EXPECT_FALSE(std::filesystem::exists(At("alone.yaml")));
}

TEST_F(AnExport, TakesNoOtherFilesPlace) {
  OpenTheGoodMap();
  ASSERT_TRUE(base::WriteWhole(At("town.xodr"), "somebody's roads").ok());
  Press(SDL_SCANCODE_E, KMOD_CTRL);
  Write(At("town.yaml").string());
  Press(SDL_SCANCODE_RETURN);
  EXPECT_NE(Said().find("this file is there already and is not this world's"), std::string::npos) << Said();
  EXPECT_FALSE(work().session.said().good);
  EXPECT_EQ(base::ReadText(At("town.xodr")).value(), "somebody's roads");
  EXPECT_FALSE(std::filesystem::exists(At("town.yaml")));
  // A world that was exported before is asked for once more, and replaced.
  Press(SDL_SCANCODE_E, KMOD_CTRL);
  Write(At("city.yaml").string());
  Press(SDL_SCANCODE_RETURN);
  ASSERT_TRUE(work().session.said().good) << Said();
  Press(SDL_SCANCODE_E, KMOD_CTRL);
  Write(At("city.yaml").string());
  Press(SDL_SCANCODE_RETURN);
  EXPECT_TRUE(work().files.open());
  Press(SDL_SCANCODE_RETURN);
  EXPECT_FALSE(work().files.open());
  EXPECT_TRUE(work().session.said().good) << Said();
}

TEST_F(AnExport, OfAMapThatCannotBeDrivenOnIsRefused) {
  Press(SDL_SCANCODE_C);
  Press(SDL_SCANCODE_E, KMOD_CTRL);
  Write(At("nothing.yaml").string());
  Press(SDL_SCANCODE_RETURN);
  EXPECT_NE(Said().find("not exported: "), std::string::npos) << Said();
  EXPECT_FALSE(std::filesystem::exists(At("nothing.yaml")));
  EXPECT_FALSE(std::filesystem::exists(At("nothing.xodr")));
}

}  // namespace
}  // namespace rodeira::nodes
