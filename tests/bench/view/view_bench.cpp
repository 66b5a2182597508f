// SPDX-License-Identifier: Apache-2.0
// What pictures cost: a world's meshes once, a frame of 1280 x 720 pixels each time, its PNG file.
// RODEIRA_BENCH_SIZE=1920x1080 draws frames and worlds in that size.
#include <benchmark/benchmark.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "common/core/base/temporary_folder.hpp"
#include "common/view/scene/visual_world/world_scene.hpp"
#include "common/world/road/road_chains.hpp"
#include "common/world/road/world.hpp"
#include "nodes/view/frame/png.hpp"
#include "nodes/view/renderer/renderer.hpp"
#include "nodes/view/visual_database/database.hpp"
#include "nodes/view/visual_database/find_built.hpp"
#include "tests/tree.hpp"

namespace rodeira::nodes {
namespace {

const road::World& N222() {
  static const auto world = road::World::Load(SourceDir() + "/configs/worlds/n222.yaml");
  return *world.value();
}

struct Size {
  int width_px = 1280, height_px = 720;
};

// Without the variable 1280 x 720; the program ends with a sentence where it says anything else than a size.
Size AskedSize() {
  static const Size size = [] {
    Size asked;
    const char* text = std::getenv("RODEIRA_BENCH_SIZE");
    char rest = 0;
    if (text == nullptr) return asked;
    if (std::sscanf(text, "%dx%d%c", &asked.width_px, &asked.height_px, &rest) == 2 && asked.width_px >= 64 &&
        asked.width_px <= 7680 && asked.height_px >= 64 && asked.height_px <= 4320)
      return asked;
    std::fprintf(stderr, "RODEIRA_BENCH_SIZE is '%s'; a size as 1920x1080 was expected, from 64x64 to 7680x4320\n",
                 text);
    std::exit(2);
  }();
  return size;
}

base::Result<std::unique_ptr<Surface>> SurfaceOf(Quality quality) {
  return Surface::Open(SurfaceKind::kOffscreen, AskedSize().width_px, AskedSize().height_px, "bench", false, 0,
                       quality);
}

const network::Road& Road() { return N222().network()->roads()[0]; }

Eigen::Quaterniond Along(double s_m, bool back = false) {
  const double pitch_rad = std::atan(Road().spec().elevation.Evaluate(s_m).slope);
  return scene::Attitude(Road().axis().Evaluate(s_m).heading_rad + (back ? 3.14159265358979 : 0.0),
                         back ? pitch_rad : -pitch_rad, 0.0);
}

Picture AlongTheRoad(double s_m, scene::CameraKind camera) {
  Picture picture;
  picture.camera = camera;
  scene::CarPose car;
  car.p_WB_W = Road().Surface(s_m, -1.45).p_W;
  car.q_WB = Along(s_m);
  for (std::size_t i = 0; i < 4; ++i) car.wheels[i].hub_B = {i < 2 ? 1.23 : -1.23, i % 2 == 0 ? 0.71 : -0.71, 0.29};
  picture.moment.cars.push_back(car);
  return picture;
}

void Meshes(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(scene::BuildWorldScene(N222()));
}
BENCHMARK(Meshes)->Unit(benchmark::kMillisecond)->UseRealTime();

// Fifty cars of the traffic along the road, in both lanes.
void AddTraffic(Picture& picture) {
  constexpr int kCars = 50;
  for (int i = 0; i < kCars; ++i) {
    const double s_m = Road().length_m() * (i + 0.5) / kCars;
    const bool back = i % 2 == 1;
    scene::AgentPose agent;
    agent.id = static_cast<std::uint64_t>(i);
    agent.colour = scene::Colour::Of(0x203040U + 0x031507U * static_cast<std::uint32_t>(i));
    agent.p_WB_W = Road().Surface(s_m, back ? 1.45 : -1.45).p_W;
    agent.q_WB = Along(s_m, back);
    picture.moment.agents.push_back(agent);
  }
}

// Pictures along N222 among fifty cars; first argument: quality, second: chase, driver, driver with three mirrors.
void Frame(benchmark::State& state) {
  const auto quality = static_cast<Quality>(state.range(0));
  auto surface = SurfaceOf(quality);
  if (!surface) return state.SkipWithError(surface.error().Text().c_str());
  const scene::WorldScene standing = scene::BuildWorldScene(N222());
  Renderer renderer(*surface.value(), N222(), standing);
  const auto camera = state.range(1) == 0 ? scene::CameraKind::kChase : scene::CameraKind::kDriver;
  const bool mirrors = state.range(1) == 2;
  double s_m = 30.0;
  std::int64_t time_ns = 0;
  const auto draw_next = [&] {
    Picture picture = AlongTheRoad(s_m, camera);
    AddTraffic(picture);
    picture.mirrors.fill(mirrors);
    picture.moment.time_ns = time_ns += 200'000'000;  // at 45 m/s: pictures that follow one another
    renderer.Draw(picture);
    benchmark::DoNotOptimize(renderer.Read());
    s_m = std::fmod(s_m + 9.0, Road().length_m() - 60.0);
  };
  for (int i = 0; i < 12; ++i) draw_next();  // the renderer compiles what it needs
  for (auto _ : state) draw_next();
  const PictureCost cost = renderer.CostOfLast();
  state.counters["calls"] = static_cast<double>(cost.calls);
  state.counters["triangles"] = static_cast<double>(cost.triangles);
  state.SetLabel(surface.value()->renderer() + ", " + std::string(QualityNames()[static_cast<std::size_t>(quality)]) +
                 (state.range(1) == 0 ? ", chase"
                  : mirrors           ? ", driver with three mirrors"
                                      : ", driver"));
}
BENCHMARK(Frame)
    ->ArgsProduct({{0, 1, 2}, {0, 1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime()
    ->Iterations(30);

// Each world of the project from behind a car at its start, looking round once; argument: quality.
void EveryWorld(benchmark::State& state, const std::filesystem::path& file) {
  const auto quality = static_cast<Quality>(state.range(0));
  const auto world = road::World::Load(file.string());
  if (!world) return state.SkipWithError(world.error().Text().c_str());
  auto surface = SurfaceOf(quality);
  if (!surface) return state.SkipWithError(surface.error().Text().c_str());
  auto renderer = RendererOf(*surface.value(), *world.value(), {});
  if (!renderer) return state.SkipWithError(renderer.error().Text().c_str());
  const road::StartPose& start = world.value()->start();
  int pictures = 0;
  PictureCost most;
  const auto draw_next = [&] {
    Picture picture;
    scene::CarPose car;
    car.p_WB_W = {start.x_m, start.y_m, world.value()->At(start.x_m, start.y_m).z_m};
    car.q_WB = scene::Attitude(start.heading_rad + 0.6283185307 * pictures++, 0.0, 0.0);
    picture.moment.cars.push_back(car);
    renderer.value()->Draw(picture);
    benchmark::DoNotOptimize(renderer.value()->Read());
    const PictureCost cost = renderer.value()->CostOfLast();
    most = {std::max(most.calls, cost.calls), std::max(most.triangles, cost.triangles)};
  };
  for (int i = 0; i < 10; ++i) draw_next();  // the renderer compiles what it needs
  for (auto _ : state) draw_next();
  state.counters["calls"] = static_cast<double>(most.calls);
  state.counters["triangles"] = static_cast<double>(most.triangles);
}
template <class Run>
void RegisterWorld(const std::string& name, Run run) {
  benchmark::RegisterBenchmark(("EveryWorld/" + name).c_str(), run)
      ->Arg(0)
      ->Arg(1)
      ->Arg(2)
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime()
      ->MeasureProcessCPUTime()
      ->Iterations(20);
}

// Its elevations are no part of the project: beside its file, or where the project's data lie, or nothing is measured.
void Crater(benchmark::State& state) {
  const std::filesystem::path worlds = SourceDir() + "/configs/worlds", name = "crater_0513.bt";
  std::filesystem::path elevations = worlds / name;
  if (!std::filesystem::exists(elevations))
    elevations = std::filesystem::path(SourceDir()) / "../shared/data/road/bt" / name;
  if (!std::filesystem::exists(elevations)) return state.SkipWithError("its elevations (crater_0513.bt) are not here");
  const auto folder = base::TemporaryFolder::Make("crater");
  if (!folder) return state.SkipWithError(folder.error().Text().c_str());
  std::filesystem::copy_file(worlds / "crater.yaml", folder.value().path() / "crater.yaml");
  std::filesystem::create_symlink(std::filesystem::weakly_canonical(elevations), folder.value().path() / name);
  EveryWorld(state, folder.value().path() / "crater.yaml");
}

[[maybe_unused]] const bool kWorlds = [] {
  const std::filesystem::path worlds = SourceDir() + "/configs/worlds";
  for (const auto& entry : std::filesystem::directory_iterator(worlds)) {
    if (entry.path().stem() == "crater" || (entry.path().extension() != ".yaml" && entry.path().extension() != ".xodr"))
      continue;
    RegisterWorld(entry.path().stem().string(),
                  [file = entry.path()](benchmark::State& state) { EveryWorld(state, file); });
  }
  RegisterWorld("example",
                [file = worlds / "example/world.yaml"](benchmark::State& state) { EveryWorld(state, file); });
  RegisterWorld("crater", Crater);
  return true;
}();

// Memory of this process that is in the machine's, in megabytes.
double Resident_MB() {
  std::ifstream file("/proc/self/statm");
  double all = 0.0, resident = 0.0;
  file >> all >> resident;
  return resident * 4096.0 / 1e6;
}

// Trees, posts and what else is repeated, along N222's or HASTE's start at medium quality: merged (0), or one model at
// many places (1).
void Repeated(benchmark::State& state, const char* name) {
  const auto world = road::World::Load(SourceDir() + "/configs/worlds/" + name).value();
  const scene::WorldScene standing = scene::BuildWorldScene(*world);
  auto surface = Surface::Open(SurfaceKind::kOffscreen, 1280, 720, "bench", false, 0, Quality::kMedium);
  if (!surface) return state.SkipWithError(surface.error().Text().c_str());
  malloc_trim(0);
  const double before_MB = Resident_MB();
  Renderer renderer(*surface.value(), *world, standing, state.range(0) == 1);
  malloc_trim(0);
  state.counters["painter_MB"] = Resident_MB() - before_MB;
  const road::StartPose& start = world->start();
  int pictures = 0;
  PictureCost most;
  const auto draw_next = [&] {
    Picture picture;
    scene::CarPose car;
    car.p_WB_W = {start.x_m, start.y_m, world->At(start.x_m, start.y_m).z_m};
    car.q_WB = scene::Attitude(start.heading_rad + 0.6283185307 * pictures++, 0.0, 0.0);
    picture.moment.cars.push_back(car);
    renderer.Draw(picture);
    benchmark::DoNotOptimize(renderer.Read());
    const PictureCost cost = renderer.CostOfLast();
    most = {std::max(most.calls, cost.calls), std::max(most.triangles, cost.triangles)};
  };
  for (int i = 0; i < 10; ++i) draw_next();
  for (auto _ : state) draw_next();
  state.counters["calls"] = static_cast<double>(most.calls);
  state.counters["drawn_MB"] = Resident_MB() - before_MB;
}
BENCHMARK_CAPTURE(Repeated, n222, "n222.yaml")
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime()
    ->Iterations(20);
BENCHMARK_CAPTURE(Repeated, haste, "haste.yaml")
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime()
    ->Iterations(20);

// From a loaded HASTE to its first picture: the ground built in memory (0), or the built database found, checked and
// read (1).
void FirstPictureOfHaste(benchmark::State& state) {
  static const auto world = road::World::Load(SourceDir() + "/configs/worlds/haste.yaml").value();
  const auto folder = std::filesystem::temp_directory_path() / "rodeira-view-bench-haste";
  DatabaseOptions options;
  options.folder = folder;
  if (state.range(0) == 1) {
    if (auto written = WriteDatabase(*world, options); !written)
      return state.SkipWithError(written.error().Text().c_str());
  }
  Picture picture;
  scene::CarPose car;
  const road::StartPose& start = world->start();
  car.p_WB_W = {start.x_m, start.y_m, world->At(start.x_m, start.y_m).z_m};
  car.q_WB = scene::Attitude(start.heading_rad, 0.0, 0.0);
  picture.moment.cars.push_back(car);
  for (auto _ : state) {
    auto surface = Surface::Open(SurfaceKind::kOffscreen, 1280, 720, "bench");
    if (!surface) return state.SkipWithError(surface.error().Text().c_str());
    const FoundBuilt found = state.range(0) == 1 ? FindBuilt(folder / "haste.yaml", *world) : FoundBuilt{};
    if (!found.remark.empty()) return state.SkipWithError(found.remark.c_str());
    auto renderer = RendererOf(*surface.value(), *world, found.folder);
    if (!renderer) return state.SkipWithError(renderer.error().Text().c_str());
    renderer.value()->DrawWhole(picture);
    benchmark::DoNotOptimize(renderer.value()->Read());
  }
  std::filesystem::remove_all(folder);
}
BENCHMARK(FirstPictureOfHaste)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(2);

// HASTE's main road, all of its parts between junctions and over them, from end to end, a picture each 50 m, its ground
// made in memory (0), or from its built database (1): what is held of it.
void DriveHaste(benchmark::State& state) {
  const auto world = road::World::Load(SourceDir() + "/configs/worlds/haste.yaml").value();
  const auto folder = std::filesystem::temp_directory_path() / "rodeira-view-bench-drive";
  DatabaseOptions options;
  options.folder = folder;
  if (state.range(0) == 1) {
    if (auto written = WriteDatabase(*world, options); !written)
      return state.SkipWithError(written.error().Text().c_str());
  }
  const std::vector<road::RoadChain> chains = road::ChainsOf(*world->network());
  const auto longest = std::max_element(chains.begin(), chains.end(),
                                        [](const auto& a, const auto& b) { return a.length_m < b.length_m; });
  for (auto _ : state) {
    malloc_trim(0);
    auto surface = Surface::Open(SurfaceKind::kOffscreen, 640, 360, "bench", false, 0, Quality::kLow);
    if (!surface) return state.SkipWithError(surface.error().Text().c_str());
    auto renderer = RendererOf(*surface.value(), *world, state.range(0) == 1 ? folder : std::filesystem::path());
    if (!renderer) return state.SkipWithError(renderer.error().Text().c_str());
    double first_MB = 0.0, half_MB = 0.0, most_MB = 0.0;
    std::size_t most = 0, pictures = 0;
    for (double s_m = 25.0; s_m < longest->length_m; s_m += 50.0, ++pictures) {
      Picture picture;
      scene::CarPose car;
      const auto [road, on_it_m] = longest->At(*world->network(), s_m);
      car.p_WB_W = road->Surface(on_it_m, -1.75).p_W;
      car.q_WB = scene::Attitude(road->axis().Evaluate(on_it_m).heading_rad, 0.0, 0.0);
      picture.moment.cars.push_back(car);
      renderer.value()->DrawWhole(picture);
      const double now_MB = Resident_MB();
      if (pictures == 0) first_MB = now_MB;
      if (s_m < 0.5 * longest->length_m) half_MB = std::max(half_MB, now_MB);
      most_MB = std::max(most_MB, now_MB);
      most = std::max(most, renderer.value()->HeldLevels());
    }
    state.counters["km"] = 1e-3 * longest->length_m;
    state.counters["held_most"] = static_cast<double>(most);
    state.counters["first_MB"] = first_MB;
    state.counters["first_half_MB"] = half_MB;
    state.counters["most_MB"] = most_MB;
  }
  std::filesystem::remove_all(folder);
}
BENCHMARK(DriveHaste)->Arg(0)->Arg(1)->Unit(benchmark::kSecond)->UseRealTime()->Iterations(1);

void Png(benchmark::State& state) {
  const auto image = RenderStill(N222(), AlongTheRoad(300.0, scene::CameraKind::kChase), 1280, 720);
  if (!image) return state.SkipWithError(image.error().Text().c_str());
  const auto path = std::filesystem::temp_directory_path() / "rodeira-view-bench.png";
  for (auto _ : state) (void)WritePng(path, image.value());
  std::filesystem::remove(path);
}
BENCHMARK(Png)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace rodeira::nodes
