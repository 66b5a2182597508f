// SPDX-License-Identifier: Apache-2.0
// Small files of other programs' kinds that lie beside the project, each with what is right for it beside it: what is
// repaired, what then lies where, and that the repaired file is read by others.
#include <gmock/gmock.h>

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <set>

#include "common/core/base/files.hpp"
#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::opendrive {
namespace {

using network::LaneKey;
using network::Network;

struct Case {
  std::vector<std::string> kinds;                                      // of repairs, in order of lines
  std::set<std::string> left;                                          // rules that the repaired file breaks strictly
  std::function<void(const Network&)> answer = [](const Network&) {};  // of the file's own numbers
  double share = 1.0;  // of the lanes that are reached and lead on, as the file is drawn
};

double HeightAt(const Network& network, double s_m, double t_m) { return network.roads()[0].Surface(s_m, t_m).p_W.z(); }
void ExpectLeadsTo(const Network& network, const char* from, int lane, const char* to, int next) {
  const auto ends = network.AtEnd({*network.FindRoad(from), 0, lane});
  ASSERT_EQ(ends.size(), 1u);
  EXPECT_EQ(ends[0].lane, (LaneKey{*network.FindRoad(to), 0, next}));
}

const std::map<std::string, Case>& Cases() {
  static const std::map<std::string, Case> cases = {
      {"01_shape_profile_twice.xodr",
       {{"element.duplicate_dropped"}, {}, [](const Network& network) { EXPECT_EQ(HeightAt(network, 10, -2), 0.0); }}},
      {"02_reference_lines_aside.xodr",
       {{"road.links_by_lanes"},
        {"road.geometry.contact_point"},
        [](const Network& network) { ExpectLeadsTo(network, "1", -1, "2", -2); }}},
      {"03_wrong_shoulder_link.xodr", {{"lane.link_dropped"}, {}}},
      {"04_sumo_u_turn.xodr",
       {{"connection.road_dropped"}, {}, [](const Network& network) { EXPECT_FALSE(network.FindRoad("3")); }}},
      {"06_zero_length_connector.xodr",
       {{"geometry.read_as_line", "lane.gap_driven"}, {"lane_smoothness.contact_point_no_horizontal_gaps"}}},
      {"07_one_controller.xodr",
       {{"controller.dark"}, {}, [](const Network& network) { EXPECT_FALSE(network.controllers()[0].times); }}},
      {"08_excerpt.xodr", {{"road.ended"}, {}}},
      {"09_polyline_kinks.xodr", {{"geometry.kink_rounded"}, {"road.geometry.contact_heading"}}},
      {"10a_order_of_elevation.xodr",
       {{"element.sorted"}, {}, [](const Network& network) { EXPECT_EQ(HeightAt(network, 10, 0), 0.0); }}},
      {"10b_order_1e-11.xodr",
       {{"element.duplicate_dropped"},
        {},
        [](const Network& network) { EXPECT_NEAR(network.roads()[0].CentreAt(40.0).value, 0.4, 1e-12); }}},
      {"10c_order_of_material.xodr",
       {{"element.sorted"},
        {},
        [](const Network& network) {
          const network::Road& road = network.roads()[0];
          const network::Lane& lane = *network.Find({0, 0, -1});
          EXPECT_EQ(road.MaterialAt(lane, 29.0)->friction, 0.9);
          EXPECT_EQ(road.MaterialAt(lane, 31.0)->friction, 0.5);
        }}},
      {"11_centre_lane_width.xodr", {{"lane.width_dropped"}, {}}},
      {"13_width_step_15cm.xodr", {{"lane.gap_driven"}, {"lane_smoothness.contact_point_no_horizontal_gaps"}}},
      {"14_loop_at_an_end.xodr",
       {{"road.links_by_lanes"},
        {"road.linkage.is_junction_needed"},
        [](const Network& network) {
          ExpectLeadsTo(network, "1", -1, "3", -1);
          ExpectLeadsTo(network, "3", -1, "1", 1);
        }}},
      {"15_width_jump_silent.xodr", {{"lane.jump_smoothed"}, {}}},
      {"16_no_lane_links.xodr",
       {{"lane.link_found"},
        {},
        [](const Network& network) { ExpectLeadsTo(network, "3", -1, "2", -1); },
        100.0 / 180.0}},  // the oncoming lanes of roads 1 and 2 have no way through the junction
      {"18_two_successors.xodr", {{}, {}}},
      {"20_gap_1e-8.xodr", {{}, {}}},
      {"26_bank_is_slow.xodr", {{}, {}}},
      {"26_flat_is_fast.xodr", {{}, {}}},
  };
  return cases;
}

std::vector<std::filesystem::path> Files() {
  std::vector<std::filesystem::path> files;
  for (const char* shared : {"/../shared", "/../../shared"}) {
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(SourceDir() + shared + "/data/cases/roads", none)) {
      if (entry.path().extension() == ".xodr") files.push_back(entry.path());
    }
    if (!files.empty()) break;
  }
  std::sort(files.begin(), files.end());
  return files;
}

