// What pictures cost: a world's meshes once, a frame of 1280 x 720 pixels each time, its PNG file.
#include <benchmark/benchmark.h>

#include <cmath>
#include <filesystem>

#include "common/road/world.hpp"
#include "common/scene/world_scene.hpp"
#include "nodes/view/database.hpp"
#include "nodes/view/find_built.hpp"
#include "nodes/view/painter.hpp"
#include "nodes/view/png.hpp"

namespace rodeira::view {
namespace {

const road::World& N222() {
  static const auto world = road::World::Load(RODEIRA_SOURCE_DIR "/configs/worlds/n222.yaml");
  return *world.value();
}

Picture AlongTheRoad(double s_m, scene::CameraKind camera) {
  const road::Road& road = N222().roads()[0];
  const road::RoadFrame frame = road.Evaluate(s_m);
  Picture picture;
  picture.camera = camera;
  scene::CarPose car;
  car.p_WB_W = road.Position(s_m, -1.45);
  car.q_WB = scene::Attitude(frame.heading_rad, -std::atan(frame.grade), 0.0);
  for (std::size_t i = 0; i < 4; ++i) car.wheels[i].hub_B = {i < 2 ? 1.23 : -1.23, i % 2 == 0 ? 0.71 : -0.71, 0.29};
  picture.moment.cars.push_back(car);
  return picture;
}

void Meshes(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(scene::BuildWorldScene(N222()));
}
BENCHMARK(Meshes)->Unit(benchmark::kMillisecond)->UseRealTime();

void Frame(benchmark::State& state) {
  auto surface = Surface::Open(SurfaceKind::kOffscreen, 1280, 720, "bench");
  if (!surface) return state.SkipWithError(surface.error().Text().c_str());
  const scene::WorldScene standing = scene::BuildWorldScene(N222());
  Painter painter(*surface.value(), N222(), standing);
  const auto camera = state.range(0) == 0 ? scene::CameraKind::kChase : scene::CameraKind::kDriver;
  const bool mirrors = state.range(0) == 2;
  double s_m = 30.0;
  for (auto _ : state) {
    Picture picture = AlongTheRoad(s_m, camera);
    picture.mirrors.fill(mirrors);
    painter.Draw(picture);
    benchmark::DoNotOptimize(painter.Read());
    s_m = std::fmod(s_m + 37.0, N222().roads()[0].length_m() - 60.0);
  }
  state.SetLabel(surface.value()->renderer() + (state.range(0) == 0 ? ", chase" : mirrors ? ", driver with three mirrors" : ", driver"));
}
BENCHMARK(Frame)->Arg(0)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();

// From a loaded HASTE to its first picture: the ground built in memory (0), or the built database found, checked and read (1).
void FirstPictureOfHaste(benchmark::State& state) {
  static const auto world = road::World::Load(RODEIRA_SOURCE_DIR "/configs/worlds/haste.yaml").value();
  const auto folder = std::filesystem::temp_directory_path() / "rodeira-view-bench-haste";
  DatabaseOptions options;
  options.folder = folder;
  if (state.range(0) == 1) {
    if (auto written = WriteDatabase(*world, options); !written) return state.SkipWithError(written.error().Text().c_str());
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
    auto painter = PainterOf(*surface.value(), *world, found.folder);
    if (!painter) return state.SkipWithError(painter.error().Text().c_str());
    painter.value()->DrawWhole(picture);
    benchmark::DoNotOptimize(painter.value()->Read());
  }
  std::filesystem::remove_all(folder);
}
BENCHMARK(FirstPictureOfHaste)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(2);

void Png(benchmark::State& state) {
  const auto image = RenderStill(N222(), AlongTheRoad(300.0, scene::CameraKind::kChase), 1280, 720);
  if (!image) return state.SkipWithError(image.error().Text().c_str());
  const auto path = std::filesystem::temp_directory_path() / "rodeira-view-bench.png";
  for (auto _ : state) (void)WritePng(path, image.value());
  std::filesystem::remove(path);
}
BENCHMARK(Png)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace rodeira::view
