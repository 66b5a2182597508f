// SPDX-License-Identifier: Apache-2.0
// A person's session, by mouse and keyboard in real windows on a virtual display: from the start window to a picture
// and a recording.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <thread>

#include "common/core/base/files.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "common/data/record/mcap_reader.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "tests/nodes/view/read_png.hpp"
#include "tests/system/command.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

constexpr int kScreenWidth = 1280, kScreenHeight = 1024;

bool Has(const std::string& program) { return RunCommand({"/bin/sh", "-c", "command -v " + program}).status == 0; }

bool Until(std::chrono::seconds limit, const std::function<bool()>& is) {
  const auto end = std::chrono::steady_clock::now() + limit;
  while (std::chrono::steady_clock::now() < end) {
    if (is()) return true;
    std::this_thread::sleep_for(100ms);
  }
  return false;
}

std::vector<fs::path> FilesOn(const fs::path& folder, const std::string& ending) {
  std::vector<fs::path> files;
  std::error_code problem;
  for (fs::directory_iterator entry(folder, problem), end; !problem && entry != end; entry.increment(problem)) {
    if (entry->path().extension() == ending) files.push_back(entry->path());
  }
  return files;
}

// What a recording holds so far, also while it is being written.
struct Recorded {
  int placed = 0;
  double driven_m = 0.0;
};

Recorded ReadRecorded(const fs::path& file) {
  Recorded recorded;
  const auto reader = record::McapReader::Open(file);
  if (!reader.ok()) return recorded;
  auto cursor = reader.value().Messages();
  for (auto next = cursor.Next(); next.ok() && next.value(); next = cursor.Next()) {
    const std::string& topic = reader.value().channels().at(next.value()->channel).topic;
    if (topic == idl::topics::kVehicleState)
      recorded.driven_m = idl::Decode<msg::VehicleState>(next.value()->data).value().odometer_m();
    if (topic != idl::topics::kScenarioEvents) continue;
    const auto sample = idl::Decode<msg::ScenarioEvents>(next.value()->data).value();
    for (const msg::ScenarioEvent& event : sample.events()) recorded.placed += event.name() == "vehicle.place" ? 1 : 0;
  }
  return recorded;
}

constexpr int kWidth = 1280, kHeight = 720;  // of the run's window

// How much of the lower left corner, where a chosen vehicle's panel stands (nodes/view/overlays/instruments), is as it
// was behind glass of the panel's colour, 0.05 of green, that lets 0.45 through: all of it but its letters, which are
// less than a quarter.
double BehindGlass(const nodes::Image& before, const nodes::Image& after) {
  int behind = 0, all = 0;
  for (int y = kHeight - 130; y < kHeight - 25; ++y) {
    for (int x = 25; x < 410; ++x, ++all)
      behind += std::abs(after.At(x, y)[1] - (0.45 * before.At(x, y)[1] + 0.55 * 0.05 * 255.0)) < 4.0 ? 1 : 0;
  }
  return static_cast<double>(behind) / all;
}

// Red, yellow and green from left to right, where the legend's bar is (nodes/view/overlays/heat_node).
bool HasLegend(const nodes::Image& image) {
  constexpr int kBar = 157;
  const std::uint8_t *red = image.At(32, kBar), *yellow = image.At(208, kBar), *green = image.At(384, kBar);
  return red[0] > 150 && red[1] < 90 && red[2] < 90 && yellow[0] > 150 && yellow[1] > 150 && yellow[2] < 90 &&
         green[0] < 90 && green[1] > 120 && green[2] < 90;
}

