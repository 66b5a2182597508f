// SPDX-License-Identifier: Apache-2.0
// `rodeira world build`, by the clock and in processor time of all threads: asked are 10 s for HASTE on two cores, 3 s
// for Town04 and 3 s for a banked motorway, which costs at most twice what it costs level. Each world is read and
// written into a fresh folder; once more where nothing has changed; and once more after one sign has moved.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "common/core/base/files.hpp"
#include "common/world/road/world.hpp"
#include "nodes/view/visual_database/database.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/tree.hpp"

namespace rodeira::nodes {
namespace {

namespace fs = std::filesystem;

// Reads and writes it; what was written is counted.
bool Build(benchmark::State& state, const fs::path& file, const fs::path& folder, DatabaseReport& report) {
  const auto world = road::World::Load(file);
  if (!world) {
    state.SkipWithError(world.error().Text().c_str());
    return false;
  }
  const auto written = WriteDatabase(*world.value(), {folder, static_cast<unsigned>(state.range(0))});
  if (!written) {
    state.SkipWithError(written.error().Text().c_str());
    return false;
  }
  report = written.value();
  return true;
}

void Count(benchmark::State& state, const DatabaseReport& report) {
  state.counters["tiles"] = static_cast<double>(report.tiles);
  state.counters["built"] = static_cast<double>(report.built);
}

void Fresh(benchmark::State& state, const fs::path& file) {
  const cli::TemporaryFolder folder;
  DatabaseReport report;
  int times = 0;
  for (auto _ : state) {
    if (!Build(state, file, folder.path() / std::to_string(times++), report)) return;
  }
  Count(state, report);
}

void Unchanged(benchmark::State& state, const fs::path& file) {
  const cli::TemporaryFolder folder;
  DatabaseReport report;
  if (!Build(state, file, folder.path() / "out", report)) return;
  for (auto _ : state) {
    if (!Build(state, file, folder.path() / "out", report)) return;
  }
  Count(state, report);
}

// One sign of HASTE's main road, a metre farther each time.
void AMovedSign(benchmark::State& state) {
  const cli::TemporaryFolder folder;
  std::string text = base::ReadText(fs::path(SourceDir()) / "configs/worlds/haste.yaml").value();
  const std::string sign = "{type: town, text: Alvite, s_m: 3918.204}";
  const std::size_t at = text.find(sign);
  if (at == std::string::npos)
    return state.SkipWithError("HASTE has no sign of Alvite where this program looks for it");
  const fs::path file = folder.Write("haste.yaml", text);
  DatabaseReport report;
  if (!Build(state, file, folder.path() / "out", report)) return;
  int moved = 0;
  for (auto _ : state) {
    state.PauseTiming();
    std::string other = text;
    folder.Write(
        "haste.yaml",
        other.replace(at, sign.size(), "{type: town, text: Alvite, s_m: " + std::to_string(3918 - ++moved) + "}"));
    state.ResumeTiming();
    if (!Build(state, file, folder.path() / "out", report)) return;
  }
  Count(state, report);
}

std::string Record(const char* element, const char* along, double from, double a, double b, double c, double d) {
  return fmt::format("<{} {}=\"{}\" a=\"{}\" b=\"{}\" c=\"{}\" d=\"{}\"/>", element, along, from, a, b, c, d);
}

// From (0, y0) to (length, y1) with the slopes m0 and m1 there.
std::string Blend(const char* element, const char* along, double from, double length, double y0, double y1, double m0,
                  double m1) {
  return Record(element, along, from, y0, m0, (3.0 * (y1 - y0) / length - 2.0 * m0 - m1) / length,
                (2.0 * (y0 - y1) / length + m0 + m1) / (length * length));
}

// A lane as a survey has it: a width every 5 m that differs by millimetres.
std::string SurveyedLane(int id, double length_m) {
  const int outward = std::abs(id);
  const bool driving = outward >= 3 && outward <= 6, shoulder = outward == 2 || outward == 7;
  const auto width_m = [&](int k) { return (driving ? 3.75 : shoulder ? 2.5 : 1.0) + 0.004 * std::sin(k + outward); };
  std::string widths;
  for (int k = 0; 5.0 * k < length_m; ++k)
    widths += Blend("width", "sOffset", 5.0 * k, 5.0, width_m(k), width_m(k + 1), 0.0, 0.0);
  return fmt::format("<lane id=\"{}\" type=\"{}\">{}<roadMark sOffset=\"0\" type=\"broken\"/></lane>", id,
                     driving    ? "driving"
                     : shoulder ? "shoulder"
                                : "border",
                     widths);
}

// 1.7 km of a motorway with 26 lanes, with a superelevation of up to 5 % or level across.
std::string Motorway(bool banked) {
  struct Bend {
    double length_m, from_1pm, to_1pm;
  };
  constexpr std::array<Bend, 8> kBends = {{{300, 0, 0},
                                           {150, 0, 1.0 / 900},
                                           {400, 1.0 / 900, 1.0 / 900},
                                           {150, 1.0 / 900, 0},
                                           {200, 0, 0},
                                           {120, 0, -1.0 / 700},
                                           {300, -1.0 / 700, -1.0 / 700},
                                           {80, -1.0 / 700, 0}}};
  std::string plan, elevation, lanes;
  double x = 0.0, y = 0.0, heading = 0.0, s = 0.0;
  for (const auto& [length, from, to] : kBends) {
    const std::string shape = from != to    ? fmt::format("<spiral curvStart=\"{}\" curvEnd=\"{}\"/>", from, to)
                              : from != 0.0 ? fmt::format("<arc curvature=\"{}\"/>", from)
                                            : "<line/>";
    plan += fmt::format("<geometry s=\"{}\" x=\"{}\" y=\"{}\" hdg=\"{}\" length=\"{}\">{}</geometry>", s, x, y, heading,
                        length, shape);
    constexpr int kSteps = 4000;
    for (int i = 0; i < kSteps; ++i) {
      const double u = (i + 0.5) * length / kSteps, at = heading + from * u + (to - from) * u * u / (2.0 * length);
      x += length / kSteps * std::cos(at), y += length / kSteps * std::sin(at);
    }
    heading += 0.5 * (from + to) * length, s += length;
  }
  for (int i = 0; i < 34; ++i) {
    const auto z = [](int k) { return 2.0 * std::sin(0.25 * k); };
    const auto grade = [](int k) { return 0.01 * std::cos(0.25 * k); };
    elevation += Blend("elevation", "s", 50.0 * i, 50.0, z(i), z(i + 1), grade(i), grade(i + 1));
  }
  std::string bank;
  constexpr std::array<std::array<double, 2>, 9> kBank = {
      {{0, 0}, {300, 0}, {450, 0.05}, {850, 0.05}, {1000, 0}, {1200, 0}, {1320, -0.05}, {1620, -0.05}, {1700, 0}}};
  for (std::size_t i = 0; banked && i + 1 < kBank.size(); ++i)
    bank +=
        Blend("superelevation", "s", kBank[i][0], kBank[i + 1][0] - kBank[i][0], kBank[i][1], kBank[i + 1][1], 0, 0);
  for (int id = 13; id >= -13; --id) {
    if (id == 0)
      lanes += "</left><center><lane id=\"0\" type=\"none\"/></center><right>";
    else
      lanes += SurveyedLane(id, s);
  }
  return fmt::format(
      "<OpenDRIVE><header revMajor=\"1\" revMinor=\"6\"/><road id=\"1\" length=\"{}\" junction=\"-1\"><type s=\"0\" "
      "type=\"motorway\"/><planView>{}</planView><elevationProfile>{}</elevationProfile><lateralProfile>{}"
      "</lateralProfile><lanes><laneSection s=\"0\"><left>{}</right></laneSection></lanes></road></OpenDRIVE>",
      s, plan, elevation, bank, lanes);
}

// The second argument: 1 banked, 0 level across.
void FreshMotorway(benchmark::State& state) {
  const cli::TemporaryFolder folder;
  const fs::path file = folder.Write("motorway.xodr", Motorway(state.range(1) == 1));
  Fresh(state, file);
}

const fs::path kHaste = fs::path(SourceDir()) / "configs/worlds/haste.yaml";
const fs::path kTown04 = fs::path(SourceDir()) / "../shared/data/road/xodr/carla_Town04.xodr";

void FreshHaste(benchmark::State& state) { Fresh(state, kHaste); }
void UnchangedHaste(benchmark::State& state) { Unchanged(state, kHaste); }
void FreshTown04(benchmark::State& state) {
  if (!fs::exists(kTown04)) return state.SkipWithError("the real files are not beside the project");
  Fresh(state, kTown04);
}

// The first argument: threads, 0 as many as the machine has.
BENCHMARK(FreshMotorway)
    ->Args({1, 1})
    ->Args({1, 0})
    ->Iterations(1)
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();
BENCHMARK(FreshHaste)->Arg(0)->Arg(1)->Iterations(1)->Unit(benchmark::kSecond)->UseRealTime()->MeasureProcessCPUTime();
BENCHMARK(UnchangedHaste)->Arg(0)->Iterations(1)->Unit(benchmark::kSecond)->UseRealTime()->MeasureProcessCPUTime();
BENCHMARK(AMovedSign)->Arg(0)->Iterations(1)->Unit(benchmark::kSecond)->UseRealTime()->MeasureProcessCPUTime();
BENCHMARK(FreshTown04)->Arg(0)->Iterations(1)->Unit(benchmark::kSecond)->UseRealTime()->MeasureProcessCPUTime();

}  // namespace
}  // namespace rodeira::nodes
