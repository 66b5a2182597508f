// SPDX-License-Identifier: Apache-2.0
// `rodeira edit` in a real window (Xvfb), drawn with by a mouse and a keyboard (xdotool): the thesis' example from the
// photograph to the saved map, and traffic on it. Skipped where those two programs are not there.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "common/core/base/files.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "common/world/traffic_map/lane_map.hpp"
#include "tests/nodes/editor/editor_app_fixture.hpp"
#include "tests/tree.hpp"

namespace rodeira::nodes {
namespace {

const std::string kRodeira = BinaryDir() + "/bin/rodeira";

bool Has(const char* program) {
  return std::system(fmt::format("command -v {} >/dev/null 2>&1", program).c_str()) == 0;
}

// A program that ends with this.
class Running {
 public:
  explicit Running(const std::vector<std::string>& words, int told_fd = -1) {
    pid_ = ::fork();
    if (pid_ != 0) return;
    if (told_fd >= 0) ::dup2(told_fd, 3);
    std::vector<char*> argv;
    for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    ::execvp(argv[0], argv.data());
    ::_exit(127);
  }
  ~Running() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGTERM);
    ::waitpid(pid_, nullptr, 0);
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  // The exit status, or nothing where it has not ended in time.
  std::optional<int> Ends(double within_s) {
    int status = 0;
    for (int i = 0; i < within_s * 50.0; ++i) {
      if (::waitpid(pid_, &status, WNOHANG) == pid_) return pid_ = 0, WEXITSTATUS(status);
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return std::nullopt;
  }

 private:
  pid_t pid_ = 0;
};

// Where the forms' fields are, found on a desk of the same size without a display.
std::map<std::string, Eigen::Vector2d> PlacesOfTheLaneForm() {
  auto window = window::Window::Open({window::Kind::kOffscreen, 1280, 800, "test"});
  if (!window) return {};
  EditorApp app(*window.value(), {}, {});
  app.Frame(0);
  app.work().Open(Form::kLane);
  for (int i = 0; i < 4; ++i) app.Frame(0);
  return app.work().places;
}

class ARealWindow : public testing::Test {
 protected:
  void SetUp() override {
    if (!Has("Xvfb") || !Has("xdotool")) GTEST_SKIP() << "Xvfb and xdotool are not here";
    places_ = PlacesOfTheLaneForm();
    if (places_.empty()) GTEST_SKIP() << "no OpenGL here";
    auto made = base::TemporaryFolder::Make("desk");
    ASSERT_TRUE(made.ok());
    folder_.emplace(std::move(made).value());
    int told[2];
    ASSERT_EQ(::pipe(told), 0);
    server_.emplace(std::vector<std::string>{"Xvfb", "-displayfd", "3", "-screen", "0", "1280x800x24", "-nolisten",
                                             "tcp", "-noreset"},
                    told[1]);
    ::close(told[1]);
    std::string number;
    char letter = 0;
    while (::read(told[0], &letter, 1) == 1 && letter != '\n') number += letter;
    ::close(told[0]);
    ASSERT_FALSE(number.empty()) << "Xvfb does not start";
    ::setenv("DISPLAY", (":" + number).c_str(), 1);
    ::setenv("XDG_DATA_HOME", folder_->path().c_str(), 1);
    ::unsetenv("WAYLAND_DISPLAY");
  }
  void TearDown() override {
    editor_.reset();
    server_.reset();
  }

