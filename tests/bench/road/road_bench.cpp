// SUELO in the library: at most 50 ns a point on terrain alone (513 x 513, random), 150 ns on 8193 x 8193, 1 µs on the road.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <filesystem>
#include <vector>

#include "common/base/random.hpp"
#include "common/geometry/clothoid.hpp"
#include "common/network/network.hpp"
#include "common/road/world.hpp"
#include "tests/tree.hpp"

namespace rodeira::road {
namespace {

constexpr std::size_t kPoints = 1 << 16;

std::shared_ptr<const World> Loaded(const char* file) { return World::Load(std::filesystem::path(SourceDir()) / file).value(); }
std::shared_ptr<const World> N222() {
  static const auto world = Loaded("configs/worlds/n222.yaml");
  return world;
}
std::shared_ptr<const World> N222OfVersion1() {
  static const auto world = Loaded("tests/data/n222_version1.yaml");
  return world;
}

std::vector<terrain::GroundQuery> OnRoad(const World& world, double from_t_m, double to_t_m) {
  std::vector<terrain::GroundQuery> queries;
  const network::Road& road = world.network()->roads()[0];
  for (std::uint64_t i = 0; i < kPoints; ++i) {
    const Eigen::Vector3d p = road.Surface(base::RandomUniform({i, 1}, 0.0, road.length_m()), base::RandomUniform({i, 2}, from_t_m, to_t_m)).p_W;
    queries.push_back({p.x(), p.y(), p.z()});
  }
  return queries;
}

void Ask(benchmark::State& state, terrain::Ground& ground, const std::vector<terrain::GroundQuery>& queries, std::size_t batch) {
  std::vector<terrain::GroundPoint> points(batch);
  std::size_t at = 0;
  for (auto _ : state) {
    ground.Query({queries.data() + at, batch}, points);
    benchmark::DoNotOptimize(points.data());
    at = (at + batch) & (kPoints - 1);
  }
  state.counters["points"] = benchmark::Counter(static_cast<double>(state.iterations() * batch), benchmark::Counter::kIsRate);
  state.counters["s_a_point"] =
      benchmark::Counter(static_cast<double>(state.iterations() * batch), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void TerrainAloneRandom(benchmark::State& state) {
  const auto posts = static_cast<int>(state.range(0));
  const double edge = 10.0 * (posts - 1);
  WorldSpec spec;
  std::vector<float> heights(static_cast<std::size_t>(posts) * static_cast<std::size_t>(posts));
  for (std::size_t i = 0; i < heights.size(); ++i) heights[i] = static_cast<float>(i % 1009) * 0.5F;
  spec.grid = std::make_shared<terrain::ElevationGrid>(terrain::ElevationGrid::Frame{posts, posts, 0.0, 0.0, edge, edge}, std::move(heights));
  std::vector<terrain::GroundQuery> queries;
  for (std::uint64_t i = 0; i < kPoints; ++i) queries.push_back({base::RandomUniform({i, 1}, 0.0, edge), base::RandomUniform({i, 2}, 0.0, edge)});
  Ask(state, *World::Make(spec)->MakeGround(), queries, 64);
}
BENCHMARK(TerrainAloneRandom)->Arg(513)->Arg(8193);

// A tyre's contact, 20 x 20 points within 20 cm x 18 cm, on the road's straights, arcs and clothoids as they come.
void N222Patch(benchmark::State& state) {
  const auto world = N222();
  const auto ground = world->MakeGround();
  std::vector<terrain::GroundPatch> patches;
  for (std::uint64_t i = 0; i < 1024; ++i) {
    const network::Road& road = world->network()->roads()[0];
    const double s = base::RandomUniform({i, 1}, 1.0, road.length_m() - 1.0);
    const Eigen::Vector3d p = road.Surface(s, base::RandomUniform({i, 2}, -2.5, 2.5)).p_W;
    patches.push_back({p.x(), p.y(), road.axis().Evaluate(s).heading_rad, 0.2, 0.18, 20, 20, p.z()});
  }
  std::vector<terrain::GroundPoint> points(400);
  std::size_t i = 0;
  for (auto _ : state) {
    ground->Patch(patches[i++ & 1023], points);
    benchmark::DoNotOptimize(points.data());
  }
}
BENCHMARK(N222Patch)->Unit(benchmark::kMicrosecond);

// The same on one element: of a road of a world file of version 2 on a plane (0), of a version 1's (1).
void PatchOn(benchmark::State& state, const char* element) {
  const std::string road = fmt::format("    axis: [{}]\n", element);
  const std::string text =
      state.range(0) == 0
          ? "rodeira: world/2\nname: one\nground: {kind: plane}\nroads:\n  - id: a\n    start: {x_m: 0, y_m: 0, heading_deg: 20}\n" + road + "    section: {template: rural}\n"
          : "rodeira: world/1\nname: one\nground: {kind: plane}\nroads:\n  - id: a\n    start: {x_m: 0, y_m: 0, heading_deg: 20}\n" + road +
                "    vertical: [{s_m: 0, z_m: 0}]\n    section: {lanes: [{id: -1, width_m: 3.5, speed_limit_kmh: 80}, {id: 1, width_m: 3.5, speed_limit_kmh: 80}]}\n";
  const auto world = World::Parse(text, "one.yaml");
  if (!world) return state.SkipWithError(world.error().Text().c_str());
  const network::Road& on = world.value()->network()->roads()[0];
  std::vector<terrain::GroundPatch> patches;
  for (std::uint64_t i = 0; i < 1024; ++i) {
    const double s = base::RandomUniform({i, 1}, 1.0, on.length_m() - 1.0);
    const Eigen::Vector3d p = on.Surface(s, base::RandomUniform({i, 2}, -2.5, 2.5)).p_W;
    patches.push_back({p.x(), p.y(), on.axis().Evaluate(s).heading_rad, 0.2, 0.18, 20, 20, p.z()});
  }
  const auto ground = world.value()->MakeGround();
  std::vector<terrain::GroundPoint> points(400);
  std::size_t i = 0;
  for (auto _ : state) {
    ground->Patch(patches[i++ & 1023], points);
    benchmark::DoNotOptimize(points.data());
  }
}
BENCHMARK_CAPTURE(PatchOn, Straight, "line: {length_m: 400}")->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(PatchOn, Arc, "arc: {length_m: 400, radius_m: 200}")->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(PatchOn, Clothoid, "clothoid: {length_m: 400, radius_end_m: 200}")->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

// The same on Town04's driving lanes, as they come (needs the real file beside the project).
void Town04Patch(benchmark::State& state) {
  const std::filesystem::path root(SourceDir());
  const char* file = "shared/data/road/xodr/carla_Town04.xodr";
  const auto world = World::Load(std::filesystem::exists(root / ".." / file) ? root / ".." / file : root / "../.." / file);
  if (!world) return state.SkipWithError("no Town04");
  const network::Network& network = *world.value()->network();
  const auto lanes = network.Lanes();
  std::vector<terrain::GroundPatch> patches;
  for (std::uint64_t i = 0; patches.size() < 1024; ++i) {
    const network::LaneKey key = lanes[base::RandomBits({i, 1}) % lanes.size()];
    if (!network::IsDrivable(network.Find(key)->type)) continue;
    const double s = base::RandomUniform({i, 2}, network.Section(key).s_m, network.Section(key).end_s_m);
    const Eigen::Vector3d p = network.Centre(key, s);
    patches.push_back({p.x(), p.y(), network.roads()[key.road].axis().Evaluate(s).heading_rad, 0.2, 0.18, 20, 20, p.z()});
  }
  const auto ground = world.value()->MakeGround();
  std::vector<terrain::GroundPoint> points(400);
  std::size_t i = 0;
  for (auto _ : state) {
    ground->Patch(patches[i++ & 1023], points);
    benchmark::DoNotOptimize(points.data());
  }
}
BENCHMARK(Town04Patch)->Unit(benchmark::kMicrosecond);

void N222TerrainRandom(benchmark::State& state) {
  std::vector<terrain::GroundQuery> queries;
  for (std::uint64_t i = 0; i < kPoints; ++i) queries.push_back({base::RandomUniform({i, 1}, -2560.0, 2560.0), base::RandomUniform({i, 2}, -2560.0, 2560.0)});
  Ask(state, *N222()->MakeGround(), queries, 64);
}
BENCHMARK(N222TerrainRandom);

void N222RoadRandom(benchmark::State& state) {
  const auto world = N222();
  Ask(state, *world->MakeGround(), OnRoad(*world, -3.4, 3.4), 64);
}
BENCHMARK(N222RoadRandom);

// Of version 2: cuts and fills. Of version 1: where road and terrain are blended.
void N222SlopesRandom(benchmark::State& state) {
  const auto world = N222();
  Ask(state, *world->MakeGround(), OnRoad(*world, 4.7, 13.0), 64);
}
BENCHMARK(N222SlopesRandom);
void N222OfVersion1BlendRandom(benchmark::State& state) { Ask(state, *N222OfVersion1()->MakeGround(), OnRoad(*N222OfVersion1(), 4.7, 13.0), 64); }
BENCHMARK(N222OfVersion1BlendRandom);

void N222FourWheels(benchmark::State& state) {
  const auto world = N222();
  std::vector<terrain::GroundQuery> queries;
  for (std::size_t i = 0; i < kPoints / 4; ++i) {  // 20 m/s at 1 kHz
    for (const auto& [forward, left] : {std::pair{2.6, 0.75}, {2.6, -0.75}, {0.0, 0.75}, {0.0, -0.75}}) {
      const Eigen::Vector3d p = world->network()->roads()[0].Surface(100.0 + 0.02 * static_cast<double>(i) + forward, -1.45 + left).p_W;
      queries.push_back({p.x(), p.y(), p.z()});
    }
  }
  Ask(state, *world->MakeGround(), queries, 4);
}
BENCHMARK(N222FourWheels);

// Of a road of version 1.
void LocateFarAway(benchmark::State& state) {
  const auto world = N222OfVersion1();
  std::uint64_t i = 0;
  for (auto _ : state) {
    ++i;
    benchmark::DoNotOptimize(world->roads()[0].Locate(base::RandomUniform({i, 1}, -2560.0, 2560.0), base::RandomUniform({i, 2}, -2560.0, 2560.0)));
  }
}
BENCHMARK(LocateFarAway);

void EvaluateAxis(benchmark::State& state) {
  const auto world = N222OfVersion1();
  std::uint64_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(world->roads()[0].Evaluate(base::RandomUniform({++i}, 0.0, 5400.0)));
}
BENCHMARK(EvaluateAxis);

void ClothoidEnd(benchmark::State& state) {
  double length = 30.0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(length);
    benchmark::DoNotOptimize(geometry::ClothoidIntegral(0.0, 0.001, length));
  }
}
BENCHMARK(ClothoidEnd);

void LoadN222(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(World::Load(std::filesystem::path(SourceDir()) / "configs/worlds/n222.yaml"));
}
BENCHMARK(LoadN222)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace rodeira::road
