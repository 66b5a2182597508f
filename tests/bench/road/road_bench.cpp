// SPDX-License-Identifier: Apache-2.0
// SUELO in the library: at most 50 ns a point on terrain alone (513 x 513, random), 150 ns on 8193 x 8193, 1 µs on the
// road.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <filesystem>
#include <vector>

#include "common/core/base/random.hpp"
#include "common/core/geometry/clothoid.hpp"
#include "common/world/network/network.hpp"
#include "common/world/road/world.hpp"
#include "tests/tree.hpp"

namespace rodeira::road {
namespace {

constexpr std::size_t kPoints = 1 << 16;

std::shared_ptr<const World> Loaded(const char* file) {
  return World::Load(std::filesystem::path(SourceDir()) / file).value();
}
std::shared_ptr<const World> N222() {
  static const auto world = Loaded("configs/worlds/n222.yaml");
  return world;
}
std::shared_ptr<const World> N222OfVersion1() {
  static const auto world = Loaded("tests/data/n222_version1.yaml");
  return world;
}

std::vector<ground::GroundQuery> OnRoad(const World& world, double from_t_m, double to_t_m) {
  std::vector<ground::GroundQuery> queries;
  const network::Road& road = world.network()->roads()[0];
  for (std::uint64_t i = 0; i < kPoints; ++i) {
    const Eigen::Vector3d p =
        road.Surface(base::RandomUniform({i, 1}, 0.0, road.length_m()), base::RandomUniform({i, 2}, from_t_m, to_t_m))
            .p_W;
    queries.push_back({p.x(), p.y(), p.z()});
  }
  return queries;
}

void QueryAll(benchmark::State& state, ground::Ground& ground, const std::vector<ground::GroundQuery>& queries,
              std::size_t batch) {
  std::vector<ground::GroundPoint> points(batch);
  std::size_t at = 0;
  for (auto _ : state) {
    ground.Query({queries.data() + at, batch}, points);
    benchmark::DoNotOptimize(points.data());
    at = (at + batch) & (kPoints - 1);
  }
  state.counters["points"] =
      benchmark::Counter(static_cast<double>(state.iterations() * batch), benchmark::Counter::kIsRate);
  state.counters["s_a_point"] = benchmark::Counter(static_cast<double>(state.iterations() * batch),
                                                   benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void TerrainAloneRandom(benchmark::State& state) {
  const auto posts = static_cast<int>(state.range(0));
  const double edge = 10.0 * (posts - 1);
  WorldSpec spec;
  std::vector<float> heights(static_cast<std::size_t>(posts) * static_cast<std::size_t>(posts));
  for (std::size_t i = 0; i < heights.size(); ++i) heights[i] = static_cast<float>(i % 1009) * 0.5F;
  spec.grid = std::make_shared<terrain::ElevationGrid>(
      terrain::ElevationGrid::Frame{posts, posts, 0.0, 0.0, edge, edge}, std::move(heights));
  std::vector<ground::GroundQuery> queries;
  for (std::uint64_t i = 0; i < kPoints; ++i)
    queries.push_back({base::RandomUniform({i, 1}, 0.0, edge), base::RandomUniform({i, 2}, 0.0, edge)});
  QueryAll(state, *World::Make(spec)->MakeGround(), queries, 64);
}
BENCHMARK(TerrainAloneRandom)->Arg(513)->Arg(8193);

// A tyre's contact, 20 x 20 points within 20 cm x 18 cm, on the road's straights, arcs and clothoids as they come.
void N222Patch(benchmark::State& state) {
  const auto world = N222();
  const auto ground = world->MakeGround();
  std::vector<ground::GroundPatch> patches;
  for (std::uint64_t i = 0; i < 1024; ++i) {
    const network::Road& road = world->network()->roads()[0];
    const double s = base::RandomUniform({i, 1}, 1.0, road.length_m() - 1.0);
    const Eigen::Vector3d p = road.Surface(s, base::RandomUniform({i, 2}, -2.5, 2.5)).p_W;
    patches.push_back({p.x(), p.y(), road.axis().Evaluate(s).heading_rad, 0.2, 0.18, 20, 20, p.z()});
  }
  std::vector<ground::GroundPoint> points(400);
  std::size_t i = 0;
  for (auto _ : state) {
    ground->Patch(patches[i++ & 1023], points);
    benchmark::DoNotOptimize(points.data());
  }
}
BENCHMARK(N222Patch)->Unit(benchmark::kMicrosecond);

// The same on one element of 400 m: of a road of a world file of version 2 on a plane (0), of a version 1's (1).
std::string OfVersion2(const std::string& element, const std::string& more = "") {
  return fmt::format(
      "rodeira: world/2\nname: one\nground: {{kind: plane}}\nroads:\n  - id: a\n    start: {{x_m: 0, y_m: 0, "
      "heading_deg: 20}}\n    axis: [{}]\n{}    section: {{template: rural}}\n",
      element, more);
}
std::string OfVersion1(const std::string& element) {
  return fmt::format(
      "rodeira: world/1\nname: one\nground: {{kind: plane}}\nroads:\n  - id: a\n    start: {{x_m: 0, y_m: 0, "
      "heading_deg: 20}}\n    axis: [{}]\n    vertical: [{{s_m: 0, z_m: 0}}]\n"
      "    section: {{lanes: [{{id: -1, width_m: 3.5, speed_limit_kmh: 80}}, {{id: 1, width_m: 3.5, speed_limit_kmh: "
      "80}}]}}\n",
      element);
}

void AskPatches(benchmark::State& state, const std::string& text, double to_s_m) {
  const auto world = World::Parse(text, "one.yaml");
  if (!world) return state.SkipWithError(world.error().Text().c_str());
  const network::Road& on = world.value()->network()->roads()[0];
  std::vector<ground::GroundPatch> patches;
  for (std::uint64_t i = 0; i < 1024; ++i) {
    const double s = base::RandomUniform({i, 1}, 1.0, std::min(to_s_m, on.length_m()) - 1.0);
    const Eigen::Vector3d p = on.Surface(s, base::RandomUniform({i, 2}, -2.5, 2.5)).p_W;
    patches.push_back({p.x(), p.y(), on.axis().Evaluate(s).heading_rad, 0.2, 0.18, 20, 20, p.z()});
  }
  const auto ground = world.value()->MakeGround();
  std::vector<ground::GroundPoint> points(400);
  std::size_t i = 0;
  for (auto _ : state) {
    ground->Patch(patches[i++ & 1023], points);
    benchmark::DoNotOptimize(points.data());
  }
}

constexpr const char* kStraight = "line: {length_m: 400}";
constexpr const char* kArc = "arc: {length_m: 400, radius_m: 200}";
constexpr const char* kClothoid = "clothoid: {length_m: 400, radius_end_m: 200}";

void PatchOn(benchmark::State& state, const char* element) {
  AskPatches(state, state.range(0) == 0 ? OfVersion2(element) : OfVersion1(element), 400.0);
}
BENCHMARK_CAPTURE(PatchOn, Straight, kStraight)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(PatchOn, Arc, kArc)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(PatchOn, Clothoid, kClothoid)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

// The same on banked roads of version 2: climbing by 3 % and banked by 5 % throughout (0), where bank and grade change
// along the road (1), before a road's bank begins (2).
void PatchOnBank(benchmark::State& state, const char* element) {
  const char* climbing =
      "    vertical: [{s_m: 0, z_m: 0}, {s_m: 600, z_m: 18}]\n    superelevation: [{s_m: 0, slope: 0.05}]\n";
  const char* changing =
      "    vertical: [{s_m: 0, z_m: 0}, {s_m: 200, z_m: 6, parabola_m: 390}, {s_m: 400, z_m: 4}]\n    superelevation: "
      "[{s_m: 0, slope: -0.03}, {s_m: 400, slope: 0.06}]\n";
  const char* before =
      "    vertical: [{s_m: 0, z_m: 0}, {s_m: 600, z_m: 18}]\n    superelevation: [{s_m: 0, slope: 0}, {s_m: 380, "
      "slope: 0}, {s_m: 400, slope: 0.05}]\n";
  AskPatches(state,
             OfVersion2(element, state.range(0) == 0   ? climbing
                                 : state.range(0) == 1 ? changing
                                                       : before),
             state.range(0) == 2 ? 380.0 : 400.0);
}
BENCHMARK_CAPTURE(PatchOnBank, Straight, kStraight)->DenseRange(0, 2)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(PatchOnBank, Arc, kArc)->DenseRange(0, 2)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(PatchOnBank, Clothoid, kClothoid)->DenseRange(0, 2)->Unit(benchmark::kMicrosecond);

// The same on a real file's driving lanes, as they come, or only where more than one road lies on one level (needs the
// files beside the project).
void FilePatch(benchmark::State& state, const char* name, bool overlapping) {
  const std::filesystem::path root(SourceDir());
  const std::filesystem::path file = std::filesystem::path("shared/data/road/xodr") / name;
  const auto world =
      World::Load(std::filesystem::exists(root / ".." / file) ? root / ".." / file : root / "../.." / file);
  if (!world) return state.SkipWithError("no such file");
  const network::Network& network = *world.value()->network();
  const auto lanes = network.Lanes();
  std::vector<ground::GroundPatch> patches;
  std::vector<network::Surfacing> surfaces;
  for (std::uint64_t i = 0; patches.size() < 1024; ++i) {
    const network::LaneKey key = lanes[base::RandomBits({i, 1}) % lanes.size()];
    if (!network::IsDrivable(network.Find(key)->type)) continue;
    const double s = base::RandomUniform({i, 2}, network.Section(key).s_m, network.Section(key).end_s_m);
    const Eigen::Vector3d p = network.Centre(key, s);
    network.Surfaces(p.x(), p.y(), surfaces);
    if (overlapping &&
        !(surfaces.size() > 1 && surfaces[0].place.z_m - surfaces[1].place.z_m < ground::kMaxAboveHint_m))
      continue;
    patches.push_back(
        {p.x(), p.y(), network.roads()[key.road].axis().Evaluate(s).heading_rad, 0.2, 0.18, 20, 20, p.z()});
  }
  const auto ground = world.value()->MakeGround();
  std::vector<ground::GroundPoint> points(400);
  std::size_t i = 0;
  for (auto _ : state) {
    ground->Patch(patches[i++ & 1023], points);
    benchmark::DoNotOptimize(points.data());
  }
}
BENCHMARK_CAPTURE(FilePatch, Town04, "carla_Town04.xodr", false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(FilePatch, Town04WhereRoadsOverlap, "carla_Town04.xodr", true)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(FilePatch, BankedStraight, "esmini_straight_500_superelevation_elevation_curve.xodr", false)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(FilePatch, RolledBy45Degrees, "esmini_two_pitched_and_rolled_roads.xodr", false)
    ->Unit(benchmark::kMicrosecond);

void N222TerrainRandom(benchmark::State& state) {
  std::vector<ground::GroundQuery> queries;
  for (std::uint64_t i = 0; i < kPoints; ++i)
    queries.push_back({base::RandomUniform({i, 1}, -2560.0, 2560.0), base::RandomUniform({i, 2}, -2560.0, 2560.0)});
  QueryAll(state, *N222()->MakeGround(), queries, 64);
}
BENCHMARK(N222TerrainRandom);

void N222RoadRandom(benchmark::State& state) {
  const auto world = N222();
  QueryAll(state, *world->MakeGround(), OnRoad(*world, -3.4, 3.4), 64);
}
BENCHMARK(N222RoadRandom);

// Of version 2: cuts and fills. Of version 1: where road and terrain are blended.
void N222SlopesRandom(benchmark::State& state) {
  const auto world = N222();
  QueryAll(state, *world->MakeGround(), OnRoad(*world, 4.7, 13.0), 64);
}
BENCHMARK(N222SlopesRandom);
void N222OfVersion1BlendRandom(benchmark::State& state) {
  QueryAll(state, *N222OfVersion1()->MakeGround(), OnRoad(*N222OfVersion1(), 4.7, 13.0), 64);
}
BENCHMARK(N222OfVersion1BlendRandom);

void N222FourWheels(benchmark::State& state) {
  const auto world = N222();
  std::vector<ground::GroundQuery> queries;
  for (std::size_t i = 0; i < kPoints / 4; ++i) {  // 20 m/s at 1 kHz
    for (const auto& [forward, left] : {std::pair{2.6, 0.75}, {2.6, -0.75}, {0.0, 0.75}, {0.0, -0.75}}) {
      const Eigen::Vector3d p =
          world->network()->roads()[0].Surface(100.0 + 0.02 * static_cast<double>(i) + forward, -1.45 + left).p_W;
      queries.push_back({p.x(), p.y(), p.z()});
    }
  }
  QueryAll(state, *world->MakeGround(), queries, 4);
}
BENCHMARK(N222FourWheels);

void ClothoidEnd(benchmark::State& state) {
  double length = 30.0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(length);
    benchmark::DoNotOptimize(geometry::ClothoidIntegral(0.0, 0.001, length));
  }
}
BENCHMARK(ClothoidEnd);

void LoadN222(benchmark::State& state) {
  for (auto _ : state)
    benchmark::DoNotOptimize(World::Load(std::filesystem::path(SourceDir()) / "configs/worlds/n222.yaml"));
}
BENCHMARK(LoadN222)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace rodeira::road
