// SPDX-License-Identifier: Apache-2.0
// The desk by mouse and keyboard, without a display: the thesis' example, and what its editor lacked.
#include <fmt/format.h>

#include "common/world/traffic_map/check.hpp"
#include "tests/names.hpp"
#include "tests/nodes/editor/editor_app_fixture.hpp"

namespace rodeira::nodes {
namespace {

// A picture with something on it, as a PPM made into PNG by the window's own writer.
void WritePhotograph(const std::filesystem::path& path) {
  window::Image image{400, 300, {}};
  for (int y = 0; y < 300; ++y) {
    for (int x = 0; x < 400; ++x) {
      const bool road = std::abs(y - 150) < 12;
      for (const int value :
           {road ? 110 : 70 + (x * 7 + y * 3) % 23, road ? 110 : 110 + (x * 5 + y * 11) % 31, road ? 112 : 60})
        image.rgb.push_back(static_cast<std::uint8_t>(value));
    }
  }
  ASSERT_TRUE(window::WritePng(path, image).ok());
}

TEST_F(EditorAppTest, TheThesisExampleIsDrawnByHand) {
  work().view.metres_per_px = 0.1;
  WritePhotograph(At("photo.png"));
  Press(SDL_SCANCODE_B);
  ASSERT_TRUE(work().files.open());
  Write(At("photo.png").string());
  Press(SDL_SCANCODE_RETURN);
  EXPECT_EQ(Said(), "background imported");
  ASSERT_NE(work().picture.picture(), nullptr);
  // Two parallel curves with four handles each; their ends are drawn to where the lane should be.
  Press(SDL_SCANCODE_C);
  Press(SDL_SCANCODE_C);
  ASSERT_EQ(document().map.curves.size(), 2u);
  EXPECT_EQ(document().map.curves[1].value.id, 2);
  const auto place = [&](int curve, double y_m, double from_m, double to_m) {
    for (const int handle : {0, 3, 1, 2}) {
      const auto& p =
          document().map.curves[static_cast<std::size_t>(curve)].value.points[static_cast<std::size_t>(handle)];
      Drag(On(static_cast<double>(p.x_m), static_cast<double>(p.y_m)),
           On(from_m + (to_m - from_m) * handle / 3.0, y_m));
    }
  };
  place(0, 3.0, -40.0, 0.0);
  place(1, 0.0, -40.0, 0.0);
  const double pixel_m = 1.01 * work().view.metres_per_px;
  EXPECT_NEAR(static_cast<double>(document().map.curves[0].value.points[0].x_m), -40.0, pixel_m);
  EXPECT_NEAR(static_cast<double>(document().map.curves[0].value.points[2].y_m), 3.0, pixel_m);
  // A start lane between them.
  Press(SDL_SCANCODE_N);
  Write("1");
  Press(SDL_SCANCODE_TAB);
  Write("2");
  Click("mode start");
  Press(SDL_SCANCODE_RETURN);
  EXPECT_EQ(Said(), "lane 1 made");
  EXPECT_EQ(document().map.lanes.at(0).value.mode, traffic_map::LaneMode::kStart);
  // Curves that do not exist are told in red.
  Press(SDL_SCANCODE_N);
  Write("5");
  Press(SDL_SCANCODE_TAB);
  Write("6");
  Press(SDL_SCANCODE_RETURN);
  EXPECT_THAT(Said(), Names("no lane … left curve 5"));
  EXPECT_FALSE(work().session.said().good);
  // The second pair, with ends that catch the first, and the end lane.
  Press(SDL_SCANCODE_C);
  Press(SDL_SCANCODE_C);
  place(2, 3.0, 0.0, 40.0);
  place(3, 0.0, 0.0, 40.0);
  EXPECT_EQ(document().map.curves[2].value.points[0], document().map.curves[0].value.points[3]);
  Press(SDL_SCANCODE_N);
  Write("3");
  Press(SDL_SCANCODE_TAB);
  Write("4");
  Click("mode end");
  Press(SDL_SCANCODE_RETURN);
  // The connection.
  Press(SDL_SCANCODE_K);
  Write("1");
  Press(SDL_SCANCODE_TAB);
  Write("2");
  Press(SDL_SCANCODE_RETURN);
  EXPECT_EQ(Said(), "connection 1 to 2 made");
  Keep("editor_example.png");
  // The scale by its field; saved, and read by the program that drives on it.
  Click("scale");
  Write("12.5");
  Press(SDL_SCANCODE_RETURN);
  EXPECT_EQ(document().map.scale.value.value, 12.5f);
  Press(SDL_SCANCODE_S, KMOD_CTRL);
  ASSERT_TRUE(work().files.open());
  Write(At("example").string());
  Press(SDL_SCANCODE_RETURN);
  EXPECT_EQ(Said(), "saved example.motors");
  const auto lanes = traffic_map::LoadLaneMap(At("example.motors"));
  ASSERT_TRUE(lanes.ok()) << lanes.error().Text();
  EXPECT_EQ(lanes.value().connections.size(), 1u);
  EXPECT_EQ(lanes.value().picture_height_m, 125.0);
  EXPECT_EQ(traffic_map::LoadMap(At("example.motors")).value().picture, base::ReadText(At("photo.png")).value());
  // Traffic on it.
  work().traffic.vehicles = 4;
  Press(SDL_SCANCODE_SPACE);
  work().traffic.pace = 4.0f;
  for (int i = 0; i < 100; ++i) app_->Frame(0);
  ASSERT_TRUE(work().traffic.preview);
  EXPECT_GT(work().traffic.preview->time_s(), 4.0);
  EXPECT_FALSE(work().traffic.heat.empty());
  Keep("editor_traffic.png");
}

TEST_F(EditorAppTest, UndoByKeys) {
  Press(SDL_SCANCODE_C);
  Press(SDL_SCANCODE_Z, KMOD_CTRL);
  EXPECT_TRUE(document().map.curves.empty());
  Press(SDL_SCANCODE_Y, KMOD_CTRL);
  EXPECT_EQ(document().map.curves.size(), 1u);
}

TEST_F(EditorAppTest, PanAndZoomHoldThePlane) {
  const Eigen::Vector2d middle = work().view.middle_W;
  const double finest = work().view.metres_per_px;
  pushed_input::MoveTo(700, 300);
  pushed_input::Wheel(3);
  Show();
  EXPECT_LT(work().view.metres_per_px, finest);
  const Eigen::Vector2d held = work().view.ToWorld({600.0 - kLeft_px, 400.0 - kTop_px});
  Drag({600, 400}, {700, 350});
  EXPECT_LT((work().view.ToWorld({700.0 - kLeft_px, 350.0 - kTop_px}) - held).norm(), 1e-6);
  const double before = work().view.middle_W.x();
  pushed_input::Key(SDL_SCANCODE_D, true);
  for (int i = 0; i < 30; ++i) app_->Frame(0);
  pushed_input::Key(SDL_SCANCODE_D, false);
  Show();
  EXPECT_GT(work().view.middle_W.x(), before);
  EXPECT_NE(work().view.middle_W, middle);
}

TEST_F(EditorAppTest, ALaneInOneGestureAndTheProposedConnection) {
  work().view.metres_per_px = 0.1;
  Press(SDL_SCANCODE_L);
  Drag(On(-40.0, 0.0), On(0.0, 0.0));
  Drag(On(0.3, 0.2), On(30.0, 15.0));
  ASSERT_EQ(document().map.lanes.size(), 2u);
  EXPECT_TRUE(document().map.connections.empty());
  Press(SDL_SCANCODE_ESCAPE);
  Press(SDL_SCANCODE_P);
  EXPECT_EQ(Said(), "connection 1 to 2 made");
  for (const traffic_map::Finding& finding : work().session.Findings())
    EXPECT_EQ(finding.sentence.find("jumps"), std::string::npos) << finding.Text();
  Keep("editor_gesture.png");
}

TEST_F(EditorAppTest, ATemplateIsPlacedTurnedAndDrivenOn) {
  Press(SDL_SCANCODE_2);
  Drag(On(0.0, 0.0), On(10.0, 3.0));
  EXPECT_EQ(Said(), "roundabout made");
  Press(SDL_SCANCODE_F);
  Press(SDL_SCANCODE_SPACE);
  ASSERT_TRUE(work().traffic.preview) << Said();
  work().traffic.pace = 8.0f;
  for (int i = 0; i < 60; ++i) app_->Frame(0);
  Keep("editor_roundabout.png");
  // Edited: it pauses, and begins anew when asked.
  Press(SDL_SCANCODE_C);
  EXPECT_FALSE(work().traffic.runs);
  Press(SDL_SCANCODE_Z, KMOD_CTRL);
  Press(SDL_SCANCODE_SPACE);
  EXPECT_TRUE(work().traffic.runs);
}

TEST_F(EditorAppTest, ARectangleChoosesAndDeleteTakesAlong) {
  Press(SDL_SCANCODE_1);
  pushed_input::Click(On(0.0, 0.0).x(), On(0.0, 0.0).y());
  Show();
  ASSERT_EQ(Said(), "crossing made");
  Press(SDL_SCANCODE_F);
  pushed_input::Key(SDL_SCANCODE_LSHIFT, true, KMOD_LSHIFT);
  Drag(On(-76.0, -76.0), On(76.0, 76.0));
  pushed_input::Key(SDL_SCANCODE_LSHIFT, false);
  Show();
  EXPECT_EQ(work().session.selection.lanes.size(), document().map.lanes.size());
  Press(SDL_SCANCODE_DELETE);
  EXPECT_TRUE(document().map.curves.empty());
  Press(SDL_SCANCODE_Z, KMOD_CTRL);
  EXPECT_EQ(document().map.lanes.size(), 20u);
}

TEST_F(EditorAppTest, JoinedHandlesMoveTogetherAndInOneStepBack) {
  OpenTheGoodMap();
  const std::string before = editor::BytesOf(document());
  const auto point = [&](std::int32_t curve, std::size_t index) {
    return document().map.curves[*editor::Find(document().map.curves, curve)].value.points[index];
  };
  Drag(On(30.0, 1.5), On(31.0, 4.0));  // where curves 1, 3 and 5 meet
  EXPECT_NEAR(static_cast<double>(point(1, 3).y_m), 4.0, 0.2);
  EXPECT_EQ(point(3, 3), point(1, 3));
  EXPECT_EQ(point(5, 0), point(1, 3));
  Press(SDL_SCANCODE_Z, KMOD_CTRL);
  EXPECT_EQ(editor::BytesOf(document()), before);
  pushed_input::Key(SDL_SCANCODE_LALT, true, KMOD_LALT);
  Drag(On(30.0, 1.5), On(31.0, 4.0));
  pushed_input::Key(SDL_SCANCODE_LALT, false);
  Show();
  int moved = 0;
  for (const auto& [curve, index] : {std::pair(1, 3u), std::pair(3, 3u), std::pair(5, 0u)})
    moved += point(curve, index).y_m > 2.0f ? 1 : 0;
  EXPECT_EQ(moved, 1);
  Press(SDL_SCANCODE_Z, KMOD_CTRL);
  // All that is chosen goes along.
  Press(SDL_SCANCODE_A, KMOD_CTRL);
  Drag(On(20.0, 1.5), On(20.0, 21.5));
  EXPECT_NEAR(static_cast<double>(point(6, 3).y_m), 30.0, 0.2);
  EXPECT_NEAR(static_cast<double>(point(2, 0).y_m), 18.5, 0.2);
}

TEST_F(EditorAppTest, TheBackgroundIsScaledByAKnownDistance) {
  work().view.metres_per_px = 0.1;
  Press(SDL_SCANCODE_M);
  Drag(On(-20.0, 5.0), On(20.0, 5.0));
  ASSERT_EQ(work().form, Form::kMeasured);
  Write("100");
  Press(SDL_SCANCODE_RETURN);
  EXPECT_NEAR(static_cast<double>(document().map.scale.value.value), 25.0, 0.1);
  Press(SDL_SCANCODE_Z, KMOD_CTRL);
  EXPECT_EQ(document().map.scale.value.value, 10.0f);
}

TEST_F(EditorAppTest, HandlesNumbersAndTheCentreAreHidden) {
  OpenTheGoodMap();
  // Of the colour that handles have.
  const auto yellow = [&] {
    window::Image seen;
    app_->Frame(0, &seen);
    int count = 0;
    for (std::size_t i = 0; i + 2 < seen.rgb.size(); i += 3)
      count += seen.rgb[i] == 255 && seen.rgb[i + 1] == 220 && seen.rgb[i + 2] == 90 ? 1 : 0;
    return count;
  };
  EXPECT_GT(yellow(), 20 * 25);  // some twenty places, seven pixels wide
  window::Image with, without;
  Press(SDL_SCANCODE_H);
  EXPECT_EQ(yellow(), 0);
  app_->Frame(0, &with);
  Press(SDL_SCANCODE_I);
  app_->Frame(0, &without);
  EXPECT_NE(with, without);
  Press(SDL_SCANCODE_O);
  app_->Frame(0, &with);
  EXPECT_NE(with, without);
  // A handle that is not seen is not taken: the ground is dragged.
  const std::string before = editor::BytesOf(document());
  Drag(On(30.0, 1.5), On(31.0, 4.0));
  EXPECT_EQ(editor::BytesOf(document()), before);
}

// White where the road has it: a bar of 0.3 m before a STOP, strokes of 0.5 m with gaps of 0.3 m where one gives way (4
// on a lane of 3 m).
TEST_F(EditorAppTest, LinesWhereOneStopsOrGivesWayArePainted) {
  OpenTheGoodMap();
  work().session.Do([](editor::Document& document) {
    return editor::SetSigns(document, {{2, traffic_map::SignKind::kGiveWay, 0.0, 0.0, 0}});
  });
  work().handles = work().numbers = work().centre = false;
  work().view.metres_per_px = 0.02;
  const auto white = [&](double x_m, double y_m) {
    work().view.middle_W = {x_m, 0.0};
    window::Image seen;
    app_->Frame(0, &seen);
    const Eigen::Vector2i at = On(x_m, y_m);
    const std::uint8_t* pixel = seen.At(at.x(), at.y());
    return pixel[0] > 240 && pixel[1] > 240 && pixel[2] > 240;
  };
  for (const double y_m : {-1.3, -0.8, 0.3, 1.3}) {
    EXPECT_TRUE(white(29.7, y_m)) << y_m;
    EXPECT_FALSE(white(29.5, y_m)) << y_m;
  }
  for (const double y_m : {-1.2, -0.4, 0.4, 1.2}) EXPECT_TRUE(white(59.7, y_m)) << y_m;
  for (const double y_m : {-0.8, 0.1, 0.8}) EXPECT_FALSE(white(59.7, y_m)) << y_m;
}

TEST_F(EditorAppTest, ResetIsAskedFor) {
  OpenTheGoodMap();
  Press(SDL_SCANCODE_R, KMOD_CTRL);
  ASSERT_EQ(work().form, Form::kReset);
  Press(SDL_SCANCODE_ESCAPE);
  EXPECT_EQ(document().map.lanes.size(), 3u);
  Press(SDL_SCANCODE_R, KMOD_CTRL);
  Press(SDL_SCANCODE_RETURN);
  EXPECT_TRUE(document().map.curves.empty());
}

TEST_F(EditorAppTest, ABrokenFileAndAPictureThatIsNoneAreSaidInTheStatusLine) {
  ASSERT_TRUE(base::WriteWhole(At("broken.motors"), "p,1,2\n").ok());
  ASSERT_TRUE(base::WriteWhole(At("letter.png"), "Dear all").ok());
  Press(SDL_SCANCODE_C);
  Press(SDL_SCANCODE_Z, KMOD_CTRL);
  Press(SDL_SCANCODE_O, KMOD_CTRL);
  Write(At("broken.motors").string());
  Press(SDL_SCANCODE_RETURN);
  EXPECT_NE(Said().find("broken.motors:1"), std::string::npos) << Said();
  Press(SDL_SCANCODE_B);
  Write(At("letter.png").string());
  Press(SDL_SCANCODE_RETURN);
  EXPECT_NE(Said().find("this is no picture"), std::string::npos) << Said();
  EXPECT_FALSE(work().session.said().good);
  EXPECT_TRUE(work().session.history().CanRedo());
  // A map with a wrong background opens, and says so.
  ASSERT_TRUE(base::WriteWhole(At("odd.motors"), traffic_map::GoodMap() + "no picture at all").ok());
  Sit(At("odd.motors"));
  EXPECT_EQ(document().map.lanes.size(), 3u);
  EXPECT_NE(Said().find("the background cannot be shown"), std::string::npos) << Said();
}

// By default every ten seconds.
TEST_F(EditorAppTest, WorkIsKeptWhileItIsUnsaved) {
  Press(SDL_SCANCODE_C);
  app_->KeepEvery(0.5);
  for (int i = 0; i < 40; ++i) app_->Frame(0);
  auto other = editor::Keeper::Make(At("kept"));
  ASSERT_TRUE(other.ok());
  EXPECT_TRUE(other.value().Found().empty()) << "its editor lives";
  app_.reset();
  const auto found = other.value().Found();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(editor::Keeper::Restore(found[0]).value().document.map.curves.size(), 1u);
}

}  // namespace
}  // namespace rodeira::nodes
