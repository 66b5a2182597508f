// SPDX-License-Identifier: Apache-2.0
// How far apart in simulated time three windows of one run are: left, centre, right of a laboratory, each a process,
// real time, on a display of their own, by their frame logs. windows_bench [SECONDS] [WIDTH HEIGHT]
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "common/core/base/files.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "tests/bench/live/shown.hpp"
#include "tests/bench/live/watched_display.hpp"
#include "tests/system/command.hpp"
#include "tests/tree.hpp"

namespace {

using namespace rodeira;

constexpr std::array kScreens = {"left", "centre", "right"};
constexpr double kFrom_s = 3.0;

// How far two windows are apart at each picture of the first: what the other one shows at that time of the wall; and
// their clocks, with time that goes evenly between their pictures.
struct Apart {
  std::vector<double> shown_ms, clocks_ms;
};

void Compare(const std::vector<bench::Shown>& one, const std::vector<bench::Shown>& other, Apart& apart) {
  for (const bench::Shown& now : one) {
    const auto next = std::upper_bound(other.begin(), other.end(), now.wall_s,
                                       [](double wall_s, const bench::Shown& shown) { return wall_s < shown.wall_s; });
    if (next == other.begin() || next == other.end()) continue;
    const bench::Shown& before = *std::prev(next);
    const double share = (now.wall_s - before.wall_s) / (next->wall_s - before.wall_s);
    apart.shown_ms.push_back(1e3 * std::fabs(now.simulated_s - before.simulated_s));
    apart.clocks_ms.push_back(
        1e3 * std::fabs(now.simulated_s - before.simulated_s - share * (next->simulated_s - before.simulated_s)));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const double seconds = argc > 1 ? std::atof(argv[1]) : 20.0;
  const int width = argc > 3 ? std::atoi(argv[2]) : 320, height = argc > 3 ? std::atoi(argv[3]) : 180;
  const bench::WatchedDisplay display(95, 3 * width, height);
  const auto folder = base::TemporaryFolder::Make("windows");
  const std::string root = SourceDir() + "/configs/";
  std::string text = fmt::format(
      "rodeira: launch/1\nname: windows\nlab: {0}labs/three_screens.yaml\nworld: {0}worlds/n222.yaml\nseed: 1\npace: "
      "real\nduration_s: {1}\nnodes:\n  road: {{kind: road}}\n"
      "  driver: {{kind: input, config: {{source: autopilot, driver: {0}drivers/default.yaml, vehicle: "
      "{0}vehicles/default.yaml}}}}\n"
      "  ego: {{kind: vehicle, config: {{vehicle: {0}vehicles/default.yaml, start: {{speed_mps: 15}}}}}}\n",
      root, kFrom_s + seconds);
  for (const char* screen : kScreens) {
    text += fmt::format(
        "  {}: {{kind: view, config: {{screen: {}, window: always, width_px: {}, height_px: {}, mirrors: [], "
        "instruments: false, sound: false, frame_log: {}.csv}}}}\n",
        screen, screen, width, height, screen);
  }
  const auto file = folder.value().path() / "windows.yaml";
  if (!base::WriteWhole(file, text)) return 1;
  const auto ended =
      system_test::RunCommand({"DISPLAY=" + display.name(), system_test::Bin("rodeira"), "run", file.string(),
                               "--no-record", "--run", "windows-bench", "--domain", "218"});
  fmt::print("{}", ended.out);
  if (ended.status != 0) return 1;
  std::vector<std::vector<bench::Shown>> shown;
  for (const char* screen : kScreens) {
    shown.push_back(
        bench::ReadShown(folder.value().path() / (std::string(screen) + ".csv"), kFrom_s, kFrom_s + seconds));
    fmt::print(
        "{}: {:.1f} pictures a second\n", screen,
        static_cast<double>(shown.back().size() - 1) / (shown.back().back().wall_s - shown.back().front().wall_s));
  }
  Apart apart;
  for (std::size_t a = 0; a < kScreens.size(); ++a) {
    for (std::size_t b = 0; b < kScreens.size(); ++b) {
      if (a != b) Compare(shown[a], shown[b], apart);
    }
  }
  const auto line = [](const char* what, const std::vector<double>& v) {
    fmt::print("{} apart in simulated time: median {:.1f} ms, 99 % {:.1f}, worst {:.1f}\n", what,
               bench::Quantile(v, 0.5), bench::Quantile(v, 0.99), bench::Quantile(v, 1.0));
  };
  line("pictures", apart.shown_ms);
  line("clocks", apart.clocks_ms);
}