class Session : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!Has("Xvfb") || !Has("xdotool")) GTEST_SKIP() << "the packages xvfb and xdotool are not there";
    const fs::path number = folder_.path() / "display";
    server_ = std::make_unique<Started>(
        std::vector<std::string>{"/bin/sh", "-c",
                                 "exec Xvfb -noreset -displayfd 3 -fbdir " + folder_.path().string() +
                                     " -screen 0 1280x1024x24 3>" + number.string() + " 2>/dev/null"});
    ASSERT_TRUE(Until(20s, [&] {
      const auto text = base::ReadText(number);
      if (!text || text.value().find('\n') == std::string::npos) return false;
      display_ = text.value().substr(0, text.value().find('\n'));
      return true;
    })) << "the virtual display does not start";
  }
  void TearDown() override {
    if (server_ != nullptr) ::kill(server_->pid(), SIGTERM);
  }
  std::string Do(std::vector<std::string> words) const {
    words.insert(words.begin(), {"DISPLAY=:" + display_, "/usr/bin/env", "xdotool"});
    return RunCommand(words).out;
  }
  // Down long enough to be seen by a window that draws slowly.
  void Click(int x, int y) const {
    Do({"mousemove", std::to_string(x), std::to_string(y)});
    std::this_thread::sleep_for(200ms);
    Do({"mousedown", "1"});
    std::this_thread::sleep_for(200ms);
    Do({"mouseup", "1"});
  }
  // The window of that name, once it is there; it has the keyboard then.
  bool Focus(const std::string& name, std::chrono::seconds limit) const {
    std::string window;
    const bool there = Until(limit, [&] {
      window = Do({"search", "--name", name});
      return !window.empty();
    });
    if (there) Do({"windowfocus", window.substr(0, window.find('\n'))});
    return there;
  }

  // Waits until the display shows a window that no longer changes: two looks at its memory are alike.
  bool IsDrawn(std::chrono::seconds limit) const {
    std::string before;
    return Until(limit, [&] {
      std::ifstream file(folder_.path() / "Xvfb_screen0", std::ios::binary);
      std::string now{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
      const bool is_drawn = now == before && now.size() - std::ranges::count(now, '\0') > 100'000;
      before = std::move(now);
      return is_drawn;
    });
  }

  base::TemporaryFolder folder_ = base::TemporaryFolder::Make("session").value();
  std::unique_ptr<Started> server_;
  std::string display_;
};

