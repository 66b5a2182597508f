// SPDX-License-Identifier: Apache-2.0
// The panels beside the map, by mouse and keyboard.
#include "tests/nodes/editor/editor_app_fixture.hpp"

namespace rodeira::nodes {
namespace {

const traffic_map::Lane& LaneOf(const editor::Document& document, std::int32_t number) {
  return document.map.lanes[*editor::Find(document.map.lanes, number)].value;
}

TEST_F(EditorAppTest, ListsShowChooseAndDelete) {
  OpenTheGoodMap();
  const std::string before = editor::BytesOf(document());
  EXPECT_FALSE(work().places.contains("lane 2"));
  Click("Manage lanes and connections");
  for (const char* name : {"lane 1", "lane 2", "lane 3", "1 to 2", "1 to 3"}) {
    Reveal(name);
    EXPECT_TRUE(work().places.contains(name)) << name;
  }
  Click("lane 3");
  EXPECT_EQ(work().session.selection.lanes, (std::set<std::int32_t>{3}));
  Click("1 to 2");
  EXPECT_EQ(work().session.selection.connections, (std::set<std::pair<std::int32_t, std::int32_t>>{{1, 2}}));
  EXPECT_TRUE(work().session.selection.lanes.empty());
  // The chosen connection's STOP, above in its own panel.
  for (int i = 0; i < 40; ++i) pushed_input::MoveTo(294, 500), pushed_input::Wheel(1);
  Show();
  Click("STOP");
  EXPECT_TRUE(document().map.connections[0].value.stop);
  Press(SDL_SCANCODE_Z, KMOD_CTRL);
  Click("delete 1 to 2");
  ASSERT_EQ(document().map.connections.size(), 1u);
  EXPECT_EQ(document().map.connections[0].value.to, 3);
  Click("delete lane 3");
  EXPECT_EQ(document().map.lanes.size(), 2u);
  EXPECT_TRUE(document().map.connections.empty()) << "connections go with their lane";
  Press(SDL_SCANCODE_Z, KMOD_CTRL);
  Press(SDL_SCANCODE_Z, KMOD_CTRL);
  EXPECT_EQ(editor::BytesOf(document()), before);
}

TEST_F(EditorAppTest, OfAListOnlyWhatIsSeenIsDrawn) {
  Press(SDL_SCANCODE_1);  // a crossing: 20 lanes
  ClickOn(0.0, 0.0);
  Click("Manage lanes and connections");
  Reveal("lane 1");
  EXPECT_TRUE(work().places.contains("lane 1"));
  EXPECT_FALSE(work().places.contains("lane 20"));
  const Eigen::Vector2d inside = work().places["lane 1"];
  for (int i = 0; i < 40 && !work().places.contains("lane 20"); ++i) {
    pushed_input::MoveTo(static_cast<int>(inside.x()), static_cast<int>(inside.y()));
    pushed_input::Wheel(-1);
    Show();
  }
  Click("lane 20");
  EXPECT_TRUE(work().session.selection.lanes.contains(20));
}

TEST_F(EditorAppTest, TheChosenLaneIsChanged) {
  OpenTheGoodMap();
  const std::string before = editor::BytesOf(document());
  ClickOn(15.0, 0.0);
  ASSERT_EQ(work().session.selection.lanes, (std::set<std::int32_t>{1}));
  ChooseOne("left border", "DashedWarn");
  EXPECT_EQ(LaneOf(document(), 1).left.type, traffic_map::BorderType::kDashedWarn);
  ChooseOne("right border", "DoubleDashed");
  EXPECT_EQ(LaneOf(document(), 1).right.type, traffic_map::BorderType::kDoubleDashed);
  Click("right inverted");
  EXPECT_TRUE(LaneOf(document(), 1).right.inverted);
  ChooseOne("mode", "none");
  EXPECT_EQ(LaneOf(document(), 1).mode, traffic_map::LaneMode::kNone);
  for (int i = 0; i < 4; ++i) Press(SDL_SCANCODE_Z, KMOD_CTRL);
  EXPECT_EQ(editor::BytesOf(document()), before);
  Click("delete chosen");
  EXPECT_FALSE(editor::Find(document().map.lanes, 1));
}

TEST_F(EditorAppTest, SignsAndFlowsOfALane) {
  OpenTheGoodMap();
  ClickOn(15.0, 0.0);
  Click("add sign");
  ASSERT_EQ(document().companion.signs.size(), 1u);
  EXPECT_EQ(document().companion.signs[0].kind, traffic_map::SignKind::kGiveWay);
  EXPECT_EQ(document().companion.signs[0].lane, 1);
  Click("add sign");
  ChooseOne("sign 2", "speed limit");
  EXPECT_EQ(document().companion.signs[1].kind, traffic_map::SignKind::kSpeedLimit);
  Fill("sign 2 limit", "50");
  EXPECT_EQ(document().companion.signs[1].limit_kmh, 50.0);
  ChooseOne("sign 1", "STOP");
  Fill("flow", "420");
  ASSERT_EQ(document().companion.flows.size(), 1u);
  EXPECT_EQ(document().companion.flows[0].vehph, 420.0);
  Keep("editor_signs.png");
  // Escape leaves a field as it was; a click elsewhere is as good as Enter.
  Click("flow");
  Write("7");
  Press(SDL_SCANCODE_ESCAPE);
  EXPECT_EQ(document().companion.flows[0].vehph, 420.0);
  Click("flow");
  Write("360");
  pushed_input::MoveTo(900, 700);
  pushed_input::Button(900, 700, true);
  Show();
  EXPECT_EQ(document().companion.flows[0].vehph, 360.0);
  pushed_input::Button(900, 700, false);
  Show();
  EXPECT_TRUE(work().session.selection.empty());
  EXPECT_FALSE(work().places.contains("flow"));
  // Saved, and read again from the companion.
  Press(SDL_SCANCODE_S, KMOD_CTRL);
  const auto companion = traffic_map::LoadHeightsOf(At("a.motors"));
  ASSERT_TRUE(companion.ok()) << companion.error().Text();
  ASSERT_EQ(companion.value().signs.size(), 2u);
  EXPECT_EQ(companion.value().signs[0].kind, traffic_map::SignKind::kStop);
  EXPECT_EQ(companion.value().signs[1].limit_kmh, 50.0);
  EXPECT_EQ(companion.value().flows[0].vehph, 360.0);
  ClickOn(15.0, 0.0);
  Click("delete sign 1");
  ASSERT_EQ(document().companion.signs.size(), 1u);
  EXPECT_EQ(document().companion.signs[0].kind, traffic_map::SignKind::kSpeedLimit);
  // A lane where nothing starts has no flow.
  ClickOn(45.0, 0.0);
  ASSERT_EQ(work().session.selection.lanes, (std::set<std::int32_t>{2}));
  EXPECT_FALSE(work().places.contains("flow"));
}

TEST_F(EditorAppTest, HeightsFieldByFieldAndTheirProfile) {
  OpenTheGoodMap();
  Press(SDL_SCANCODE_H);  // or a handle would be taken
  ClickOn(15.0, 1.5);
  ASSERT_EQ(work().session.selection.curves, (std::set<std::int32_t>{1}));
  window::Image flat, hilly;
  app_->Frame(0, &flat);
  Click("height 1");
  const char* heights[] = {"2", "2.5", "-1", "4"};
  for (const char* height : heights) {
    Write(height);
    Press(SDL_SCANCODE_TAB);
  }
  EXPECT_EQ(document().companion.Of(1), (std::array<double, 4>{2.0, 2.5, -1.0, 4.0}));
  EXPECT_EQ(document().companion.Of(2), (std::array<double, 4>{}));
  ClickOn(15.0, -20.0);  // away from the fields
  ClickOn(15.0, 1.5);
  app_->Frame(0, &hilly);
  // The profile is drawn: highest at its right end, 4 m, lowest in between.
  ASSERT_TRUE(work().places.contains("profile"));
  const Eigen::Vector2d middle = work().places["profile"];
  int changed = 0;
  for (int y = -24; y < 24; ++y) {
    for (int x = -60; x < 60; ++x) {
      const int px = static_cast<int>(middle.x()) + x, py = static_cast<int>(middle.y()) + y;
      changed += std::equal(flat.At(px, py), flat.At(px, py) + 3, hilly.At(px, py)) ? 0 : 1;
    }
  }
  EXPECT_GT(changed, 60);
  Keep("editor_heights.png");
  for (int i = 0; i < 4; ++i) Press(SDL_SCANCODE_Z, KMOD_CTRL);
  EXPECT_EQ(document().companion.Of(1), (std::array<double, 4>{}));
}

TEST_F(EditorAppTest, LightsWithTheirPhases) {
  OpenTheGoodMap();
  ClickOn(15.0, 0.0);
  Click("Traffic lights");
  Click("new lights");
  ASSERT_EQ(document().companion.lights.size(), 1u);
  const auto plan = [&]() -> const lights::LightPlan& { return document().companion.lights[0]; };
  EXPECT_EQ(plan().Names(), (std::vector<std::string>{"1"}));
  ASSERT_EQ(plan().phases.size(), 2u);
  Fill("lights 1 phase 1", "25");
  EXPECT_EQ(plan().phases[0].green_s, 25.0);
  Fill("lights 1 amber, s", "4");
  EXPECT_EQ(plan().amber_s, 4.0);
  Fill("lights 1 all red, s", "2.5");
  EXPECT_EQ(plan().all_red_s, 2.5);
  Fill("lights 1 offset, s", "7");
  EXPECT_EQ(plan().offset_s, 7.0);
  Fill("lights 1 red and amber, s", "2");
  EXPECT_EQ(plan().red_amber_s, 2.0);
  Click("lights 1 add phase");
  ASSERT_EQ(plan().phases.size(), 3u);
  Click("delete lights 1 phase 3");
  EXPECT_EQ(plan().phases.size(), 2u);
  // Another lane's green in the second phase.
  ClickOn(45.0, 0.0);
  Click("lights 1 phase 2 chosen");
  EXPECT_EQ(plan().phases[1].green, (std::vector<std::string>{"2"}));
  // 25 + 20 s of green, and between the phases amber and red for all.
  EXPECT_EQ(plan().cycle_s(), 25.0 + 20.0 + 2.0 * (4.0 + 2.5));
  Keep("editor_lights.png");
  Click("delete lights 1");
  EXPECT_TRUE(document().companion.lights.empty());
}

TEST_F(EditorAppTest, TheVisibleWidthIsShownAndSet) {
  OpenTheGoodMap();
  const Eigen::Vector2d middle = work().view.middle_W;
  Fill("visible width", "98");
  EXPECT_DOUBLE_EQ(work().view.width_m(), 98.0);
  EXPECT_EQ(work().view.middle_W, middle);
  // What is that wide reaches from edge to edge: the canvas is 980 pixels wide, so 60 m of road are 600.
  const Eigen::Vector2i west = On(0.0, 0.0), east = On(60.0, 0.0);
  EXPECT_EQ(east.x() - west.x(), 600);
  Fill("visible width", "0");
  EXPECT_GT(work().view.width_m(), 0.0);
  Fill("visible width", "1e300");
  EXPECT_LT(work().view.width_m(), 1e7);
}

TEST_F(EditorAppTest, NewElementsByTheirButtons) {
  work().view.metres_per_px = 0.1;
  Click("New Curve");
  EXPECT_EQ(document().map.curves.size(), 1u);
  Click("New Lane");
  EXPECT_EQ(work().form, Form::kLane);
  ChooseOne("left curve border", "Single");
  Click("right curve inverted");
  EXPECT_EQ(work().lane_form.left_type, 2);
  EXPECT_TRUE(work().lane_form.right_inverted);
  Click("Cancel");
  EXPECT_EQ(work().form, Form::kNone);
  Click("New Connection");
  EXPECT_EQ(work().form, Form::kConnection);
  Press(SDL_SCANCODE_ESCAPE);
  // A lane along a line, as wide and for what the fields say.
  Click("Lane along a line");
  Fill("lane width", "4.5");
  ChooseOne("lane mode", "start");
  Drag(On(-30.0, -10.0), On(20.0, -10.0));
  ASSERT_EQ(document().map.lanes.size(), 1u);
  EXPECT_EQ(document().map.lanes[0].value.mode, traffic_map::LaneMode::kStart);
  const auto borders = editor::BordersOf(document(), document().map.lanes[0].value);
  EXPECT_NEAR((borders->left.At(0.5) - borders->right.At(0.5)).norm(), 4.5, 1e-5);
  ChooseOne("lane mode", "end");
  Drag(On(20.0, -10.0), On(45.0, -10.0));
  Click("Lane along a line");
  EXPECT_EQ(work().tool, Tool::kChoose);
  Click("Connect");
  EXPECT_EQ(Said(), "connection 1 to 2 made");
  EXPECT_FALSE(work().places.contains("Connect")) << "nothing is left to connect";
}

TEST_F(EditorAppTest, TheMenusDoWhatTheirKeysDo) {
  const auto menu = [this](const char* title, const char* entry) {
    Click(std::string("menu ") + title);
    Click(entry);
  };
  menu("Draw", "New curve");
  EXPECT_EQ(document().map.curves.size(), 1u);
  menu("Edit", "Undo");
  EXPECT_TRUE(document().map.curves.empty());
  menu("Edit", "Redo");
  EXPECT_EQ(document().map.curves.size(), 1u);
  menu("View", "Handles");
  EXPECT_FALSE(work().handles);
  menu("Edit", "Choose all");
  EXPECT_EQ(work().session.selection.curves.size(), 1u);
  Keep("editor_menu.png");
  menu("Help", "Keys and mouse");
  EXPECT_EQ(work().form, Form::kKeys);
  Click("Good");
  menu("Background", "Import…");
  EXPECT_TRUE(work().files.open());
  Press(SDL_SCANCODE_ESCAPE);
  menu("Traffic", "Run, pause");
  EXPECT_FALSE(work().session.said().good) << "there is nothing to drive on";
  menu("File", "Quit");
  EXPECT_EQ(work().form, Form::kUnsaved);
}

TEST_F(EditorAppTest, NamesInGreekAndPortugueseAreOpenedFromTheList) {
  // Files that a person sees in the list and clicks on; the status line says their names.
  for (const char* name : {"Πάτρα.motors", "São João.motors"}) {
    ASSERT_TRUE(base::WriteWhole(At(name), traffic_map::GoodMap()).ok());
    Press(SDL_SCANCODE_O, KMOD_CTRL);
    ASSERT_TRUE(work().files.open());
    Write(At(name).string());
    Press(SDL_SCANCODE_RETURN);
    EXPECT_EQ(Said(), std::string("opened ") + name);
  }
  Press(SDL_SCANCODE_O, KMOD_CTRL);
  Keep("editor_files.png");
  Press(SDL_SCANCODE_ESCAPE);
}

TEST_F(EditorAppTest, TrafficByItsPanel) {
  OpenTheGoodMap();
  Fill("vehicles", "5");
  EXPECT_EQ(work().traffic.vehicles, 5);
  Click("Run");
  ASSERT_TRUE(work().traffic.runs) << Said();
  for (int i = 0; i < 60; ++i) app_->Frame(0);
  EXPECT_FALSE(work().traffic.heat.empty());
  Click("Run");
  EXPECT_FALSE(work().traffic.runs);
  const double paused_s = work().traffic.preview->time_s();
  for (int i = 0; i < 10; ++i) app_->Frame(0);
  EXPECT_EQ(work().traffic.preview->time_s(), paused_s);
  window::Image with, without;
  app_->Frame(0, &with);
  Click("heat map");
  EXPECT_FALSE(work().heat);
  app_->Frame(0, &without);
  EXPECT_NE(with, without);
  Click("Stop");
  EXPECT_FALSE(work().traffic.preview);
  // Pace by its slider: at the left end slowest, at the right end fastest.
  ASSERT_TRUE(work().places.contains("pace"));
  const Eigen::Vector2i pace = work().places["pace"].cast<int>();
  Drag(pace, {pace.x() + 400, pace.y()});
  EXPECT_EQ(work().traffic.pace, 20.0f);
}

TEST_F(EditorAppTest, TheBackgroundByItsPanel) {
  OpenTheGoodMap();
  Click("Import Background");
  EXPECT_TRUE(work().files.open());
  Press(SDL_SCANCODE_ESCAPE);
  EXPECT_FALSE(work().files.open());
  Fill("scale", "0");
  EXPECT_FALSE(work().session.said().good);
  EXPECT_EQ(document().map.scale.value.value, 10.0f);
  Fill("scale", "2.5");
  EXPECT_EQ(document().map.scale.value.value, 2.5f);
}

}  // namespace
}  // namespace rodeira::nodes