class RoadCases : public testing::TestWithParam<std::string> {
 protected:
  // The file of the case; empty where the files are not there.
  std::filesystem::path File() const {
    for (const auto& file : Files()) {
      if (file.filename() == GetParam()) return file;
    }
    return {};
  }
};

TEST_P(RoadCases, AreRepairedAndAnswered) {
  if (Files().empty()) GTEST_SKIP() << "no real .xodr files beside the project";
  ASSERT_FALSE(File().empty()) << "the table has a case more than there are";
  const Case& expected = Cases().at(GetParam());
  const auto import = Load(File());
  ASSERT_TRUE(import.ok()) << import.error().Text();
  ASSERT_NE(import.value().network, nullptr);
  std::vector<std::string> kinds;
  for (const Finding& finding : OneEachKind(import.value().warnings)) {
    if (finding.repair.kind != RepairKind::kNone) kinds.push_back(finding.repair.Name());
  }
  EXPECT_THAT(kinds, testing::ElementsAreArray(expected.kinds));
  EXPECT_GE(ReachOf(*import.value().network).share(), 0.98 * expected.share);
  expected.answer(*import.value().network);

  std::string text = import.value().repaired_text;
  if (text.empty()) text = LoadText(File()).value();
  const Import again = MustImport(text);
  EXPECT_TRUE(again.repaired_text.empty()) << "a second repair changes the file";
  ASSERT_NE(again.network, nullptr);
  expected.answer(*again.network);
  std::set<std::string> left;
  const auto strictly = Read(text, "r.xodr", Tolerance::Strict());
  for (const Finding& error : strictly.value().errors) left.insert(error.rule);
  EXPECT_EQ(left, expected.left);
}

TEST_P(RoadCases, AreReadByNetconvertOnceRepaired) {
  if (Files().empty()) GTEST_SKIP() << "no real .xodr files beside the project";
  if (std::system("netconvert --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "netconvert (sumo) is not installed";
  ASSERT_FALSE(File().empty());
  const auto import = Load(File());
  ASSERT_TRUE(import.ok()) << import.error().Text();
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / fmt::format("rodeira_case_{}_{}", ::getpid(), GetParam().substr(0, 3));
  std::filesystem::create_directories(folder);
  const std::string in = (folder / "a.xodr").string(), out = (folder / "a.net.xml").string();
  const std::string& repaired = import.value().repaired_text;
  ASSERT_TRUE(base::WriteWhole(in, repaired.empty() ? LoadText(File()).value() : repaired).ok());
  EXPECT_EQ(std::system(fmt::format("[ -n \"$SUMO_HOME\" ] || export SUMO_HOME=/usr/share/sumo; netconvert "
                                    "--opendrive-files {} -o {} > /dev/null 2>&1",
                                    in, out)
                            .c_str()),
            0);
  EXPECT_TRUE(std::filesystem::exists(out));
  std::filesystem::remove_all(folder);
}

TEST(RoadCasesTable, HasEachFile) {
  if (Files().empty()) GTEST_SKIP() << "no real .xodr files beside the project";
  for (const auto& file : Files()) EXPECT_TRUE(Cases().contains(file.filename())) << file;
}

std::vector<std::string> Names() {
  std::vector<std::string> names;
  for (const auto& [name, expected] : Cases()) names.push_back(name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(OfOthers, RoadCases, testing::ValuesIn(Names()),
                         [](const testing::TestParamInfo<std::string>& each) {
                           std::string name = each.param.substr(0, each.param.find(".xodr"));
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace rodeira::opendrive