// A slow machine draws seconds later than it is asked: every step waits for what a person would see before the next.
TEST_F(Session, FromTheStartWindowToAPictureAndARecordingThatReplays) {
  const std::string data = folder_.path().string();
  const fs::path pictures = folder_.path() / "rodeira/pictures";
  const auto whole_pictures = [&] {
    const auto files = FilesOn(pictures, ".png");
    return std::count_if(files.begin(), files.end(), [](const fs::path& file) { return fs::file_size(file) > 10'000; });
  };
  fs::create_directory(folder_.path() / "desk");
  const std::string runtime = "XDG_RUNTIME_DIR=" + data + "/desk";  // no other run is asked
  Started start({"DISPLAY=:" + display_, "XDG_DATA_HOME=" + data, runtime, "SDL_AUDIODRIVER=dummy", Bin("rodeira")});
  ASSERT_TRUE(Focus("^Rodeira$", 60s)) << "the start window";
  ASSERT_TRUE(IsDrawn(60s)) << "the start window is drawn";
  constexpr int kLeft = (kScreenWidth - 820) / 2, kTop = (kScreenHeight - 640) / 2;
  Click(kLeft + 77, kTop + 197);  // start
  ASSERT_TRUE(Until(60s, [&] { return !FilesOn(folder_.path() / "rodeira", ".mcap").empty(); })) << "a recording";
  const fs::path recording = FilesOn(folder_.path() / "rodeira", ".mcap")[0];
  // A picture shows that the run's window is drawn and takes keys.
  ASSERT_TRUE(Until(120s, [&] {
    if (!Focus("^Rodeira: ", 60s)) return false;
    Do({"key", "F12"});
    return Until(5s, [&] { return whole_pictures() > 0; });
  })) << "the run's window";
  ASSERT_TRUE(Until(60s, [&] { return fs::file_size(recording) > 100'000; })) << "a second of the run";
  EXPECT_TRUE(Until(60s, [&] {
    Do({"key", "F6"});
    std::this_thread::sleep_for(500ms);
    Click(500, (kScreenHeight - 720) / 2 + 440);  // on the road before the car, or beside it
    return Until(5s, [&] { return ReadRecorded(recording).placed > 0; });
  })) << "the car is placed";
  Do({"keydown", "w"});
  EXPECT_TRUE(Until(60s, [&] { return ReadRecorded(recording).driven_m > 2.0; })) << "the car drives";
  Do({"keyup", "w"});
  const auto becomes = [&](const std::string& state) {
    return Until(60s, [&] {
      Do({"key", "space"});
      return Until(5s, [&] {
        return RunCommand({runtime, "/usr/bin/env", Bin("rodeira"), "ctl", "state"}).out.find(state) !=
               std::string::npos;
      });
    });
  };
  EXPECT_TRUE(becomes("paused at "));
  const auto picture = [&]() -> nodes::Image {
    const auto before = FilesOn(pictures, ".png");
    Do({"key", "F12"});
    EXPECT_TRUE(Until(60s, [&] { return whole_pictures() > static_cast<std::ptrdiff_t>(before.size()); }))
        << "a picture";
    for (const fs::path& file : FilesOn(pictures, ".png")) {
      if (std::find(before.begin(), before.end(), file) != before.end()) continue;
      // For people, where they ask for it.
      if (const char* kept = std::getenv("RODEIRA_PICTURES"))
        fs::copy_file(file, fs::path(kept) / ("session_" + std::to_string(before.size()) + ".png"),
                      fs::copy_options::overwrite_existing);
      return nodes::ReadPng(file);
    }
    return {};
  };
  // The picture after a hand has changed it, once two in succession are alike. Before the first hand the window comes
  // up with the run: then all its pictures are of one moment.
  const auto after = [&](const std::function<void()>& hand, const nodes::Image* before) {
    hand();
    nodes::Image last = picture();
    EXPECT_TRUE(Until(60s, [&] {
      nodes::Image now = picture();
      const bool is_still = now.rgb == last.rgb && (before == nullptr || now.rgb != before->rgb);
      last = std::move(now);
      return is_still;
    })) << "a picture that has changed and changes no more";
    return last;
  };
  const nodes::Image plain = after([] {}, nullptr);
  ASSERT_EQ(std::pair(plain.width_px, plain.height_px), std::pair(kWidth, kHeight));
  EXPECT_FALSE(HasLegend(plain));
  const auto click = [&](int y_px) {
    return [this, y_px] { Click(kScreenWidth / 2, (kScreenHeight - kHeight) / 2 + y_px); };
  };
  const auto key = [&](const char* name) { return [this, name] { Do({"key", name}); }; };
  constexpr int kOwnCar = 470, kSky = 20;  // of the camera behind the car
  const nodes::Image clicked = after(click(kOwnCar), &plain);
  EXPECT_GT(BehindGlass(plain, clicked), 0.75) << "the panel of the car that was clicked on";
  EXPECT_LT(BehindGlass(plain, plain), 0.05);
  EXPECT_TRUE(std::equal(plain.rgb.begin(), plain.rgb.begin() + 3 * kWidth * 200, clicked.rgb.begin()))
      << "and nothing else above it";
  EXPECT_EQ(after(click(kSky), &clicked).rgb, plain.rgb) << "no vehicle is chosen";
  const nodes::Image next = after(key("Tab"), &plain), followed = after(click(kSky), &next);
  EXPECT_GT(BehindGlass(followed, next), 0.75) << "the panel of the vehicle that was chosen by the key";
  EXPECT_NE(followed.rgb, plain.rgb) << "which is still followed";
  EXPECT_EQ(after(key("shift+Tab"), &followed).rgb, plain.rgb) << "home again";
  Do({"key", "F9"});
  Do({"key", "F8"});
  EXPECT_TRUE(Until(60s, [&] { return HasLegend(picture()); })) << "statistics over the ground, from above";
  EXPECT_TRUE(becomes("runs "));
  ::kill(start.pid(), SIGINT);
  (void)start.Wait(60s);

  EXPECT_EQ(FilesOn(folder_.path() / "rodeira", ".mcap").size(), 1u);
  std::string said;
  ASSERT_TRUE(Until(60s, [&] {
    const Ended verified = RunCommand({Bin("rodeira"), "replay", recording.string(), "--verify"});
    said = verified.out;
    return verified.status == 0;
  })) << said;
  EXPECT_NE(said.find("live input taken from the recording: driver, story"), std::string::npos) << said;
  EXPECT_NE(said.find("identical: "), std::string::npos) << said;
  const Recorded whole = ReadRecorded(recording);
  EXPECT_GE(whole.placed, 1);
  EXPECT_GT(whole.driven_m, 2.0);
}

}  // namespace
}  // namespace rodeira::system_test