  std::filesystem::path At(const std::string& name) const { return folder_->path() / name; }
  void Tool(const std::string& words) const {
    EXPECT_EQ(std::system(("timeout 60 xdotool " + words + " >/dev/null 2>&1").c_str()), 0) << words;
  }
  // Keys and letters, one after the other, each given time to be drawn.
  void Key(const std::string& key) const { Tool("key --delay 25 " + key + " sleep 0.03"); }
  void Write(const std::string& text) const {
    Tool("key --delay 25 ctrl+a sleep 0.03 type --delay 8 '" + text + "'"), Tool("sleep 0.03");
  }
  void Click(const std::string& place) const {
    Tool(fmt::format("mousemove {:.0f} {:.0f} sleep 0.03 click 1 sleep 0.03", places_.at(place).x(),
                     places_.at(place).y()));
  }
  void Drag(const Eigen::Vector2d& from_W, const Eigen::Vector2d& to_W) const {
    const Eigen::Vector2d corner(EditorAppTest::kLeft_px, EditorAppTest::kTop_px),
        from = view_.ToPixels(from_W) + corner, to = view_.ToPixels(to_W) + corner, between = 0.5 * (from + to);
    Tool(
        fmt::format("mousemove {:.0f} {:.0f} sleep 0.03 mousedown 1 sleep 0.03 mousemove {:.0f} {:.0f} sleep 0.03 "
                    "mousemove {:.0f} {:.0f} sleep 0.03 mouseup 1 sleep 0.05",
                    from.x(), from.y(), between.x(), between.y(), to.x(), to.y()));
  }
  // A new curve, then its handles to where they belong.
  void DrawCurve(double y_m, double from_m, double to_m) const {
    Key("c");
    const double third_m = view_.width_m() / 6.0;
    for (const int handle : {0, 3, 1, 2})
      Drag({(handle - 1.5) * third_m * 2.0 / 3.0, 0.0}, {from_m + (to_m - from_m) * handle / 3.0, y_m});
  }
  void MakeLane(const std::string& left, const std::string& right, const std::string& mode) const {
    Key("n");
    Write(left);
    Key("Tab");
    Write(right);
    Click("mode " + mode);
    Key("Return");
  }
  static bool Within(double seconds, const std::function<bool()>& so) {
    for (int i = 0; i < seconds * 20.0 && !so(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return so();
  }

  std::map<std::string, Eigen::Vector2d> places_;
  std::optional<base::TemporaryFolder> folder_;
  std::optional<Running> server_, editor_;
  editor::Viewport view_{Eigen::Vector2d::Zero(), 0.1, 1280.0 - EditorAppTest::kLeft_px,
                         800.0 - EditorAppTest::kTop_px - 30.0};
};

TEST_F(ARealWindow, TheThesisExampleIsDrawnSavedAndDrivenOn) {
  window::Image photograph{400, 300, {}};
  for (int y = 0; y < 300; ++y) {
    for (int x = 0; x < 400; ++x) {
      const bool road = std::abs(y - 146) < 12;
      for (const int value :
           {road ? 110 : 70 + (x * 7 + y * 3) % 23, road ? 110 : 110 + (x * 5 + y * 11) % 31, road ? 112 : 60})
        photograph.rgb.push_back(static_cast<std::uint8_t>(value));
    }
  }
  ASSERT_TRUE(window::WritePng(At("photo.png"), photograph).ok());
  editor_.emplace(std::vector<std::string>{kRodeira, "edit"});
  Tool("search --sync --onlyvisible --name Rodeira windowfocus --sync sleep 0.5");
  DrawCurve(3.0, -40.0, 0.0);
  DrawCurve(0.0, -40.0, 0.0);
  MakeLane("1", "2", "start");
  DrawCurve(3.0, 0.0, 40.0);
  DrawCurve(0.0, 0.0, 40.0);
  MakeLane("3", "4", "end");
  Key("k");
  Write("1");
  Key("Tab");
  Write("2");
  Key("Return");
  Key("b");
  Write(At("photo.png").string());
  Key("Return");
  Tool("sleep 1");  // what is photographed below has the background then
  Key("F12");
  Key("ctrl+s");
  Write(At("example.motors").string());
  Key("Return");
  ASSERT_TRUE(Within(60.0, [&] { return std::filesystem::exists(At("example.motors")); })) << "nothing was saved";
  Key("space");
  Tool("sleep 2");
  Key("F12");
  Key("space");
  ASSERT_TRUE(Within(60.0, [&] { return std::filesystem::exists(At("rodeira/pictures/example.png")); }));
  Key("ctrl+q");
  EXPECT_EQ(editor_->Ends(60.0), 0);
  // The saved map is the one that was drawn.
  const auto map = traffic_map::LoadMap(At("example.motors"));
  ASSERT_TRUE(map.ok()) << map.error().Text();
  ASSERT_EQ(map.value().curves.size(), 4u);
  ASSERT_EQ(map.value().lanes.size(), 2u);
  EXPECT_EQ(map.value().lanes[0].value.mode, traffic_map::LaneMode::kStart);
  EXPECT_EQ(map.value().lanes[1].value.mode, traffic_map::LaneMode::kEnd);
  ASSERT_EQ(map.value().connections.size(), 1u);
  EXPECT_EQ(map.value().picture, base::ReadText(At("photo.png")).value());
  EXPECT_EQ(map.value().curves[0].value.points[3], map.value().curves[2].value.points[0]) << "ends catch each other";
  EXPECT_NEAR(static_cast<double>(map.value().curves[1].value.points[0].x_m), -40.0, 1.01 * view_.metres_per_px);
  EXPECT_EQ(std::system((kRodeira + " map check " + At("example.motors").string() + " >/dev/null").c_str()), 0);
  EXPECT_EQ(std::system((kRodeira + " traffic run " + At("example.motors").string() +
                         " --vehicles 4 --for 30 --quiet --heat " + At("heat.svg").string())
                            .c_str()),
            0);
  EXPECT_TRUE(std::filesystem::exists(At("heat.svg")));
  if (const char* kept = std::getenv("RODEIRA_PICTURES"); kept != nullptr) {
    std::filesystem::copy(At("rodeira/pictures/map.png"), std::filesystem::path(kept) / "real_drawn.png",
                          std::filesystem::copy_options::overwrite_existing);
    std::filesystem::copy(At("rodeira/pictures/example.png"), std::filesystem::path(kept) / "real_traffic.png",
                          std::filesystem::copy_options::overwrite_existing);
  }
}

}  // namespace
}  // namespace rodeira::nodes
